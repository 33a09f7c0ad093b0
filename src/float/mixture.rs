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
    /// The law has no component, or a number of it is not finite.
    #[error("the law of the first state has no component, or one whose numbers are not finite")]
    NoLaw,
    /// A matrix that should be regular is not, such as the covariance of the observation noise, or a result is not finite.
    #[error("at step {step} a matrix is singular or a result is not finite")]
    Singular {
        /// The step, counted from 0.
        step: usize,
    },
}

/// Slope and curvature of the log likelihood at μ, the mean of the first state, and the mean that the next state has for μ as the first.
struct State {
    covariance: DMatrix<f64>,
    response: DMatrix<f64>,
    precision: DMatrix<f64>,
    mean: DVector<f64>,
    linear: DVector<f64>,
}

/// Best and best affine estimates of each next state, the covariance of the first and their difference; weights by the logarithm of a
/// sum of exponentials.
///
/// It runs Q*, R* and B̄ by their closed recursions SM-4.6, SM-4.7 and SM-4.8, and never forms Q, R or M. X̄ starts at the mean μ of the
/// law rather than at 0, and z − μ takes the place of z, so that digits do not depend on where the origin is. The initial belief of the path
/// is not used.
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
    // Any point amid the law would do: that it is rounded does no harm.
    let centre = law.iter().fold(DVector::zeros(n), |sum, part| sum + dense_column(&part.mean) * part.weight);
    let parts =
        law.iter().map(|part| Part::of(part, &centre)).collect::<Option<Vec<_>>>().ok_or(MixtureError::NoLaw)?;
    let whole = Part::whole(&parts).ok_or(MixtureError::NoLaw)?;
    let zero = DMatrix::zeros(n, n);
    let mut state = State {
        covariance: zero.clone(),
        response: DMatrix::identity(n, n),
        precision: zero,
        mean: centre,
        linear: DVector::zeros(n),
    };
    let mut all = Vec::new();
    for (step, at) in path.steps().iter().enumerate() {
        let Some(transition) = &at.transition else { break };
        let observed = Observed::at(at, Timing::Departing, n);
        let cross = dense(&transition.cross_noise.select_columns(&at.reading.present()));
        let failed = MixtureError::Singular { step };
        state.advance(&Transition::of(transition), observed.as_ref(), &cross).ok_or(failed)?;
        all.push(state.estimate(&parts, &whole).ok_or(failed)?);
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

    fn estimate(&self, parts: &[Part], whole: &Part) -> Option<MixtureEstimate> {
        let n = self.mean.len();
        let tilted = parts.iter().map(|part| self.tilted(part)).collect::<Option<Vec<_>>>()?;
        let evidence: Vec<f64> =
            parts.iter().zip(&tilted).map(|(part, tilted)| part.weight.ln() + tilted.evidence).collect();
        let most = evidence.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let sum: f64 = evidence.iter().map(|log| (log - most).exp()).sum();
        let weights: Vec<f64> = evidence.iter().map(|log| (log - most).exp() / sum).collect();
        let start =
            weights.iter().zip(&tilted).fold(DVector::zeros(n), |sum, (weight, tilted)| sum + &tilted.mean * *weight);
        let spread = weights.iter().zip(&tilted).fold(DMatrix::zeros(n, n), |sum, (weight, tilted)| {
            let away = &tilted.mean - &start;
            sum + (&tilted.covariance + &away * away.transpose()) * *weight
        });
        let affine = self.tilted(whole)?.mean;
        let of_state = &self.covariance + &self.response * spread * self.response.transpose();
        Some(MixtureEstimate {
            mean: finite_column(&(&self.mean + &self.response * &start)).ok()?,
            covariance: finite(&((&of_state + of_state.transpose()) / 2.0)).ok()?,
            linear: finite_column(&(&self.mean + &self.response * &affine)).ok()?,
            difference: finite_column(&(&self.response * (start - affine))).ok()?,
            weights,
        })
    }

    /// N(μ, Δ) weighted by the likelihood. With Δ = LLᵀ, `(I + ΔR*)⁻¹Δ` is `L(I + LᵀR*L)⁻¹Lᵀ`, where what is inverted is symmetric and at
    /// least I, however large Δ is.
    fn tilted(&self, part: &Part) -> Option<Tilted> {
        let (b, r, mean, root) = (&self.linear, &self.precision, &part.mean, &part.root);
        let n = mean.len();
        let factor = (DMatrix::identity(n, n) + root.transpose() * r * root).cholesky()?;
        // L(I + LᵀR*L)^(−½), a root of the covariance
        let root = factor.l().solve_lower_triangular(&root.transpose())?.transpose();
        let slope = b - r * mean;
        let seen = root.transpose() * &slope;
        let log_determinant: f64 = 2.0 * factor.l().diagonal().iter().map(|entry| entry.ln()).sum::<f64>();
        Some(Tilted {
            mean: mean + &root * &seen,
            covariance: &root * root.transpose(),
            evidence: mean.dot(b) - mean.dot(&(r * mean)) / 2.0 + seen.norm_squared() / 2.0 - log_determinant / 2.0,
        })
    }
}

/// A Gaussian law of the first state with its probability.
struct Part {
    weight: f64,
    /// Less μ.
    mean: DVector<f64>,
    /// L with Δ = LLᵀ, n×n.
    root: DMatrix<f64>,
}

impl Part {
    fn of(part: &MixturePart, centre: &DVector<f64>) -> Option<Self> {
        let covariance = dense(&part.covariance);
        if covariance.iter().chain(part.mean.entries()).any(|entry| !entry.is_finite()) {
            return None;
        }
        let parts = covariance.symmetric_eigen();
        let roots = parts.eigenvalues.map(|value| value.max(0.0).sqrt());
        let root = parts.eigenvectors * DMatrix::from_diagonal(&roots);
        Some(Self { weight: part.weight, mean: dense_column(&part.mean) - centre, root })
    }

    /// Mean and covariance of the whole mixture: Δ is the sum of the squares of all roots and of all ways from the mean, whose root is
    /// triangular by an orthogonal factorisation.
    fn whole(parts: &[Self]) -> Option<Self> {
        let n = parts.first()?.mean.len();
        let mean = parts.iter().fold(DVector::zeros(n), |sum, part| sum + &part.mean * part.weight);
        let columns: Vec<DVector<f64>> = parts
            .iter()
            .flat_map(|part| {
                let away = (&part.mean - &mean) * part.weight.sqrt();
                let own = &part.root * part.weight.sqrt();
                own.column_iter().map(nalgebra::Matrix::into_owned).chain([away]).collect::<Vec<_>>()
            })
            .collect();
        let root = DMatrix::from_columns(&columns).transpose().qr().r().transpose();
        Some(Self { weight: 1.0, mean, root })
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
