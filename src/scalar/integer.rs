//! The integers: a scalar whose quotients must be exact, for fraction-free work.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};

use super::{Scalar, Undefined, ZeroTest};

impl Scalar for BigInt {
    fn zero() -> Self {
        Zero::zero()
    }

    fn one() -> Self {
        One::one()
    }

    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn minus(&self, other: &Self) -> Self {
        self - other
    }

    fn times(&self, other: &Self) -> Self {
        self * other
    }

    fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
        if divisor.is_zero() {
            return Err(Undefined::DivisionByZero);
        }
        if divisor.is_one() {
            return Ok(self.clone());
        }
        let (quotient, remainder) = self.div_rem(divisor);
        if remainder.is_zero() { Ok(quotient) } else { Err(Undefined::OutsideTheRing) }
    }

    fn zero_test(&self) -> ZeroTest {
        if self.is_zero() { ZeroTest::Zero } else { ZeroTest::Nonzero }
    }

    fn from_integer(value: i64) -> Self {
        value.into()
    }
}
