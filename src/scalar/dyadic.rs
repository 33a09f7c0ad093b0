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
/// Sums of numbers of very different size cost no more than their bits: 1 + 2^(−10¹²) is 1 or a little more. Exponents
/// beyond ±2⁶³ saturate, and are then no longer right; exponentials of this crate stay within ±2⁶³ by a wide margin.
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

impl Dyadic {
    /// `mantissa · 2^exponent`
    pub fn new(mantissa: BigInt, exponent: i64) -> Self {
        match mantissa.trailing_zeros() {
            None => Self { mantissa, exponent: 0 },
            Some(even) => Self { mantissa: mantissa >> even, exponent: exponent.saturating_add(length(even)) },
        }
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
            Rational::new(self.mantissa.clone(), power)
        } else {
            (&self.mantissa * power).into()
        })
    }

    /// The e with 2^(e−1) ≤ |x| < 2^e; nothing for zero.
    pub fn magnitude(&self) -> Option<i64> {
        (!self.is_zero()).then(|| self.exponent.saturating_add(length(self.mantissa.bits())))
    }

    /// The number with at most so many bits.
    pub fn shortened(&self, bits: u64, toward: Toward) -> Self {
        let excess = self.mantissa.bits().saturating_sub(bits.max(1));
        if excess == 0 {
            return self.clone();
        }
        // Shifts of integers round below, of negative ones too.
        let below = &self.mantissa >> excess;
        let mantissa = if toward == Toward::Above { below + 1 } else { below };
        Self::new(mantissa, self.exponent.saturating_add(length(excess)))
    }

    /// The sum.
    pub fn plus(&self, other: &Self, bits: u64, toward: Toward) -> Self {
        let (Some(own), Some(others)) = (self.magnitude(), other.magnitude()) else {
            return if self.is_zero() { other.shortened(bits, toward) } else { self.shortened(bits, toward) };
        };
        let (large, small) = if own >= others { (self, other) } else { (other, self) };
        // What lies below all bits that are kept only decides where the rest is rounded to.
        let least = large.exponent.min(own.max(others).saturating_sub(length(bits) + 2));
        let small = if small.exponent.saturating_add(length(small.mantissa.bits())) < least.saturating_sub(2) {
            let sign = if small.is_negative() { -1 } else { 1 };
            Self { mantissa: BigInt::from(sign), exponent: least.saturating_sub(2) }
        } else {
            small.clone()
        };
        let exponent = large.exponent.min(small.exponent);
        let lifted = |x: &Self| &x.mantissa << x.exponent.saturating_sub(exponent).unsigned_abs();
        Self::new(lifted(large) + lifted(&small), exponent).shortened(bits, toward)
    }

    /// The number with the other sign.
    pub fn negated(&self) -> Self {
        Self { mantissa: -&self.mantissa, exponent: self.exponent }
    }

    /// The product.
    pub fn times(&self, other: &Self, bits: u64, toward: Toward) -> Self {
        let exponent = self.exponent.saturating_add(other.exponent);
        Self::new(&self.mantissa * &other.mantissa, exponent).shortened(bits, toward)
    }

    /// The quotient; nothing where the divisor is zero.
    pub fn over(&self, divisor: &Self, bits: u64, toward: Toward) -> Option<Self> {
        let exponent = self.exponent.saturating_sub(divisor.exponent);
        (!divisor.is_zero()).then(|| quotient(&self.mantissa, &divisor.mantissa, exponent, bits, toward))
    }
}

/// `numerator / denominator · 2^exponent` to so many bits.
fn quotient(numerator: &BigInt, denominator: &BigInt, exponent: i64, bits: u64, toward: Toward) -> Dyadic {
    // The quotient of integers gets at least `bits` bits.
    let shift = (bits + 1 + denominator.bits()).saturating_sub(numerator.bits());
    let (mut whole, rest) = (numerator << shift).div_mod_floor(denominator);
    if toward == Toward::Above && !rest.is_zero() {
        whole += 1;
    }
    Dyadic::new(whole, exponent.saturating_sub(length(shift))).shortened(bits, toward)
}

/// A count of bits as a difference of exponents.
fn length(bits: u64) -> i64 {
    i64::try_from(bits).unwrap_or(i64::MAX)
}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Self) -> Ordering {
        let signs = self.mantissa.sign().cmp(&other.mantissa.sign());
        let sizes = self.magnitude().cmp(&other.magnitude());
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
