//! Mean and covariance, and the way between the two matrix types.

use nalgebra::{DMatrix, DVector};

use super::error::Obstacle;
use crate::matrix::Matrix;

/// The mean and the covariance of a state.
#[derive(Clone, Debug)]
pub(super) struct Moments {
    /// n×1
    pub(super) mean: DVector<f64>,
    /// n×n
    pub(super) covariance: DMatrix<f64>,
}

/// The entries of a matrix of the library.
pub(super) fn dense(matrix: &Matrix<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(matrix.rows(), matrix.columns(), |i, j| matrix[(i, j)])
}

/// The entries of a matrix of one column.
pub(super) fn dense_column(matrix: &Matrix<f64>) -> DVector<f64> {
    DVector::from_column_slice(matrix.entries())
}

/// A matrix of the library with these entries, all finite.
///
/// # Errors
///
/// [`Obstacle::NotFinite`] if one is not.
pub(super) fn finite(matrix: &DMatrix<f64>) -> Result<Matrix<f64>, Obstacle> {
    if matrix.iter().all(|entry| entry.is_finite()) {
        Ok(Matrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)]))
    } else {
        Err(Obstacle::NotFinite)
    }
}

/// As [`finite`], for a column.
///
/// # Errors
///
/// [`Obstacle::NotFinite`] if an entry is not finite.
pub(super) fn finite_column(column: &DVector<f64>) -> Result<Matrix<f64>, Obstacle> {
    if column.iter().all(|entry| entry.is_finite()) {
        Ok(Matrix::column(column.iter().copied().collect()))
    } else {
        Err(Obstacle::NotFinite)
    }
}
