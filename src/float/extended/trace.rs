//! What the extended predictor computes.

use crate::trace::Moments;

/// One step of the extended predictor. What it calls moments are those of the linear system put in place of the true one.
#[derive(Clone, Debug, PartialEq)]
pub struct ExtendedStep {
    /// x_k given y_0, …, y_{k−1}.
    pub predicted: Moments<f64>,
    /// x_k given y_0, …, y_k.
    pub filtered: Moments<f64>,
    /// x_{k+1}, …, x_{k+d} given y_0, …, y_k.
    pub ahead: Vec<Moments<f64>>,
}

/// What the extended predictor computes along some readings.
#[derive(Clone, Debug, PartialEq)]
pub struct ExtendedTrace {
    /// x_0, …, x_{d−1} before any reading.
    pub prior: Vec<Moments<f64>>,
    /// One step per reading.
    pub steps: Vec<ExtendedStep>,
}

impl ExtendedTrace {
    /// For k = 0, 1, …: x_k given y_0, …, y_{k−d}, and before any reading for k < d.
    pub fn predictions(&self) -> impl Iterator<Item = &Moments<f64>> {
        self.prior.iter().chain(self.steps.iter().filter_map(|step| step.ahead.last()))
    }
}
