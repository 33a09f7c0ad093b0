//! What every covariance must be, whatever its digits.

use super::Scale;
use crate::matrix::{Indefinite, LdlError, Matrix};
use crate::scalar::{Rational, Scalar, exact_value, ratio};

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

/// Whether an answered covariance is positive semidefinite, decided exactly; an asymmetric one is judged by its
/// lower triangle.
pub(super) fn indefiniteness(theirs: &Matrix<Rational>, scale: &Scale, allowed_error: f64) -> Option<Indefiniteness> {
    let n = theirs.rows();
    let matrix = Matrix::from_fn(n, n, |i, j| theirs[(i.max(j), i.min(j))].clone());
    let Err(LdlError::Indefinite(proof)) = matrix.ldl() else { return None };
    let size = ratio(i64::try_from(n).unwrap_or(i64::MAX), 1);
    let raise = exact_value(allowed_error).unwrap_or_else(Rational::zero).times(&size);
    let raised = &matrix + scale.diagonal().scaled(&raise);
    Some(Indefiniteness { beyond_rounding: raised.ldl().is_err(), matrix, proof })
}
