//! Why the filter on exact rationals stopped.

use super::RationalStep;
use crate::gaussian::ConditionError;
use crate::scalar::Rational;

/// The filter on exact rationals cannot go on at a step.
#[derive(Clone, Debug, thiserror::Error)]
#[error("at step {step}: {reason}")]
pub struct RationalFilterError {
    /// The step, counted from 0.
    pub step: usize,
    /// The reason, with its witness.
    pub reason: StopReason,
    /// The results of the steps before it.
    pub computed: Vec<RationalStep>,
}

/// Why a filter on exact numbers stops.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum StopReason {
    /// As in the recursion.
    #[error(transparent)]
    Condition(#[from] ConditionError<Rational>),
    /// The joint covariance of a step is not positive semidefinite: the path was not made by realising a system.
    #[error("a covariance is not positive semidefinite")]
    NotSemidefinite,
    /// Exact numbers lengthen with every step; these have outgrown the limit.
    #[error("exact numbers have grown to {bits} bits, beyond the limit of {limit}")]
    TooLong {
        /// The length reached.
        bits: u64,
        /// The limit.
        limit: u64,
    },
}
