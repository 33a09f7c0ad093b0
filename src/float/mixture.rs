//! Prediction in `f64` from a start that is a mixture of Gaussian laws.

use nalgebra::{DMatrix, DVector};

use super::moments::{dense, dense_column, finite, finite_column};
use super::observed::Observed;
use super::transition::Transition;
use crate::matrix::Matrix;
use crate::model::{Path, Timing};

/// A component of the law of the first state.
#[derive(Clone, Debug, PartialEq)]
pub struct MixturePart {
    /// Its probability.
    pub weight: f64,
    /// Its mean, n×1.
    pub mean: Matrix<f64>,
    /// Its covariance, n×n.
    pub covariance: Matrix<f64>,
}

/// What is predicted of the next state after a reading.
#[derive(Clone, Debug, PartialEq)]
pub struct MixtureEstimate {
    /// The best estimate, n×1.
    pub mean: Matrix<f64>,
    /// The covariance of the state given the readings, n×n, symmetric to the last bit.
    pub covariance: Matrix<f64>,
    /// The best affine estimate, n×1.
    pub linear: Matrix<f64>,
    /// The best estimate less the best affine one, n×1, taken before X̄ is added to either (SM-4.31).
    pub difference: Matrix<f64>,
    /// The probabilities of the components.
    pub weights: Vec<f64>,
}

/// Why there is no estimate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MixtureError {
    /// The model has the other timing.
    #[error("the system has arriving timing; departing timing is needed")]
    Arriving,
    /// A matrix that should be regular is not, such as the covariance of the observation noise, or a result is not finite.
    #[error("at step {step} a matrix is singular or a result is not finite")]
    Singular {
        /// The step, counted from 0.
        step: usize,
    },
}

/// Slope and curvature of the log likelihood of the first state, and the mean that the next state has for 0 as the first.
struct State {
    covariance: DMatrix<f64>,
    response: DMatrix<f64>,
    precision: DMatrix<f64>,
    mean: DVector<f64>,
    linear: DVector<f64>,
}

/// Best and best affine estimates of each next state, the covariance of the first and their difference, with weights by the logarithm of a sum of exponentials.
///
/// It runs Q*, R* and B̄ by their closed recursions SM-4.6, SM-4.7 and SM-4.8, and never forms Q, R or M. The initial belief of the
/// path is not used.
///
/// # Errors
///
/// [`MixtureError`]
///
/// # Panics
///
/// If a component has another dimension than the state.
pub fn estimate_mixture(path: &Path<f64>, law: &[MixturePart]) -> Result<Vec<MixtureEstimate>, MixtureError> {
    if path.timing() != Timing::Departing {
        return Err(MixtureError::Arriving);
    }
    let n = path.states();
    let zero = DMatrix::zeros(n, n);
    let mut state = State {
        covariance: zero.clone(),
        response: DMatrix::identity(n, n),
        precision: zero,
        mean: DVector::zeros(n),
        linear: DVector::zeros(n),
    };
    let mut all = Vec::new();
    for (step, parts) in path.steps().iter().enumerate() {
        let Some(transition) = &parts.transition else { break };
        let observed = Observed::at(parts, Timing::Departing, n);
        let cross = dense(&transition.cross_noise.select_columns(&parts.reading.present()));
        let failed = MixtureError::Singular { step };
        state.advance(&Transition::of(transition), observed.as_ref(), &cross).ok_or(failed)?;
        all.push(state.estimate(law).ok_or(failed)?);
    }
    Ok(all)
}

impl State {
    fn advance(&mut self, transition: &Transition, observed: Option<&Observed>, cross: &DMatrix<f64>) -> Option<()> {
        let (a, p) = (&transition.matrix, &self.covariance);
        let mut covariance = a * p * a.transpose() + &transition.noise;
        let mut mean = a * &self.mean + &transition.input;
        let mut response = a * &self.response;
        if let Some(Observed { matrix: h, value, noise, .. }) = observed {
            // SM-A2; rounding hides it in the sum.
            noise.clone().cholesky()?;
            let factor = (h * p * h.transpose() + noise).cholesky()?;
            let gain = factor.solve(&(a * p * h.transpose() + cross).transpose()).transpose();
            let innovation = value - h * &self.mean;
            let seen = h * &self.response;
            let weighed = factor.solve(&seen);
            covariance -= &gain * factor.l() * (&gain * factor.l()).transpose();
            mean += &gain * &innovation;
            response -= &gain * &seen;
            self.linear += weighed.transpose() * innovation;
            self.precision += seen.transpose() * weighed;
        }
        (self.covariance, self.mean, self.response) = (covariance, mean, response);
        Some(())
    }

    fn estimate(&self, law: &[MixturePart]) -> Option<MixtureEstimate> {
        let parts: Vec<_> =
            law.iter().map(|part| (part.weight, dense_column(&part.mean), dense(&part.covariance))).collect();
        let n = self.mean.len();
        let mean = parts.iter().fold(DVector::zeros(n), |sum, (weight, mean, _)| sum + mean * *weight);
        let covariance = parts.iter().fold(DMatrix::zeros(n, n), |sum, (weight, own, covariance)| {
            let away = own - &mean;
            sum + (covariance + &away * away.transpose()) * *weight
        });
        let tilted =
            parts.iter().map(|(_, mean, covariance)| self.tilted(mean, covariance)).collect::<Option<Vec<_>>>()?;
        let evidence: Vec<f64> =
            parts.iter().zip(&tilted).map(|(part, tilted)| part.0.ln() + tilted.evidence).collect();
        let most = evidence.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let sum: f64 = evidence.iter().map(|log| (log - most).exp()).sum();
        let weights: Vec<f64> = evidence.iter().map(|log| (log - most).exp() / sum).collect();
        let start =
            weights.iter().zip(&tilted).fold(DVector::zeros(n), |sum, (weight, tilted)| sum + &tilted.mean * *weight);
        let spread = weights.iter().zip(&tilted).fold(DMatrix::zeros(n, n), |sum, (weight, tilted)| {
            let away = &tilted.mean - &start;
            sum + (&tilted.covariance + &away * away.transpose()) * *weight
        });
        let affine = self.tilted(&mean, &covariance)?.mean;
        let of_state = &self.covariance + &self.response * spread * self.response.transpose();
        Some(MixtureEstimate {
            mean: finite_column(&(&self.mean + &self.response * &start)).ok()?,
            covariance: finite(&((&of_state + of_state.transpose()) / 2.0)).ok()?,
            linear: finite_column(&(&self.mean + &self.response * &affine)).ok()?,
            difference: finite_column(&(&self.response * (start - affine))).ok()?,
            weights,
        })
    }

    /// N(μ, Δ) weighted by the likelihood.
    fn tilted(&self, mean: &DVector<f64>, covariance: &DMatrix<f64>) -> Option<Tilted> {
        let n = mean.len();
        let (b, r) = (&self.linear, &self.precision);
        let factor = (DMatrix::identity(n, n) + covariance * r).lu();
        let slope = b - r * mean;
        let shift = factor.solve(&(covariance * &slope))?;
        let exponent = mean.dot(b) - mean.dot(&(r * mean)) / 2.0 + slope.dot(&shift) / 2.0;
        Some(Tilted {
            mean: mean + shift,
            covariance: factor.solve(covariance)?,
            evidence: exponent - factor.determinant().ln() / 2.0,
        })
    }
}

/// What the readings make of a component.
struct Tilted {
    mean: DVector<f64>,
    /// (I + ΔR*)⁻¹Δ
    covariance: DMatrix<f64>,
    /// The logarithm of its evidence.
    evidence: f64,
}
