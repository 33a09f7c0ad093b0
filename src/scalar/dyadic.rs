//! Dyadic numbers: integers times powers of two, with arithmetic rounded in a stated direction.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::Rational;

/// Where a result goes that does not fit into the bits it may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Toward {
    /// To the largest number that is not above it.
    Below,
    /// To the smallest number that is not below it.
    Above,
}

/// `mantissa · 2^exponent`; the mantissa is odd, or all is zero. So equal means equal.
///
/// Sums of numbers of very different size cost no more than their bits: 1 + 2^(−10¹²) is 1 or a little more. Results stay
/// within 2^±9·10¹⁸ about. Below that they are rounded as they are told, to zero or to the least number that is kept.
/// Above it, where a bound is wanted that there is not, an operation panics: exponentials of fractions above 2⁶² are
/// refused before they come so far.
///
/// # Examples
///
/// ```
/// use exact_kalman::scalar::{Dyadic, Toward, ratio};
///
/// let third = Dyadic::rounded(&ratio(1, 3), 4, Toward::Above);
/// assert_eq!(third.value(), Some(ratio(11, 32)));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dyadic {
    mantissa: BigInt,
    exponent: i64,
}

/// Beyond this exponent a number is not written out as a fraction.
const MOST_BITS: u64 = 1 << 24;

/// The largest magnitude of a result, and the negative of the least: exponents fit into 64 bits whatever the mantissa.
const FARTHEST: i64 = i64::MAX - (1 << 40);

impl Dyadic {
    /// `mantissa · 2^exponent`
    ///
    /// # Panics
    ///
    /// If its exponent does not fit into 64 bits once the mantissa is odd.
    pub fn new(mantissa: BigInt, exponent: i64) -> Self {
        let Some(even) = mantissa.trailing_zeros() else { return Self { mantissa, exponent: 0 } };
        let exponent = i64::try_from(even).ok().and_then(|even| exponent.checked_add(even));
        Self { mantissa: cut(mantissa, even), exponent: exponent.unwrap_or_else(|| panic!("{BEYOND}")) }
    }

    /// Zero.
    pub fn zero() -> Self {
        Self::new(BigInt::zero(), 0)
    }

    /// One.
    pub fn one() -> Self {
        Self::new(BigInt::one(), 0)
    }

    /// Whether it is zero.
    pub fn is_zero(&self) -> bool {
        self.mantissa.is_zero()
    }

    /// Whether it is below zero.
    pub fn is_negative(&self) -> bool {
        self.mantissa.is_negative()
    }

    /// A rational number, rounded to so many bits.
    pub fn rounded(value: &Rational, bits: u64, toward: Toward) -> Self {
        quotient(value.numer(), value.denom(), 0, bits, toward)
    }

    /// The number as a fraction; nothing where that would not fit into a reasonable memory.
    pub fn value(&self) -> Option<Rational> {
        let shift = self.exponent.unsigned_abs();
        if shift > MOST_BITS {
            return None;
        }
        let power = BigInt::one() << shift;
        Some(if self.exponent < 0 {
            // The mantissa is odd.
            Rational::new_raw(self.mantissa.clone(), power)
        } else {
            (&self.mantissa * power).into()
        })
    }

    /// The odd mantissa and the exponent; zeros for zero.
    pub fn parts(&self) -> (&BigInt, i64) {
        (&self.mantissa, self.exponent)
    }

    /// The e with 2^(e−1) ≤ |x| < 2^e; nothing for zero.
    pub fn magnitude(&self) -> Option<i64> {
        (!self.is_zero()).then(|| i64::try_from(self.size()).unwrap_or(i64::MAX))
    }

    /// The number with at most so many bits.
    pub fn shortened(&self, bits: u64, toward: Toward) -> Self {
        bounded(self.mantissa.clone(), self.exponent.into(), bits, toward)
    }

    /// The sum.
    ///
    /// # Panics
    ///
    /// As every operation: if a bound is wanted beyond the largest number that is kept.
    pub fn plus(&self, other: &Self, bits: u64, toward: Toward) -> Self {
        if self.is_zero() || other.is_zero() {
            return if self.is_zero() { other } else { self }.shortened(bits, toward);
        }
        let (large, small) = if self.size() >= other.size() { (self, other) } else { (other, self) };
        // What lies below all bits that are kept only decides where the rest is rounded to.
        let least = i128::from(large.exponent).min(large.size() - i128::from(bits) - 2);
        if small.size() < least - 2 {
            let unit = BigInt::from(if small.is_negative() { -1 } else { 1 });
            return bounded(
                lifted(&large.mantissa, i128::from(large.exponent) - least + 2) + unit,
                least - 2,
                bits,
                toward,
            );
        }
        let (high, low) = if large.exponent >= small.exponent { (large, small) } else { (small, large) };
        let common = i128::from(low.exponent);
        let sum = match i128::from(high.exponent) - common {
            0 => &high.mantissa + &low.mantissa,
            places => lifted(&high.mantissa, places) + &low.mantissa,
        };
        bounded(sum, common, bits, toward)
    }

    /// The number with the other sign.
    pub fn negated(&self) -> Self {
        Self { mantissa: -&self.mantissa, exponent: self.exponent }
    }

    /// The product.
    ///
    /// # Panics
    ///
    /// As [`Dyadic::plus`].
    pub fn times(&self, other: &Self, bits: u64, toward: Toward) -> Self {
        let exponent = i128::from(self.exponent) + i128::from(other.exponent);
        bounded(&self.mantissa * &other.mantissa, exponent, bits, toward)
    }

    /// The quotient; nothing where the divisor is zero.
    ///
    /// # Panics
    ///
    /// As [`Dyadic::plus`].
    pub fn over(&self, divisor: &Self, bits: u64, toward: Toward) -> Option<Self> {
        let exponent = i128::from(self.exponent) - i128::from(divisor.exponent);
        (!divisor.is_zero()).then(|| quotient(&self.mantissa, &divisor.mantissa, exponent, bits, toward))
    }

    /// The magnitude, which may lie a little beyond what an exponent may.
    fn size(&self) -> i128 {
        i128::from(self.exponent) + i128::from(self.mantissa.bits())
    }
}

const BEYOND: &str = "a number beyond 2^(2^63) has no bound here";

/// `numerator / denominator · 2^exponent` to so many bits.
fn quotient(numerator: &BigInt, denominator: &BigInt, exponent: i128, bits: u64, toward: Toward) -> Dyadic {
    // The quotient of integers gets at least `bits` bits.
    let shift = (bits + 1 + denominator.bits()).saturating_sub(numerator.bits());
    let (mut whole, rest) = (numerator << shift).div_mod_floor(denominator);
    if toward == Toward::Above && !rest.is_zero() {
        whole += 1;
    }
    bounded(whole, exponent - i128::from(shift), bits, toward)
}

/// `mantissa · 2^exponent` to so many bits, and within the numbers that are kept.
fn bounded(mantissa: BigInt, exponent: i128, bits: u64, toward: Toward) -> Dyadic {
    let excess = mantissa.bits().saturating_sub(bits.max(1));
    let (mantissa, exponent) = if excess == 0 {
        (mantissa, exponent)
    } else {
        let is_exact = mantissa.trailing_zeros().is_some_and(|zeros| zeros >= excess);
        // Shifts of integers round below, of negative ones too.
        let below = mantissa >> excess;
        let mantissa = if toward == Toward::Above && !is_exact { below + 1 } else { below };
        (mantissa, exponent + i128::from(excess))
    };
    let Some(even) = mantissa.trailing_zeros() else { return Dyadic::zero() };
    let (mantissa, exponent) = (cut(mantissa, even), exponent + i128::from(even));
    let size = exponent + i128::from(mantissa.bits());
    let outward = mantissa.is_negative() == (toward == Toward::Below);
    let end = |magnitude: i64| {
        let one = if mantissa.is_negative() { -BigInt::one() } else { BigInt::one() };
        Dyadic { mantissa: one, exponent: magnitude - 1 }
    };
    if size < -i128::from(FARTHEST) {
        // |x| < 2^−FARTHEST
        return if outward { end(1 - FARTHEST) } else { Dyadic::zero() };
    }
    if size > FARTHEST.into() {
        assert!(!outward, "{BEYOND}");
        return end(FARTHEST);
    }
    let exponent = i64::try_from(exponent).unwrap_or_else(|_| panic!("{BEYOND}"));
    Dyadic { mantissa, exponent }
}

/// `mantissa / 2^places`, where so many bits are zero.
fn cut(mantissa: BigInt, places: u64) -> BigInt {
    if places == 0 { mantissa } else { mantissa >> places }
}

/// `mantissa · 2^places`; there are few.
fn lifted(mantissa: &BigInt, places: i128) -> BigInt {
    mantissa << u64::try_from(places).unwrap_or_else(|_| unreachable!("the common exponent is the least"))
}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Self) -> Ordering {
        let signs = self.mantissa.sign().cmp(&other.mantissa.sign());
        let sizes = self.size().cmp(&other.size());
        if signs != Ordering::Equal || self.is_zero() {
            return signs;
        }
        let order = sizes.then_with(|| {
            // Of one magnitude: their exponents differ by no more than their lengths.
            let least = self.exponent.min(other.exponent);
            let lifted = |x: &Self| x.mantissa.magnitude() << x.exponent.abs_diff(least);
            lifted(self).cmp(&lifted(other))
        });
        if self.mantissa.sign() == Sign::Minus { order.reverse() } else { order }
    }
}
