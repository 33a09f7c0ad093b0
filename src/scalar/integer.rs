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

/// The greatest common divisor, without the quadratic cost that num-bigint's binary algorithm has when
/// the sizes differ (`gcd(x, 1)` is the common case).
pub(crate) fn common_divisor(left: &BigInt, right: &BigInt) -> BigInt {
    let (small, large) = if left.bits() <= right.bits() { (left, right) } else { (right, left) };
    if small.is_one() {
        return <BigInt as One>::one();
    }
    if small.is_zero() {
        return large.clone();
    }
    if large.bits() > small.bits() + 64 { small.gcd(&(large % small)) } else { small.gcd(large) }
}
