//! Residues modulo a prime: a field without order, in which no number grows.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{ToPrimitive, Zero};

use super::{Field, Rational, Scalar, Undefined, ZeroTest};

/// The integers modulo the prime `P`.
///
/// Identities of rational functions that hold modulo a large prime at a random point hold with a stated
/// probability (Schwartz–Zippel); small primes make exhaustive worlds. `P` must be a prime below 2⁶³;
/// the compiler refuses even moduli and moduli out of range, the laws catch a composite one.
///
/// # Examples
///
/// ```
/// use exact_kalman::scalar::{Residue, Scalar};
///
/// let three = Residue::<7>::from_integer(3);
/// let five = Residue::<7>::one().over(&three)?;
/// assert_eq!(five, Residue::from_integer(5));
/// # Ok::<(), exact_kalman::scalar::Undefined>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Residue<const P: u64>(u64);

/// The residues modulo the Mersenne prime 2⁶¹ − 1.
pub type Mersenne61 = Residue<{ (1 << 61) - 1 }>;

impl<const P: u64> Residue<P> {
    const MODULUS: u64 = {
        assert!(P > 1 && P < 1 << 63 && (P == 2 || P % 2 == 1), "P must be a prime below 2^63");
        P
    };

    /// The residue of a machine integer.
    pub const fn new(value: u64) -> Self {
        Self(value % Self::MODULUS)
    }

    /// The representative in `0..P`.
    pub const fn representative(self) -> u64 {
        self.0
    }

    /// The image of a fraction, or nothing if `P` divides its denominator.
    ///
    /// Where it exists it is a homomorphism: sums, products and quotients commute with it.
    pub fn image(value: &Rational) -> Option<Self> {
        let modulus = BigInt::from(Self::MODULUS);
        let residue = |n: &BigInt| n.mod_floor(&modulus).to_u64().map(Self);
        let denominator = residue(value.denom()).filter(|d| !d.0.is_zero())?;
        residue(value.numer())?.over(&denominator).ok()
    }

    fn power(self, mut exponent: u64) -> Self {
        let (mut base, mut result) = (self, Self::one());
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = result.times(&base);
            }
            base = base.times(&base);
            exponent >>= 1;
        }
        result
    }
}

impl<const P: u64> std::fmt::Debug for Residue<P> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} mod {P}", self.0)
    }
}

impl<const P: u64> std::fmt::Display for Residue<P> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.fmt(f)
    }
}

impl<const P: u64> Scalar for Residue<P> {
    fn zero() -> Self {
        Self(0)
    }

    fn one() -> Self {
        Self(1)
    }

    fn plus(&self, other: &Self) -> Self {
        // Both are below P < 2^63: the sum fits.
        let sum = self.0 + other.0;
        Self(if sum >= Self::MODULUS { sum - P } else { sum })
    }

    fn minus(&self, other: &Self) -> Self {
        Self(if self.0 >= other.0 { self.0 - other.0 } else { self.0 + Self::MODULUS - other.0 })
    }

    fn times(&self, other: &Self) -> Self {
        let product = u128::from(self.0) * u128::from(other.0) % u128::from(Self::MODULUS);
        #[expect(clippy::cast_possible_truncation, reason = "a remainder modulo P < 2^63")]
        Self(product as u64)
    }

    fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
        if divisor.0 == 0 {
            return Err(Undefined::DivisionByZero);
        }
        // Fermat: d^(P-2) is the inverse of d.
        Ok(self.times(&divisor.power(Self::MODULUS - 2)))
    }

    fn zero_test(&self) -> ZeroTest {
        if self.0 == 0 { ZeroTest::Zero } else { ZeroTest::Nonzero }
    }
}

impl<const P: u64> Field for Residue<P> {}
