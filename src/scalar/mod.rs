//! Floor 0 · Numbers, and what each of them can decide.
//!
//! Holds the three traits on which everything above is written, the exact rationals and the residues
//! modulo a prime. Holds no matrix and no floating point: `f64` is deliberately no [`Scalar`], since no
//! exact question can be asked of it; the two ways between doubles and rationals are exact or rounded once.
//!
//! | scalar | [`Scalar`] | [`Field`] | [`OrderedField`] | zero test |
//! |---|---|---|---|---|
//! | [`Rational`] | yes | yes | yes | always decides |
//! | [`Residue`] | yes | yes | no: an order modulo p means nothing | always decides |
//! | [`RationalFunction`] | yes | yes | no | decides, unless too large |
//! | [`num_bigint::BigInt`] | yes | no: quotients must be exact | no | always decides |
//!
//! A trait is a document: generic code relies on nothing but what is written here, and every promise has
//! a law in [`laws`].

mod circle;
mod dyadic;
mod exponential;
mod float;
mod gcd;
mod integer;
mod interval;
pub mod laws;
mod logarithm;
mod normal;
mod polynomial;
mod precision;
mod quotient;
mod rational;
mod rational_function;
mod residue;

pub use dyadic::{Dyadic, Toward};
pub use exponential::{Exponentials, Overflow};
pub use float::{exact_value, nearest_double, nearest_single};
pub use gcd::common_divisor;
pub use interval::Interval;
pub use logarithm::Logarithms;
pub use precision::Precision;
pub use quotient::Quotient;
pub use rational::{Rational, ratio};
pub use rational_function::RationalFunction;
pub use residue::{Mersenne61, Residue};

/// What a scalar knows about the question "is this zero?".
///
/// "Undecided" is a third answer. It is never merged with either of the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ZeroTest {
    /// Certainly zero.
    Zero,
    /// Certainly not zero.
    Nonzero,
    /// The representation cannot tell (a ball that contains zero and more).
    Undecided,
}

/// Why a quotient has no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Undefined {
    /// The divisor is zero.
    #[error("division by zero")]
    DivisionByZero,
    /// The divisor may be zero; the representation cannot tell.
    #[error("division by a value that may be zero")]
    Undecided,
    /// The quotient lies outside the ring (7/2 among the integers).
    #[error("the quotient is not an element of the ring")]
    OutsideTheRing,
    /// It depends on a reading that is missing (coefficients of a system; no arithmetic says so).
    #[error("it depends on a reading that is missing")]
    Missing,
}

/// Values on which the filter's equations can be evaluated.
///
/// The operations are methods with words of their own (`plus`, not `add`) and take references: an owned
/// big number that also implements [`std::ops::Add`] would otherwise be moved by `a.add(&b)`.
pub trait Scalar: Clone + std::fmt::Debug + 'static {
    /// The neutral element of addition.
    fn zero() -> Self;
    /// The neutral element of multiplication.
    fn one() -> Self;
    /// The sum.
    fn plus(&self, other: &Self) -> Self;
    /// The difference.
    fn minus(&self, other: &Self) -> Self;
    /// The product.
    fn times(&self, other: &Self) -> Self;
    /// The quotient.
    ///
    /// # Errors
    ///
    /// [`Undefined`] if the divisor is zero, or may be, or the quotient is no element of the ring.
    fn over(&self, divisor: &Self) -> Result<Self, Undefined>;
    /// Whether the value is zero, as far as the representation can tell.
    fn zero_test(&self) -> ZeroTest;

    /// The additive inverse.
    fn negated(&self) -> Self {
        Self::zero().minus(self)
    }

    /// The image of an integer, by doubling and adding.
    fn from_integer(value: i64) -> Self {
        let mut sum = Self::zero();
        for bit in (0..64).rev() {
            sum = sum.plus(&sum);
            if value.unsigned_abs() >> bit & 1 == 1 {
                sum = sum.plus(&Self::one());
            }
        }
        if value < 0 { sum.negated() } else { sum }
    }
}

/// A scalar on which the axioms of a field hold exactly and equality is decided.
///
/// [`Scalar::zero_test`] never answers [`ZeroTest::Undecided`], and agrees with `==`.
pub trait Field: Scalar + Eq {
    /// Whether the value is zero.
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

/// A field with the total order that its arithmetic respects.
///
/// `a ≤ b` implies `a + c ≤ b + c`, and `0 ≤ a`, `0 ≤ b` imply `0 ≤ ab`.
pub trait OrderedField: Field + Ord {}
