//! The exact rationals, on [`num_rational::BigRational`].

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::gcd::common_divisor;
use super::{Field, OrderedField, Scalar, Undefined, ZeroTest};

/// An exact fraction in lowest terms with a positive denominator: the type the ecosystem already has.
///
/// # Examples
///
/// ```
/// use exact_kalman::scalar::{ratio, Rational, Scalar};
///
/// let third: Rational = ratio(1, 3);
/// assert_eq!(third.plus(&ratio(1, 6)), ratio(1, 2));
/// ```
pub type Rational = BigRational;

/// The fraction of two small integers, in lowest terms.
///
/// # Panics
///
/// If the denominator is zero. This is for constants in programs; numbers that come from outside are read
/// by the protocol room.
pub fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

/// `left ± right`; both are in lowest terms, so only a common factor of the denominators can cancel.
fn sum(left: &Rational, right: &Rational, subtract: bool) -> Rational {
    let join = |a: BigInt, b: BigInt| if subtract { a - b } else { a + b };
    let (a, b, c, d) = (left.numer(), left.denom(), right.numer(), right.denom());
    let shared = common_divisor(b, d);
    if shared.is_one() {
        return Rational::new_raw(join(a * d, c * b), b * d);
    }
    let (b_part, d_part) = (b / &shared, d / &shared);
    let numerator = join(a * &d_part, c * &b_part);
    // Any common factor of the numerator and b·d/shared divides `shared` (Knuth 4.5.1).
    let rest = common_divisor(&numerator, &shared);
    if rest.is_one() {
        Rational::new_raw(numerator, b_part * d)
    } else {
        Rational::new_raw(numerator / &rest, b_part * (d / rest))
    }
}

/// The product of `a/b` and `c/d`, each in lowest terms: only the crossed pairs can cancel.
fn product(a: &BigInt, b: &BigInt, c: &BigInt, d: &BigInt) -> Rational {
    let left = common_divisor(a, d);
    let right = common_divisor(c, b);
    Rational::new_raw((a / &left) * (c / &right), (b / right) * (d / left))
}

impl Scalar for Rational {
    fn zero() -> Self {
        Zero::zero()
    }

    fn one() -> Self {
        One::one()
    }

    fn plus(&self, other: &Self) -> Self {
        sum(self, other, false)
    }

    fn minus(&self, other: &Self) -> Self {
        sum(self, other, true)
    }

    fn times(&self, other: &Self) -> Self {
        if Zero::is_zero(self) || Zero::is_zero(other) {
            return Scalar::zero();
        }
        product(self.numer(), self.denom(), other.numer(), other.denom())
    }

    fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
        if Zero::is_zero(divisor) {
            return Err(Undefined::DivisionByZero);
        }
        if Zero::is_zero(self) {
            return Ok(Scalar::zero());
        }
        let quotient = product(self.numer(), self.denom(), divisor.denom(), divisor.numer());
        let negative = quotient.denom().sign() == num_bigint::Sign::Minus;
        Ok(if negative {
            let (numerator, denominator) = quotient.into_raw();
            Rational::new_raw(-numerator, -denominator)
        } else {
            quotient
        })
    }

    fn zero_test(&self) -> ZeroTest {
        if Zero::is_zero(self) { ZeroTest::Zero } else { ZeroTest::Nonzero }
    }

    fn from_integer(value: i64) -> Self {
        Rational::from(BigInt::from(value))
    }
}

impl Field for Rational {}
impl OrderedField for Rational {}
