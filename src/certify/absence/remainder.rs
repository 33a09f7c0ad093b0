//! Fields in which a search costs the same whatever the numbers are, and fractions read back from them.

use num_bigint::{BigInt, BigUint};
use num_integer::Integer;
use num_traits::{Signed, Zero};

use crate::scalar::{Field, Mersenne61, Rational, Scalar, Undefined, ZeroTest};

/// A prime field with the fractions that its elements may stand for.
///
/// What is found here is a proposal, to be checked over the fractions. Only ranks and degrees prove something by
/// themselves: a minor that is not zero modulo a prime is not zero.
pub(super) trait Remainder: Field {
    /// The image of a fraction, if the prime does not divide its denominator.
    fn image(value: &Rational) -> Option<Self>;

    /// The one fraction a/b with this image and |a|, b ≤ √(P/2), if there is one.
    fn fraction(&self) -> Option<Rational>;
}

impl Remainder for Mersenne61 {
    fn image(value: &Rational) -> Option<Self> {
        Self::image(value)
    }

    fn fraction(&self) -> Option<Rational> {
        reconstructed(self.representative().into(), (BigInt::from(1) << 61u32) - 1)
    }
}

/// The integers modulo the prime 2^E − 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Mersenne<const E: u64>(BigUint);

/// The integers modulo 2⁵²¹ − 1.
pub(super) type Mersenne521 = Mersenne<521>;
/// The integers modulo 2²²⁰³ − 1.
pub(super) type Mersenne2203 = Mersenne<2203>;

impl<const E: u64> Mersenne<E> {
    fn modulus() -> BigUint {
        (BigUint::from(1u32) << E) - 1u32
    }

    /// 2^E = 1, so what stands above the lowest E bits is added to them.
    fn reduced(mut value: BigUint) -> Self {
        let modulus = Self::modulus();
        while value.bits() > E {
            value = (&value & &modulus) + (value >> E);
        }
        Self(if value == modulus { BigUint::zero() } else { value })
    }

    fn of_integer(value: &BigInt) -> Self {
        let image = Self::reduced(value.magnitude().clone());
        if value.is_negative() { image.negated() } else { image }
    }
}

impl<const E: u64> Scalar for Mersenne<E> {
    fn zero() -> Self {
        Self(BigUint::zero())
    }

    fn one() -> Self {
        Self(BigUint::from(1u32))
    }

    fn plus(&self, other: &Self) -> Self {
        Self::reduced(&self.0 + &other.0)
    }

    fn minus(&self, other: &Self) -> Self {
        Self::reduced(if self.0 >= other.0 { &self.0 - &other.0 } else { &self.0 + Self::modulus() - &other.0 })
    }

    fn times(&self, other: &Self) -> Self {
        Self::reduced(&self.0 * &other.0)
    }

    fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
        let inverse = divisor.0.modinv(&Self::modulus()).ok_or(Undefined::DivisionByZero)?;
        Ok(self.times(&Self(inverse)))
    }

    fn zero_test(&self) -> ZeroTest {
        if self.0.is_zero() { ZeroTest::Zero } else { ZeroTest::Nonzero }
    }
}

impl<const E: u64> Field for Mersenne<E> {}

impl<const E: u64> Remainder for Mersenne<E> {
    fn image(value: &Rational) -> Option<Self> {
        Self::of_integer(value.numer()).over(&Self::of_integer(value.denom())).ok()
    }

    fn fraction(&self) -> Option<Rational> {
        reconstructed(BigInt::from(self.0.clone()), BigInt::from(Self::modulus()))
    }
}

/// Euclid's algorithm on the modulus and the remainder, stopped half way (P. S. Wang, 1981).
fn reconstructed(remainder: BigInt, modulus: BigInt) -> Option<Rational> {
    let bound = (&modulus / 2u32).sqrt();
    // Throughout: before = s · remainder and now = t · remainder, modulo the modulus.
    let (mut before, mut now) = (modulus, remainder);
    let (mut s, mut t) = (BigInt::from(0), BigInt::from(1));
    while now > bound {
        let (quotient, rest) = before.div_rem(&now);
        (before, now) = (now, rest);
        let next = &s - quotient * &t;
        (s, t) = (t, next);
    }
    (!t.is_zero() && t.abs() <= bound && now.gcd(&t) == BigInt::from(1)).then(|| Rational::new(now, t))
}
