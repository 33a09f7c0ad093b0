//! What every covariance must be, whatever its digits.

use super::Scale;
use crate::matrix::{Indefinite, LdlError, Matrix};
use crate::scalar::{Rational, Scalar, ratio};

/// A covariance that is not positive semidefinite, exactly as it was answered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Indefiniteness {
    /// The covariance P, its lower triangle taken for both.
    pub matrix: Matrix<Rational>,
    /// A vector v with vᵀPv < 0.
    pub proof: Indefinite<Rational>,
    /// Whether it stays indefinite when each variance is raised by the error that its digits allow.
    pub beyond_rounding: bool,
}

/// Two mirrored entries of a covariance that are not the same number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Asymmetry {
    /// The row of the one and the column of the other, counted from 0.
    pub row: usize,
    /// The column of the one and the row of the other.
    pub column: usize,
    /// Whether they differ by more than the error that the digits allow.
    pub beyond_rounding: bool,
}

/// Whether an answered covariance is positive semidefinite, decided exactly; an asymmetric one is judged by its
/// lower triangle. No allowed error means that any is.
pub(super) fn indefiniteness(
    theirs: &Matrix<Rational>,
    scale: &Scale,
    allowed_error: Option<&Rational>,
) -> Option<Indefiniteness> {
    let n = theirs.rows();
    let matrix = Matrix::from_fn(n, n, |i, j| theirs[(i.max(j), i.min(j))].clone());
    let Err(LdlError::Indefinite(proof)) = matrix.ldl() else { return None };
    let beyond_rounding = allowed_error.is_some_and(|allowed| {
        let size = ratio(i64::try_from(n).unwrap_or(i64::MAX), 1);
        (&matrix + scale.diagonal().scaled(&allowed.times(&size))).ldl().is_err()
    });
    Some(Indefiniteness { matrix, proof, beyond_rounding })
}

/// The first two mirrored entries that differ, those that differ by more than the allowed error first.
pub(super) fn asymmetry(
    theirs: &Matrix<Rational>,
    scale: &Scale,
    allowed_error: Option<&Rational>,
) -> Option<Asymmetry> {
    let (row, column) = theirs.asymmetry()?;
    let beyond = |&(row, column): &(usize, usize)| {
        let difference = theirs[(row, column)].minus(&theirs[(column, row)]);
        let unit = scale.variance(row).times(scale.variance(column));
        allowed_error.is_some_and(|allowed| difference.times(&difference) > allowed.times(allowed).times(&unit))
    };
    let mut pairs = (0..theirs.rows()).flat_map(|row| (0..row).map(move |column| (column, row)));
    Some(match pairs.find(beyond) {
        Some((row, column)) => Asymmetry { row, column, beyond_rounding: true },
        None => Asymmetry { row, column, beyond_rounding: false },
    })
}
