//! The exponential of a fraction, enclosed.
//!
//! x = k ln 2 + r with |r| < 1; exp(r) by its series in fixed point. Every truncation is counted, and the enclosure is
//! wider by the count.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::dyadic::Dyadic;
use super::{Interval, Rational};

/// exp(x) lies beyond every exponent that is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the exponential of a number beyond 2^61 is not represented")]
pub struct Overflow;

/// The bits of x beyond which exp(x) has no exponent.
const MOST_BITS: u64 = 61;

/// Bits beyond those that are asked for, against the loss by truncation.
const GUARD: u64 = 24;

impl Interval {
    /// exp(x), to about so many bits; for x below −2⁶¹ only that it lies between 0 and 2^(−2⁶¹).
    ///
    /// # Errors
    ///
    /// [`Overflow`] for x above 2⁶¹.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::scalar::{Interval, ratio};
    ///
    /// let e = Interval::exponential(&ratio(1, 1), 40)?;
    /// let (lower, upper) = (e.lower().value(), e.upper().value());
    /// assert!(lower > Some(ratio(27_182_818_284, 10_000_000_000)) && upper < Some(ratio(27_182_818_285, 10_000_000_000)));
    /// # Ok::<(), exact_kalman::scalar::Overflow>(())
    /// ```
    pub fn exponential(x: &Rational, bits: u64) -> Result<Self, Overflow> {
        if x.is_zero() {
            return Ok(Self::between(Dyadic::one(), Dyadic::one()));
        }
        let size = (x.numer().bits()).saturating_sub(x.denom().bits());
        if size > MOST_BITS {
            let least = Dyadic::new(BigInt::one(), -(1 << MOST_BITS));
            return if x.is_negative() { Ok(Self::between(Dyadic::zero(), least)) } else { Err(Overflow) };
        }
        let places = bits + GUARD;
        // x in fixed point, with the bits that k ln 2 takes away.
        let fine = places + size + 2;
        let fixed = (x.numer() << fine).div_floor(x.denom());
        let two = logarithm_of_two(fine);
        let (k, r) = fixed.div_mod_floor(&two);
        // x = fixed + [0, 1] and ln 2 = two + [0, 2] in units of 2^−fine, so that the true rest is within 2|k| + 1 of r.
        let slack = k.abs() * 2_u8 + 1_u8;
        let (below, above) = ((&r - &slack) >> (fine - places), ((&r + &slack) >> (fine - places)) + 1_u8);
        let exponent = k.to_i64().ok_or(Overflow)? - i64::try_from(places).map_err(|_| Overflow)?;
        let ((low, low_error), (high, high_error)) = (series(&below, places), series(&above, places));
        Ok(Self::between(Dyadic::new(low - low_error, exponent), Dyadic::new(high + high_error, exponent)))
    }
}

/// A lower bound of ln 2, less than two units of 2^−places away from it; in these units.
///
/// ln 2 = Σ_{j≥1} 1/(j 2ʲ): each term is truncated below by less than one unit of the finer place, and the terms left out
/// add up to less than one.
fn logarithm_of_two(places: u64) -> BigInt {
    // The number of terms is `finer`, and so many units are lost at most.
    let guard = 64 - places.leading_zeros() + 3;
    let finer = places + u64::from(guard);
    let sum: BigInt = (1..=finer).map(|j| (BigInt::one() << (finer - j)) / j).sum();
    // sum ≤ 2^finer ln 2 < sum + finer + 1 ≤ sum + 2^guard, and the shift loses less than one unit more.
    sum >> guard
}

/// exp(r) for r = `fixed` · 2^−places, −1 < r < 1, in the same units, and how many units it may be off.
fn series(fixed: &BigInt, places: u64) -> (BigInt, BigInt) {
    let mut term = BigInt::one() << places;
    let mut sum = term.clone();
    let mut count = 0_u64;
    while !term.is_zero() && term != BigInt::from(-1) {
        count += 1;
        // The error e of a term: e_j ≤ (e_{j−1} + 1)/j + 1, from the two truncations; so e_j ≤ 5/2.
        term = ((term * fixed) >> places).div_floor(&BigInt::from(count));
        sum += &term;
    }
    // The last true term is at most 1 + 5/2, and those left out add up to no more than it, as each is at most half of
    // the one before.
    (sum, BigInt::from(3 * count + 4))
}
