//! The statistics of the data that the conditional law needs, whatever F is.

use super::recursion::Recursion;
use crate::matrix::{Matrix, SolveError, Undecided};
use crate::model::{Path, Timing};
use crate::scalar::Field;

/// Everything at one t that does not depend on F; n states.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statistics<S> {
    /// P, n×n: the covariance of the state given ξ and the readings before it.
    pub covariance: Matrix<S>,
    /// Q, n×n: the covariance of the errors of X and B under the new measure.
    pub cross: Matrix<S>,
    /// R, n×n: the covariance of the error of B under the new measure.
    pub error: Matrix<S>,
    /// J(t−1), that of the newest reading, with a row for each of its entries that is there; nothing at t = 0.
    pub innovation_covariance: Option<Matrix<S>>,
    /// Φ(t, 0), n×n: how the state follows ξ when there are no readings.
    pub state_transition: Matrix<S>,
    /// Ψ(t, 0), n×n.
    pub transition: Matrix<S>,
    /// M, n×n: the covariance of B under the new measure.
    pub information: Matrix<S>,
    /// X̄, n×1: the mean of the state given the readings, for ξ = 0.
    pub mean: Matrix<S>,
    /// B̄, n×1.
    pub linear: Matrix<S>,
}

impl<S: Field> Statistics<S> {
    /// Σ, 2n×2n.
    ///
    /// SM-2.5: `Σ(t) = [[P(t), Q(t)], [Qᵀ(t), R(t)]]`
    pub fn joint_covariance(&self) -> Matrix<S> {
        self.covariance.beside(&self.cross).above(&self.cross.transpose().beside(&self.error))
    }

    /// Q*, n×n: how the mean of the state follows ξ.
    ///
    /// SM-4.1: `Q*(t) = Q(t) + Ψ(t,0),  R*(t) = M(t) − R(t)`
    pub fn response(&self) -> Matrix<S> {
        &self.cross + &self.transition
    }

    /// R*, n×n, positive semidefinite: the precision with which the readings see ξ.
    ///
    /// SM-4.1: `Q*(t) = Q(t) + Ψ(t,0),  R*(t) = M(t) − R(t)`
    pub fn precision(&self) -> Matrix<S> {
        &self.information - &self.error
    }
}

/// Why there are no statistics.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StatisticsError<S> {
    /// The noise of an observation is singular, and Ψ has no value (SM-A2).
    #[error(
        "at step {step}: the covariance of the observation noise is not positive definite; every observation must be noisy here"
    )]
    Noiseless {
        /// The step, counted from 0.
        step: usize,
        /// A vector v ≠ 0 with Σᵛv = 0.
        witness: Matrix<S>,
    },
    /// The noise of y_k is shared with the transition that arrives at k.
    #[error("the system has arriving timing; the statistics are those of departing timing")]
    Arriving,
    /// Whether a covariance is regular cannot be decided; never over the rationals.
    #[error("at step {step}: {source}")]
    Undecided {
        /// The step, counted from 0.
        step: usize,
        /// Where elimination stopped.
        source: Undecided,
    },
}

/// The statistics at t = 0, 1, …: before any reading, after y_0, after y_0 and y_1, and so on, one for each transition
/// that the path has, and the start. The initial belief of the path is not used: ξ is the state before y_0.
///
/// SM-2.1: `P(t+1) = A(t)P(t)Aᵀ(t) − [A(t)P(t)Hᵀ(t) + Σʷᵛ(t+1)][H(t)P(t)Hᵀ(t) + Σᵛ(t+1)]⁻¹[A(t)P(t)Hᵀ(t) + Σʷᵛ(t+1)]ᵀ + Σʷ(t+1),  P(0) = 0`
///
/// SM-2.3: `Q(t+1) = A(t)Q(t) − [A(t)P(t)Hᵀ(t) + Σʷᵛ(t+1)]J⁻¹(t)H(t)(Q(t) + Ψ(t,0)) + Σʷᵛ(t+1)Σᵛ(t+1)⁻¹H(t)Ψ(t,0),  Q(0) = 0`
///
/// SM-2.4: `R(t+1) = R(t) − (Q(t) + Ψ(t,0))ᵀHᵀ(t)J⁻¹(t)H(t)(Q(t) + Ψ(t,0)) + Ψᵀ(t,0)Hᵀ(t)Σᵛ(t+1)⁻¹H(t)Ψ(t,0),  R(0) = 0`
///
/// Beyond the paper: known inputs enter X̄, and missing entries drop their rows.
///
/// # Errors
///
/// [`StatisticsError`]: a singular Σᵛ with its witness, or the other timing; over a field without order a singular J as well.
///
/// # Examples
///
/// The witness of the misprint in (2.4): A = H = Σʷ = 1, Σᵛ = 2 and one reading.
///
/// ```
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
/// use exact_kalman::nongaussian::statistics;
/// use exact_kalman::scalar::{ratio, Rational};
///
/// let one = Matrix::<Rational>::identity(1);
/// let system = System {
///     timing: Timing::Departing,
///     initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), Matrix::zeros(1, 1)),
///     transition: one.clone().into(),
///     observation: one.clone().into(),
///     noise: Noise::Covariances { process: one.clone().into(), cross: None, observation: one.scaled(&ratio(2, 1)).into() },
///     input: None,
///     observation_input: None,
/// };
/// let path = system.realised(&[Observation::complete([ratio(1, 1)])])?;
/// let after = &statistics(&path)?[1];
/// assert_eq!(after.error[(0, 0)], ratio(0, 1));
/// // J(0) = H P(0) Hᵀ + Σᵛ(1) and Φ(1, 0) = A(0)
/// assert_eq!(after.innovation_covariance, Some(one.scaled(&ratio(2, 1))));
/// assert_eq!(after.state_transition, one);
/// assert_eq!(after.precision()[(0, 0)], ratio(1, 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn statistics<S: Field>(path: &Path<S>) -> Result<Vec<Statistics<S>>, StatisticsError<S>> {
    if path.timing() != Timing::Departing {
        return Err(StatisticsError::Arriving);
    }
    let mut recursion = Recursion::new(path.states());
    let mut all = vec![recursion.now().clone()];
    for (step, parts) in path.steps().iter().enumerate() {
        let Some(transition) = &parts.transition else { break };
        recursion.advance(parts, transition).map_err(|reason| reason.at(step))?;
        all.push(recursion.now().clone());
    }
    Ok(all)
}

/// Why a positive semidefinite matrix is not inverted.
pub(super) enum NoInverse<S> {
    /// A vector v ≠ 0 that it maps to 0.
    Singular(Matrix<S>),
    Undecided(Undecided),
}

impl<S> NoInverse<S> {
    /// As the noise of an observation.
    pub(super) fn at(self, step: usize) -> StatisticsError<S> {
        match self {
            Self::Singular(witness) => StatisticsError::Noiseless { step, witness },
            Self::Undecided(source) => StatisticsError::Undecided { step, source },
        }
    }
}

/// The inverse of a positive semidefinite matrix.
pub(super) fn inverse<S: Field>(matrix: &Matrix<S>) -> Result<Matrix<S>, NoInverse<S>> {
    debug_assert!(matrix.asymmetry().is_none(), "a covariance is symmetric");
    matrix.inverse().map_err(|error| match error {
        SolveError::Singular { .. } => NoInverse::Singular(matrix.kernel().select_columns(&[0])),
        SolveError::Undecided(undecided) => NoInverse::Undecided(undecided),
    })
}
