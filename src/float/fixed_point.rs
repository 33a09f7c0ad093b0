//! The fixed point of the map of Riccati in `f64`, by structured doubling.

use nalgebra::DMatrix;

use super::matrix_error::FloatMatrixError;
use super::moments::{dense, finite};
use super::symmetric::{congruence, with_transpose};
use crate::matrix::Matrix;

/// After i doublings 2ⁱ steps are done; convergence is quadratic.
const DOUBLINGS: usize = 60;

/// The S with `S = A(S:W)Aᵀ + V` for V > 0 and W ≥ 0, which is the limit of the filter's covariance (AK-T2.3 in floating point).
///
/// P = S:W solves `P = H + E P(I + G P)⁻¹Eᵀ` with `M = V + W, H = V M⁻¹W, E = W M⁻¹A, G = AᵀM⁻¹A`, which needs no inverse of
/// W. That form is kept when two of it are composed (structured doubling; Chu, Fan, Lin 2005), so that H is P after
/// 2ⁱ steps from 0. Then S = A P Aᵀ + V.
///
/// Shapes: all n×n; V and W symmetric.
///
/// # Errors
///
/// [`FloatMatrixError`] if a matrix that must be inverted is singular in `f64` (V is not positive definite, or nearly so),
/// or nothing converges.
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
/// // 2 = 1·(2:2)·1 + 1
/// let [a, v, w] = [1.0, 1.0, 2.0].map(|entry| Matrix::column(vec![entry]));
/// assert!((float::riccati_fixed_point(&a, &v, &w)?[(0, 0)] - 2.0).abs() < 1e-14);
/// # Ok::<(), exact_kalman::float::FloatMatrixError>(())
/// ```
pub fn riccati_fixed_point(a: &Matrix<f64>, v: &Matrix<f64>, w: &Matrix<f64>) -> Result<Matrix<f64>, FloatMatrixError> {
    let square = a.is_square() && a.shape() == v.shape() && a.shape() == w.shape();
    assert!(square, "no map of {}, {} and {}", a.shape(), v.shape(), w.shape());
    let (a, v, w) = (dense(a), dense(v), dense(w));
    let n = a.nrows();
    let total = (&v + &w).cholesky().ok_or(FloatMatrixError::Singular)?;
    let mut h = with_transpose(&(&v * total.solve(&w))) / 2.0;
    let mut g = with_transpose(&(a.transpose() * total.solve(&a))) / 2.0;
    let mut e = &w * total.solve(&a);
    for _ in 0..DOUBLINGS {
        // H + E H(I + GH)⁻¹Eᵀ, G + Eᵀ(I + GH)⁻¹G E and E(I + HG)⁻¹E: two steps of the same form in one.
        let factors = (DMatrix::identity(n, n) + &g * &h).lu();
        let solve = |right: &DMatrix<f64>| factors.solve(right).ok_or(FloatMatrixError::Singular);
        let et = e.transpose();
        let moved = solve(&et)?;
        let more = with_transpose(&(&e * (&h * &moved))) / 2.0;
        let next_g = &g + congruence(&et, &(with_transpose(&solve(&g)?) / 2.0));
        e = (&et * &moved).transpose();
        let next = &h + more;
        if !next.iter().chain(next_g.iter()).chain(e.iter()).all(|entry| entry.is_finite()) {
            return Err(FloatMatrixError::NotFinite);
        }
        if next == h {
            return Ok(finite(&(congruence(&a, &h) + &v))?);
        }
        (h, g) = (next, next_g);
    }
    Err(FloatMatrixError::Unconverged)
}
