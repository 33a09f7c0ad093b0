//! The exponential of a fraction, enclosed.
//!
//! x = k ln 2 + r with 0 ≤ r < 1; exp(r 2^−h) by its series in fixed point, squared h times. Every truncation is counted,
//! and the enclosure is wider by the count.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::dyadic::Dyadic;
use super::logarithm::logarithm_of_two;
use super::{Interval, Rational};

/// exp(x) lies beyond every exponent that is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the exponential of a number beyond 2^62 is not represented")]
pub struct Overflow;

/// The bits of x beyond which exp(x) has no exponent.
const MOST_BITS: u64 = 62;

/// Bits beyond those that are asked for, against the loss by truncation.
const GUARD: u64 = 24;

/// The bits that k ln 2 takes away from x, and two more: |k| < 2⁶³.
const WHOLE: u64 = 66;

/// Exponentials to a number of bits. What all of them need, ln 2, is computed once.
///
/// # Examples
///
/// ```
/// use exact_kalman::scalar::{Exponentials, ratio};
///
/// let exponentials = Exponentials::new(40);
/// let (one, two) = (exponentials.of(&ratio(1, 1))?, exponentials.of(&ratio(2, 1))?);
/// let square = one.times(&one, 40);
/// assert!(square.lower() <= two.upper() && two.lower() <= square.upper());
/// # Ok::<(), exact_kalman::scalar::Overflow>(())
/// ```
#[derive(Clone, Debug)]
pub struct Exponentials {
    halvings: u64,
    places: u64,
    /// A lower bound of ln 2 in units of 2^−(places + WHOLE), less than two units away from it.
    logarithm_of_two: BigInt,
}

impl Exponentials {
    /// Exponentials to about so many bits.
    pub fn new(bits: u64) -> Self {
        // So many squarings cost as much as the terms that they save.
        let halvings = bits.isqrt();
        let places = bits.saturating_add(halvings + GUARD);
        Self { halvings, places, logarithm_of_two: logarithm_of_two(places + WHOLE) }
    }

    /// exp(x); for x below −2⁶² only that it lies between 0 and 2^(−2⁶²).
    ///
    /// # Errors
    ///
    /// [`Overflow`] for x above 2⁶².
    pub fn of(&self, x: &Rational) -> Result<Interval, Overflow> {
        if x.is_zero() {
            return Ok(Interval::between(Dyadic::one(), Dyadic::one()));
        }
        if x.numer().magnitude() > &(x.denom().magnitude() << MOST_BITS) {
            // exp(−2⁶²) < 2^(−2⁶²)
            let least = Dyadic::new(BigInt::one(), -(1 << MOST_BITS));
            return if x.is_negative() { Ok(Interval::between(Dyadic::zero(), least)) } else { Err(Overflow) };
        }
        let fixed = (x.numer() << (self.places + WHOLE)).div_floor(x.denom());
        let (k, r) = fixed.div_mod_floor(&self.logarithm_of_two);
        // x = fixed + [0, 1] and ln 2 = two + [0, 2] in units of 2^−(places + WHOLE), so that the true rest is within 2|k| + 1
        // of r, less than a unit of 2^−places. Truncated to these and halved h times, it is off by less than three.
        let (sum, error) = series(&(r >> (WHOLE + self.halvings)), self.places);
        // exp is steeper than 1, but not than 2 here.
        let error = error + 6_u8;
        let (mut low, mut high) = (&sum - &error, sum + error);
        for _ in 0..self.halvings {
            low = (&low * &low) >> self.places;
            high = ((&high * &high) >> self.places) + 1_u8;
        }
        let exponent = k.to_i64().ok_or(Overflow)? - i64::try_from(self.places).map_err(|_| Overflow)?;
        Ok(Interval::between(Dyadic::new(low, exponent), Dyadic::new(high, exponent)))
    }
}

impl Interval {
    /// exp(x), to about so many bits, as by [`Exponentials`].
    ///
    /// # Errors
    ///
    /// [`Overflow`] for x above 2⁶².
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
        Exponentials::new(bits).of(x)
    }
}

/// exp(r) for r = `fixed` · 2^−places, 0 ≤ r < 1, in the same units, and how many units it may be off.
fn series(fixed: &BigInt, places: u64) -> (BigInt, BigInt) {
    let mut term = BigInt::one() << places;
    let mut sum = term.clone();
    let mut count = 0_u64;
    while !term.is_zero() {
        count += 1;
        // The error e of a term: e_j ≤ (e_{j−1} + 1)/j + 1, from the two truncations; so e_j ≤ 5/2.
        term = ((term * fixed) >> places) / count;
        sum += &term;
    }
    // The last true term is at most 5/2, and those left out add up to no more than it, as each is at most half of the one
    // before.
    (sum, BigInt::from(3 * count + 3))
}
