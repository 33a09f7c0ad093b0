//! The best affine estimate, which is the Kalman predictor.

use super::{InitialLaw, Statistics};
use crate::matrix::Matrix;
use crate::scalar::OrderedField;

/// The best affine estimate of the state, and how far off it is.
///
/// SM-LMMSE: `X̂ᴷ(t+1) = argmin E‖X°(t+1) − g‖² over g = c + C₀Y(0) + … + C_t Y(t)`
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Linear<S> {
    /// X̂ᴷ, n×1.
    pub estimate: Matrix<S>,
    /// The covariance of its error, n×n; it does not depend on the readings.
    pub covariance: Matrix<S>,
}

impl<S: OrderedField> Statistics<S> {
    /// The best affine estimate for a law with mean μ and covariance Δ: `X̄ + Q*(I + ΔR*)⁻¹(ΔB̄ + μ)`, with the error
    /// covariance `P + Q*(I + ΔR*)⁻¹ΔQ*ᵀ`. It needs no inverse of Δ, so Δ may be singular; where it is not, this is
    ///
    /// SM-4.3: `X̂ᴷ(t+1) = X̄(t+1) + Q*(t+1)[R*(t+1) + Δ⁻¹]⁻¹[B̄(t+1) + Δ⁻¹μ]`
    ///
    /// # Panics
    ///
    /// If the law has another dimension.
    pub fn linear(&self, initial: &InitialLaw<S>) -> Linear<S> {
        let (mean, covariance) = (initial.mean(), initial.covariance());
        let (response, precision) = (self.response(), self.precision());
        let (of_initial, spread) = tilted(&mean, &covariance, &self.linear, &precision);
        Linear {
            estimate: &self.mean + &response * of_initial,
            covariance: &self.covariance + response.congruence(&spread),
        }
    }
}

/// Mean and covariance of N(μ, Δ) weighted by exp(zᵀb − ½ zᵀR*z): `(I + ΔR*)⁻¹(Δb + μ)` and `(I + ΔR*)⁻¹Δ`.
pub(super) fn tilted<S: OrderedField>(
    mean: &Matrix<S>,
    covariance: &Matrix<S>,
    linear: &Matrix<S>,
    precision: &Matrix<S>,
) -> (Matrix<S>, Matrix<S>) {
    let shifted = covariance * linear + mean;
    match regular(covariance, precision).solve(&shifted.beside(covariance)) {
        Ok(both) => {
            let n = mean.rows();
            (both.block(0..n, 0..1), both.block(0..n, 1..n + 1))
        }
        // Δ and R* are positive semidefinite, so ΔR* has no negative eigenvalue.
        Err(error) => unreachable!("I + ΔR* is regular, but {error}"),
    }
}

/// I + ΔR*
pub(super) fn regular<S: OrderedField>(covariance: &Matrix<S>, precision: &Matrix<S>) -> Matrix<S> {
    Matrix::identity(covariance.rows()) + covariance * precision
}
