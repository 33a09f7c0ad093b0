//! Matrices of fractions as integers over one denominator: the form in which heavy work is done.

use num_bigint::BigInt;
use num_traits::{One, Zero};

use super::Matrix;
use crate::scalar::{Precision, Rational, common_divisor};

/// `numerators / denominator`, not in lowest terms; the denominator is positive.
#[derive(Clone, Debug)]
pub struct Fractions {
    /// The integers.
    pub numerators: Matrix<BigInt>,
    /// Their common denominator.
    pub denominator: BigInt,
}

impl Fractions {
    /// The matrix over the least common denominator of its entries.
    pub fn of(matrix: &Matrix<Rational>) -> Self {
        let denominator =
            matrix.entries().iter().fold(BigInt::one(), |all, entry| least_common_multiple(all, entry.denom()));
        Self { numerators: matrix.map(|entry| entry.numer() * (&denominator / entry.denom())), denominator }
    }

    /// Every entry in lowest terms, or rounded.
    pub fn entrywise(&self, precision: Precision) -> Matrix<Rational> {
        self.numerators.map(|numerator| precision.quotient(numerator, &self.denominator))
    }

    /// The entries of a symmetric matrix, each pair worked out once.
    ///
    /// # Panics
    ///
    /// If the matrix is not square.
    pub fn symmetric(&self, precision: Precision) -> Matrix<Rational> {
        let n = self.numerators.rows();
        assert_eq!(n, self.numerators.columns(), "a symmetric matrix is square");
        let lower = Matrix::from_fn(n, n, |i, j| {
            if j <= i { precision.quotient(&self.numerators[(i, j)], &self.denominator) } else { Rational::zero() }
        });
        Matrix::from_fn(n, n, |i, j| lower[(i.max(j), i.min(j))].clone())
    }

    /// The same matrix over a multiple of its denominator.
    pub(crate) fn over(&self, multiple: &BigInt) -> Matrix<BigInt> {
        let factor = multiple / &self.denominator;
        self.numerators.map(|entry| entry * &factor)
    }
}

/// The least positive multiple of two positive integers.
pub(crate) fn least_common_multiple(left: BigInt, right: &BigInt) -> BigInt {
    if right.is_one() || left == *right {
        return left;
    }
    let shared = common_divisor(&left, right);
    left / shared * right
}
