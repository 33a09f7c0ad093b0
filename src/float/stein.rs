//! Stein's equation in `f64`, by doubling.

use nalgebra::DMatrix;

use super::matrix_error::FloatMatrixError;
use super::moments::{dense, finite};
use super::symmetric::congruence;
use crate::matrix::Matrix;

/// 2⁶⁰ terms: only ρ(D) within 2⁻⁵⁰ of 1 or above needs more.
const DOUBLINGS: usize = 60;

/// The X with `X − D X Dᵀ = Q` for ρ(D) < 1 and a symmetric Q: the series Σ DʲQ(Dʲ)ᵀ, its first 2ⁱ terms at a time
/// (R. A. Smith 1968).
///
/// Shapes: both n×n.
///
/// # Errors
///
/// [`FloatMatrixError::NotFinite`] or [`FloatMatrixError::Unconverged`] if the series does not converge in `f64`.
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
/// let x = float::stein_solution(&Matrix::column(vec![0.5]), &Matrix::column(vec![3.0]))?;
/// assert!((x[(0, 0)] - 4.0).abs() < 1e-14);
/// # Ok::<(), exact_kalman::float::FloatMatrixError>(())
/// ```
pub fn stein_solution(d: &Matrix<f64>, q: &Matrix<f64>) -> Result<Matrix<f64>, FloatMatrixError> {
    assert!(d.is_square() && d.shape() == q.shape(), "no equation of {} and {}", d.shape(), q.shape());
    let mut power: DMatrix<f64> = dense(d);
    let mut sum = dense(q);
    for _ in 0..DOUBLINGS {
        let rest = congruence(&power, &sum);
        if !rest.iter().all(|entry| entry.is_finite()) {
            return Err(FloatMatrixError::NotFinite);
        }
        let next = &sum + rest;
        if next == sum {
            return Ok(finite(&sum)?);
        }
        sum = next;
        power = &power * &power;
    }
    Err(FloatMatrixError::Unconverged)
}
