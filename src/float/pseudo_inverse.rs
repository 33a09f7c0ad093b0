//! The form for singular innovations: the pseudo-inverse of S.

use nalgebra::DMatrix;

use super::error::Obstacle;
use super::moments::Moments;
use super::observed::Observed;
use super::recursion::{MomentRecursion, Update};
use super::short;
use super::transition::{Departure, Transition};

/// S⁺ by its spectrum (CKS-T in floating point), and (I − KC)P.
pub(super) struct PseudoInverse;

/// Far above the two or three iterations an eigenvalue takes; there so that no input can run for ever.
const ITERATIONS: usize = 10_000;

impl MomentRecursion for PseudoInverse {
    const NAME: &'static str = "pseudo-inverse";
    const DESCRIPTION: &'static str = "S pseudo-inverted by its spectrum, covariance (I - KC)P";

    fn predicted(belief: &Moments, transition: &Transition) -> Result<Moments, Obstacle> {
        Ok(short::predicted(belief, transition))
    }

    fn updated(
        belief: &Moments,
        observed: &Observed,
        departure: Option<&Departure<'_>>,
    ) -> Result<Update<Moments>, Obstacle> {
        short::updated(belief, observed, departure, pseudo_inverse)
    }
}

/// S⁺, where singular values up to `m · ε · σ_max` count as zero: the customary threshold (MATLAB's `pinv`,
/// `numpy.linalg.matrix_rank`).
///
/// S is symmetric, so its singular values are |λ| and S⁺ = V Λ⁺ Vᵀ. `DMatrix::svd` is not used: nalgebra 0.35
/// loses up to half the digits there, on well-conditioned 3×3 matrices (dimforge/nalgebra#1172).
pub(super) fn pseudo_inverse(s: &DMatrix<f64>) -> Result<DMatrix<f64>, Obstacle> {
    if !s.iter().all(|entry| entry.is_finite()) {
        return Err(Obstacle::NotFinite);
    }
    // nalgebra panics at the spectrum of nothing.
    if s.is_empty() {
        return Ok(s.clone());
    }
    let eigen = s.clone().try_symmetric_eigen(f64::EPSILON, ITERATIONS).ok_or(Obstacle::Unconverged)?;
    let largest = eigen.eigenvalues.amax();
    #[expect(clippy::cast_precision_loss, reason = "no matrix has 2^53 rows")]
    let threshold = s.nrows() as f64 * f64::EPSILON * largest;
    let reciprocals = eigen.eigenvalues.map(|value| if value.abs() > threshold { value.recip() } else { 0.0 });
    Ok(&eigen.eigenvectors * DMatrix::from_diagonal(&reciprocals) * eigen.eigenvectors.transpose())
}
