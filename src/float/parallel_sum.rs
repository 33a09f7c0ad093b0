//! The parallel sum in `f64`.

use nalgebra::DMatrix;

use super::matrix_error::FloatMatrixError;
use super::moments::{dense, finite};
use super::pseudo_inverse::pseudo_inverse;
use super::symmetric::with_transpose;
use crate::matrix::Matrix;

/// F(F + G)⁺G with the pseudo-inverse by the spectrum; symmetric to the last bit (AK-Par in floating point).
///
/// Shapes: both n×n and symmetric.
///
/// # Errors
///
/// [`FloatMatrixError`] if the spectrum of F + G is not found, or an entry is not finite.
///
/// # Panics
///
/// If the matrices are not square, or of different orders.
///
/// # Examples
///
/// ```
/// use exact_kalman::{float, matrix::Matrix};
///
/// let [two, three] = [2.0, 3.0].map(|ohms| Matrix::column(vec![ohms]));
/// let sum = float::parallel_sum(&two, &three)?;
/// assert!((sum[(0, 0)] - 1.2).abs() < 1e-15);
/// # Ok::<(), exact_kalman::float::FloatMatrixError>(())
/// ```
pub fn parallel_sum(f: &Matrix<f64>, g: &Matrix<f64>) -> Result<Matrix<f64>, FloatMatrixError> {
    assert!(f.is_square() && f.shape() == g.shape(), "no parallel sum of {} and {}", f.shape(), g.shape());
    Ok(finite(&dense_parallel_sum(&dense(f), &dense(g))?)?)
}

fn dense_parallel_sum(f: &DMatrix<f64>, g: &DMatrix<f64>) -> Result<DMatrix<f64>, FloatMatrixError> {
    let product = f * pseudo_inverse(&(f + g))? * g;
    Ok(with_transpose(&product) / 2.0)
}
