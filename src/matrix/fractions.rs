//! Matrices of fractions as integers over one denominator: the form in which heavy work is done.

use num_bigint::BigInt;
use num_traits::{One, Signed};

use super::Matrix;
use super::lowest_terms::lowest_terms;
use crate::scalar::{Precision, Quotient, Rational, common_divisor};

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

    /// One entry, as a quotient to be rounded.
    ///
    /// # Panics
    ///
    /// If the denominator is not positive.
    pub fn quotient(&self, row: usize, column: usize) -> Quotient<'_> {
        Quotient::new(&self.numerators[(row, column)], &self.denominator)
    }

    /// The nearest double to each entry, rounded once, without lowest terms.
    ///
    /// # Panics
    ///
    /// If the denominator is not positive.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::matrix::{Fractions, Matrix};
    /// use num_bigint::BigInt;
    ///
    /// let numerators = Matrix::from_fn(1, 2, |_, j| BigInt::from([2, -5][j]));
    /// let fractions = Fractions { numerators, denominator: BigInt::from(10) };
    /// assert_eq!(fractions.doubles(), Matrix::from_fn(1, 2, |_, j| [0.2, -0.5][j]));
    /// ```
    pub fn doubles(&self) -> Matrix<f64> {
        self.numerators.map(|numerator| Quotient::new(numerator, &self.denominator).nearest_double())
    }

    /// Every entry in lowest terms, or rounded.
    ///
    /// # Panics
    ///
    /// If the denominator is not positive.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::matrix::{Fractions, Matrix};
    /// use exact_kalman::scalar::{Precision, ratio};
    /// use num_bigint::BigInt;
    ///
    /// let numerators = Matrix::from_fn(1, 2, |_, j| BigInt::from([2, -5][j]));
    /// let fractions = Fractions { numerators, denominator: BigInt::from(10) };
    /// let exact = fractions.entrywise(Precision::Exact);
    /// assert_eq!(exact, Matrix::from_fn(1, 2, |_, j| [ratio(1, 5), ratio(-1, 2)][j].clone()));
    /// ```
    pub fn entrywise(&self, precision: Precision) -> Matrix<Rational> {
        let entries: Vec<&BigInt> = self.numerators.entries().iter().collect();
        let mut values = self.handed_out(&entries, precision).into_iter();
        self.numerators.map(|_| values.next().unwrap_or_default())
    }

    /// The entries of a symmetric matrix, each pair worked out once, from the lower triangle.
    ///
    /// # Panics
    ///
    /// If the matrix is not square, or the denominator not positive.
    pub fn symmetric(&self, precision: Precision) -> Matrix<Rational> {
        let n = self.numerators.rows();
        assert_eq!(n, self.numerators.columns(), "a symmetric matrix is square");
        let lower = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
        let entries: Vec<&BigInt> = lower.map(|(i, j)| &self.numerators[(i, j)]).collect();
        let values = self.handed_out(&entries, precision);
        Matrix::from_fn(n, n, |i, j| {
            let (row, column) = (i.max(j), i.min(j));
            values[row * (row + 1) / 2 + column].clone()
        })
    }

    fn handed_out(&self, numerators: &[&BigInt], precision: Precision) -> Vec<Rational> {
        assert!(self.denominator.is_positive(), "a denominator is positive");
        match precision {
            Precision::Exact => lowest_terms(numerators, &self.denominator),
            Precision::Rounded { .. } => {
                let quotient = |numerator| Quotient::new(numerator, &self.denominator);
                numerators.iter().map(|numerator| quotient(numerator).handed_out(precision)).collect()
            }
        }
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
