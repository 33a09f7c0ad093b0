//! Why the extended predictor stopped.

use super::ExtendedStep;

/// Why one step of the extended predictor cannot be done; `E` is the error of the system's own functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ExtendedObstacle<E> {
    /// The innovation covariance has no inverse in `f64`.
    #[error("the innovation covariance is singular")]
    Singular,
    /// A result is infinite or not a number.
    #[error("a result is not finite")]
    NotFinite,
    /// The transition or the observation has no value at the point where it was asked.
    #[error("the system is not defined at the estimate: {0}")]
    Undefined(E),
}

/// The extended predictor cannot go on at a step.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("at step {step}: {source}")]
pub struct ExtendedError<E: std::fmt::Debug + std::fmt::Display + 'static> {
    /// The step, counted from 0.
    pub step: usize,
    /// The reason.
    pub source: ExtendedObstacle<E>,
    /// The steps before it.
    pub computed: Vec<ExtendedStep>,
}
