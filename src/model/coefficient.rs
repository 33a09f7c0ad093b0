//! Coefficients that are constant, one per step, or adapted to the observations.

use std::fmt;
use std::sync::Arc;

use super::Observation;
use crate::matrix::Matrix;
use crate::scalar::Undefined;

/// The observations y_0, …, y_last that a coefficient may depend on; the future is not in it.
#[derive(Debug)]
pub struct Past<'a, S> {
    step: usize,
    known: &'a [Observation<S>],
}

// Not derived: a shared view is copied whatever its entries are.
impl<S> Clone for Past<'_, S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S> Copy for Past<'_, S> {}

impl<'a, S> Past<'a, S> {
    pub(super) fn new(step: usize, known: &'a [Observation<S>]) -> Self {
        Self { step, known }
    }

    /// The index k of the coefficient that is asked for.
    pub fn step(self) -> usize {
        self.step
    }

    /// How many observations are known, which is not k: it depends on the timing and on how far ahead one predicts.
    pub fn len(self) -> usize {
        self.known.len()
    }

    /// Whether none is.
    pub fn is_empty(self) -> bool {
        self.known.is_empty()
    }

    /// What was known when there were only `count` observations; the same view if there are no more.
    pub fn truncated(self, count: usize) -> Self {
        Self { known: &self.known[..count.min(self.known.len())], ..self }
    }

    /// The same observations, for a coefficient with another index.
    pub(crate) fn at(self, step: usize) -> Self {
        Self { step, ..self }
    }

    /// The entry of sensor `sensor` in y_k; nothing if it is missing or not yet known.
    pub fn entry(self, k: usize, sensor: usize) -> Option<&'a S> {
        self.known.get(k)?.entries().get(sensor)?.as_ref()
    }

    /// The last known observation.
    pub fn last(self) -> Option<&'a Observation<S>> {
        self.known.last()
    }

    /// The entry of sensor `sensor` in the last known observation.
    pub fn last_entry(self, sensor: usize) -> Option<&'a S> {
        self.entry(self.known.len().checked_sub(1)?, sensor)
    }
}

/// A function of the past that yields a coefficient, or says that it has no finite value there.
pub(super) type Rule<S> = dyn Fn(Past<'_, S>) -> Result<Matrix<S>, Undefined> + Send + Sync;

/// One coefficient of a system: A, B, u, D, C, G, v, F or a noise covariance.
#[derive(Clone)]
#[non_exhaustive]
pub enum Coefficient<S> {
    /// The same at every step.
    Constant(Matrix<S>),
    /// One per step; nothing where no observation depends on it.
    PerStep(Vec<Option<Matrix<S>>>),
    /// A function of the past observations (CKS-A3): adapted by construction, since it is shown nothing else.
    Adapted(Arc<Rule<S>>),
}

impl<S> Coefficient<S> {
    /// The coefficient whose value at step k is `values[k]`.
    pub fn per_step(values: impl IntoIterator<Item = Matrix<S>>) -> Self {
        Self::PerStep(values.into_iter().map(Some).collect())
    }

    /// The coefficient that `rule` computes from the past; [`Undefined`] says that it is not finite there
    /// (CKS-A4 fails on this path).
    pub fn adapted(rule: impl Fn(Past<'_, S>) -> Result<Matrix<S>, Undefined> + Send + Sync + 'static) -> Self {
        Self::Adapted(Arc::new(rule))
    }
}

impl<S> From<Matrix<S>> for Coefficient<S> {
    fn from(matrix: Matrix<S>) -> Self {
        Self::Constant(matrix)
    }
}

impl<S: fmt::Debug> fmt::Debug for Coefficient<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(matrix) => f.debug_tuple("Constant").field(matrix).finish(),
            Self::PerStep(matrices) => f.debug_tuple("PerStep").field(matrices).finish(),
            Self::Adapted(_) => f.write_str("Adapted(…)"),
        }
    }
}
