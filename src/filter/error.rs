//! Why a filter stopped, where, and what it had computed until then.

use crate::gaussian::ConditionError;
use crate::trace::Record;

/// The filter cannot go on at a step; C is what it computes.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("at step {step}: {source}")]
pub struct FilterError<S: std::fmt::Debug + 'static, C = Vec<Record<S>>> {
    /// The step, counted from 0.
    pub step: usize,
    /// The reason, with its witness.
    pub source: ConditionError<S>,
    /// What was computed of the steps before it.
    pub computed: C,
}
