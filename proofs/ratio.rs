//! Numbers of fixed width with the traits of the library: exact, or a panic where they are too wide.

use std::cmp::Ordering;

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Field, OrderedField, Scalar, Undefined, ZeroTest, laws};

use crate::harness::{Replays, below, cover, harness};

/// The greatest common divisor, by Euclid.
pub fn common_divisor(mut left: i128, mut right: i128) -> i128 {
    while right != 0 {
        (left, right) = (right, left % right);
    }
    left.abs()
}

fn narrowed(value: i64) -> i32 {
    i32::try_from(value).unwrap_or_else(|_| panic!("{value} is too wide"))
}

/// A fraction in lowest terms, of words of half the width in which it is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ratio {
    numerator: i32,
    denominator: i32,
}

impl Ratio {
    /// `numerator / denominator`, the denominator not zero.
    pub fn new(numerator: i64, denominator: i64) -> Self {
        let (mut shared, mut rest) = (denominator, numerator);
        while rest != 0 {
            (shared, rest) = (rest, shared % rest);
        }
        // The denominator shall be positive.
        let shared = if (shared < 0) == (denominator < 0) { shared } else { -shared };
        Self { numerator: narrowed(numerator / shared), denominator: narrowed(denominator / shared) }
    }

    /// Both as wide numbers, whose products do not wrap.
    fn parts(self) -> (i64, i64) {
        (self.numerator.into(), self.denominator.into())
    }
}

impl From<i32> for Ratio {
    fn from(numerator: i32) -> Self {
        Self { numerator, denominator: 1 }
    }
}

impl Scalar for Ratio {
    fn zero() -> Self {
        0.into()
    }

    fn one() -> Self {
        1.into()
    }

    fn plus(&self, other: &Self) -> Self {
        let ((a, b), (c, d)) = (self.parts(), other.parts());
        Self::new(a * d + c * b, b * d)
    }

    fn minus(&self, other: &Self) -> Self {
        let ((a, b), (c, d)) = (self.parts(), other.parts());
        Self::new(a * d - c * b, b * d)
    }

    fn times(&self, other: &Self) -> Self {
        let ((a, b), (c, d)) = (self.parts(), other.parts());
        Self::new(a * c, b * d)
    }

    fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
        let ((a, b), (c, d)) = (self.parts(), divisor.parts());
        if c == 0 { Err(Undefined::DivisionByZero) } else { Ok(Self::new(a * d, b * c)) }
    }

    fn zero_test(&self) -> ZeroTest {
        if self.numerator == 0 { ZeroTest::Zero } else { ZeroTest::Nonzero }
    }
}

impl PartialOrd for Ratio {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Ratio {
    fn cmp(&self, other: &Self) -> Ordering {
        let ((a, b), (c, d)) = (self.parts(), other.parts());
        (a * d).cmp(&(c * b))
    }
}

impl Field for Ratio {}
impl OrderedField for Ratio {}

harness! {
    /// Fractions of fixed width are an ordered field.
    ///
    /// Domain: all triples of fractions with numerators from −2 to 2 and denominators from 1 to 3.
    fractions_of_fixed_width_are_an_ordered_field, unwind 94, Replays::All(15 * 15 * 15),
    covers ["in higher terms", "a divisor below zero", "division by zero"], {
        let fraction = || (integer(2), 1 + i64::try_from(below(3)).unwrap_or(0));
        let [x, y, z] = [(); 3].map(|()| fraction());
        cover!(x == (2, 2), "in higher terms");
        cover!(y.0 < 0, "a divisor below zero");
        cover!(y.0 == 0, "division by zero");
        let [a, b, c] = [x, y, z].map(|(numerator, denominator)| Ratio::new(numerator.into(), denominator));
        assert!(laws::ordered_field(&a, &b, &c) == Ok(()));
    }
}

/// An integer of fixed width: a quotient must be exact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Whole(pub i64);

impl Scalar for Whole {
    fn zero() -> Self {
        Self(0)
    }

    fn one() -> Self {
        Self(1)
    }

    fn plus(&self, other: &Self) -> Self {
        Self(self.0 + other.0)
    }

    fn minus(&self, other: &Self) -> Self {
        Self(self.0 - other.0)
    }

    fn times(&self, other: &Self) -> Self {
        Self(self.0 * other.0)
    }

    fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
        match (divisor.0, self.0.checked_rem(divisor.0)) {
            (0, _) => Err(Undefined::DivisionByZero),
            (_, Some(0)) => Ok(Self(self.0 / divisor.0)),
            _ => Err(Undefined::OutsideTheRing),
        }
    }

    fn zero_test(&self) -> ZeroTest {
        if self.0 == 0 { ZeroTest::Zero } else { ZeroTest::Nonzero }
    }
}

/// Any integer between `−bound` and `bound`.
pub fn integer(bound: u8) -> i32 {
    let value = below(2 * u64::from(bound) + 1);
    i32::try_from(value).unwrap_or(0) - i32::from(bound)
}

/// Any 2×2 matrix of integers up to a bound.
pub fn square(bound: u8) -> Matrix<Ratio> {
    Matrix::from_fn(2, 2, |_, _| integer(bound).into())
}

/// Any positive semidefinite 2×2 matrix of integers up to a bound: b² ≤ ac is generated, not asked for.
pub fn covariance(bound: u8) -> Matrix<Ratio> {
    let size = u64::from(bound) + 1;
    let [a, c] = [(); 2].map(|()| u8::try_from(below(size)).unwrap_or(0));
    let root = (0..=bound).rev().find(|root| u16::from(*root) * u16::from(*root) <= u16::from(a) * u16::from(c));
    let b = integer(root.unwrap_or(0));
    Matrix::from_fn(2, 2, |i, j| {
        if i != j {
            b
        } else if i == 0 {
            a.into()
        } else {
            c.into()
        }
        .into()
    })
}

/// Whether a symmetric 2×2 matrix is positive semidefinite: both entries of the diagonal and the determinant are.
pub fn is_semidefinite(p: &Matrix<Ratio>) -> bool {
    let (zero, at) = (Ratio::zero(), |i, j| &p[(i, j)]);
    let determinant = at(0, 0).times(at(1, 1)).minus(&at(0, 1).times(at(1, 0)));
    at(0, 1) == at(1, 0) && *at(0, 0) >= zero && *at(1, 1) >= zero && determinant >= zero
}
