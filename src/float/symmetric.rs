//! Products that are symmetric to the last bit.

use nalgebra::DMatrix;

/// `a p aᵀ` for a symmetric p: entries above the diagonal are copies of those below.
pub(super) fn congruence(a: &DMatrix<f64>, p: &DMatrix<f64>) -> DMatrix<f64> {
    let mut product = a * p * a.transpose();
    product.fill_upper_triangle_with_lower_triangle();
    product
}

/// `t + tᵀ`; symmetric, since addition commutes in `f64`.
pub(super) fn with_transpose(t: &DMatrix<f64>) -> DMatrix<f64> {
    t + t.transpose()
}
