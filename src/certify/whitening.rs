//! A matrix that makes the identity of an innovation covariance, nearly.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::dyadics::Dyadics;
use super::grid::{nearest, scale};
use crate::matrix::Matrix;

/// T with `T Σ Tᵀ ≈ I`, for Σ over an odd integer: the inverse of its factor of Cholesky in fixed point, each coordinate in
/// its own unit. Nothing where a pivot is not positive.
///
/// Nothing depends on how good it is but the width of bounds: they ask for what T Σ Tᵀ is, and compute it exactly.
pub(super) fn whitening(sigma: &Dyadics, odd: &BigInt, bits: u64) -> Option<Dyadics> {
    let m = sigma.rows();
    let diagonal = sigma.diagonal();
    let size = i64::try_from(odd.bits()).unwrap_or(i64::MAX) - 1;
    let mut scales = Vec::with_capacity(m);
    for entry in &diagonal {
        let variance = Some(entry).filter(|entry| !entry.is_negative());
        // The odd integer lies between 2^size and twice that.
        scales.push(variance.and_then(scale)? - size / 2);
    }
    let places = i64::try_from(bits).unwrap_or(i64::MAX);
    let entry = |i: usize, j: usize| {
        nearest(&sigma.mantissas[(i, j)], sigma.exponent - scales[i] - scales[j] + 2 * places, odd).0
    };
    let mut lower = Matrix::<BigInt>::zeros(m, m);
    for j in 0..m {
        let taken = (0..j).fold(BigInt::zero(), |sum, k| sum + &lower[(j, k)] * &lower[(j, k)]);
        let pivot = entry(j, j) - taken;
        if !pivot.is_positive() {
            return None;
        }
        lower[(j, j)] = pivot.sqrt();
        for i in j + 1..m {
            let taken = (0..j).fold(BigInt::zero(), |sum, k| sum + &lower[(i, k)] * &lower[(j, k)]);
            lower[(i, j)] = (entry(i, j) - taken) / &lower[(j, j)];
        }
    }
    let one = BigInt::one() << (2 * places);
    let mut inverse = Matrix::<BigInt>::zeros(m, m);
    for j in 0..m {
        inverse[(j, j)] = &one / &lower[(j, j)];
        for i in j + 1..m {
            let sum = (j..i).fold(BigInt::zero(), |sum, k| sum + &lower[(i, k)] * &inverse[(k, j)]);
            inverse[(i, j)] = -sum / &lower[(i, i)];
        }
    }
    let largest = scales.iter().copied().max().unwrap_or(0);
    let mantissas = Matrix::from_fn(m, m, |i, j| &inverse[(i, j)] << (largest - scales[j]));
    Some(Dyadics { mantissas, exponent: -places - largest })
}
