//! How the numbers of an answer are written: as decimals of so many digits, or as fractions in lowest terms.

use std::fmt::Display;

use crate::matrix::{Fractions, Matrix};
use crate::protocol::{AnswerNumber, Decimal};
use crate::scalar::{Precision, Rational};

/// From the results of a filter to numbers that are printed.
pub(super) trait Notation {
    /// A number as it is printed.
    type Number: AnswerNumber + Clone + Display;

    /// A fraction in lowest terms.
    fn fraction(&self, value: &Rational) -> Self::Number;

    /// A matrix of integers over one denominator; of one that is symmetric each pair is worked out once.
    fn matrix(&self, values: &Fractions, is_symmetric: bool) -> Matrix<Self::Number>;
}

/// Correctly rounded decimals, mostly from the leading bits of two integers: no fraction is brought to lowest terms for them.
pub(super) struct Decimals {
    pub(super) digits: u32,
}

impl Notation for Decimals {
    type Number = Decimal;

    fn fraction(&self, value: &Rational) -> Decimal {
        Decimal::rounded(value, self.digits)
    }

    fn matrix(&self, values: &Fractions, is_symmetric: bool) -> Matrix<Decimal> {
        let decimal = |i, j| Decimal::of_quotient(values.quotient(i, j), self.digits);
        let (rows, columns) = (values.numerators.rows(), values.numerators.columns());
        if !is_symmetric {
            return Matrix::from_fn(rows, columns, decimal);
        }
        let lower: Vec<Vec<Decimal>> = (0..rows).map(|i| (0..=i).map(|j| decimal(i, j)).collect()).collect();
        Matrix::from_fn(rows, columns, |i, j| lower[i.max(j)][i.min(j)].clone())
    }
}

/// Fractions in lowest terms.
pub(super) struct LowestTerms;

impl Notation for LowestTerms {
    type Number = Rational;

    fn fraction(&self, value: &Rational) -> Rational {
        value.clone()
    }

    fn matrix(&self, values: &Fractions, is_symmetric: bool) -> Matrix<Rational> {
        if is_symmetric { values.symmetric(Precision::Exact) } else { values.entrywise(Precision::Exact) }
    }
}
