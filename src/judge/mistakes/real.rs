//! Numbers of 512 bits: what wrong recursions are run on.

use num_bigint::BigInt;
use num_traits::{Signed, Zero as _};

use crate::matrix::Matrix;
use crate::scalar::{Rational, Scalar, Undefined, ZeroTest};

/// Significant bits of each result. A double has 53, so some 400 are left for what cancels on the way.
const BITS: u64 = 512;

/// `mantissa · 2^exponent`, rounded down to 512 bits after each operation.
///
/// No law of a [`Scalar`] holds but up to rounding, and nothing here rests on one: the matrix operations are wanted.
#[derive(Clone, Debug)]
pub(super) struct Real {
    mantissa: BigInt,
    exponent: i64,
}

impl Real {
    fn rounded(mantissa: BigInt, exponent: i64) -> Self {
        if mantissa.is_zero() {
            return Self { mantissa, exponent: 0 };
        }
        match mantissa.bits().checked_sub(BITS) {
            None | Some(0) => Self { mantissa, exponent },
            Some(excess) => Self { mantissa: mantissa >> excess, exponent: exponent + signed(excess) },
        }
    }

    /// A number that is not negative is its root squared, up to rounding; nothing for the others.
    pub(super) fn root(&self) -> Option<Self> {
        if self.mantissa.is_negative() {
            return None;
        }
        let shift = 2 * BITS + u64::from(self.exponent % 2 != 0);
        Some(Self::rounded((&self.mantissa << shift).sqrt(), (self.exponent - signed(shift)) / 2))
    }

    /// The e with 2^(e−1) ≤ |x| < 2^e; less than any other for zero.
    pub(super) fn magnitude(&self) -> i64 {
        if self.mantissa.is_zero() { i64::MIN / 2 } else { self.exponent + signed(self.mantissa.bits()) }
    }

    /// The number, to 256 bits.
    pub(super) fn value(&self) -> Rational {
        const KEPT: u64 = 256;
        let excess = self.mantissa.bits().saturating_sub(KEPT);
        let mantissa = &self.mantissa >> excess;
        let Some(twos) = mantissa.trailing_zeros() else { return Rational::from(mantissa) };
        let exponent = self.exponent + signed(excess) + signed(twos);
        let (odd, power) = (mantissa >> twos, exponent.unsigned_abs());
        if exponent < 0 { Rational::new_raw(odd, BigInt::from(1) << power) } else { Rational::from(odd << power) }
    }
}

fn signed(bits: u64) -> i64 {
    i64::try_from(bits).unwrap_or(i64::MAX / 4)
}

impl From<&Rational> for Real {
    fn from(value: &Rational) -> Self {
        let (over, under) = (value.numer(), value.denom());
        let twos = under.trailing_zeros().unwrap_or(0);
        if under.bits() == twos + 1 {
            return Self::rounded(over.clone(), -signed(twos));
        }
        let shift = (BITS + under.bits()).saturating_sub(over.bits());
        Self::rounded((over << shift) / under, -signed(shift))
    }
}

/// The matrix in numbers of 512 bits.
pub(super) fn reals(matrix: &Matrix<Rational>) -> Matrix<Real> {
    matrix.map(|entry| Real::from(entry))
}

/// The matrix in fractions of 256 bits.
pub(super) fn rationals(matrix: &Matrix<Real>) -> Matrix<Rational> {
    matrix.map(Real::value)
}

impl Scalar for Real {
    fn zero() -> Self {
        Self { mantissa: BigInt::from(0), exponent: 0 }
    }

    fn one() -> Self {
        Self { mantissa: BigInt::from(1), exponent: 0 }
    }

    fn plus(&self, other: &Self) -> Self {
        if self.mantissa.is_zero() || other.mantissa.is_zero() {
            return if self.mantissa.is_zero() { other.clone() } else { self.clone() };
        }
        let (high, low) = if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        let places = high.exponent.abs_diff(low.exponent);
        // What lies below all bits that are kept is left out.
        if places > 3 * BITS {
            return high.clone();
        }
        Self::rounded((&high.mantissa << places) + &low.mantissa, low.exponent)
    }

    fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negated())
    }

    fn times(&self, other: &Self) -> Self {
        Self::rounded(&self.mantissa * &other.mantissa, self.exponent.saturating_add(other.exponent))
    }

    fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
        if divisor.mantissa.is_zero() {
            return Err(Undefined::DivisionByZero);
        }
        let shift = (BITS + divisor.mantissa.bits()).saturating_sub(self.mantissa.bits());
        let exponent = self.exponent - divisor.exponent - signed(shift);
        Ok(Self::rounded((&self.mantissa << shift) / &divisor.mantissa, exponent))
    }

    fn zero_test(&self) -> ZeroTest {
        if self.mantissa.is_zero() { ZeroTest::Zero } else { ZeroTest::Nonzero }
    }

    fn negated(&self) -> Self {
        Self { mantissa: -&self.mantissa, exponent: self.exponent }
    }
}
