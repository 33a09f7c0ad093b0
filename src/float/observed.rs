//! The part of an observation that was observed.

use nalgebra::{DMatrix, DVector};

use super::moments::dense;
use crate::model::{Step, Timing};

/// The equation of the observed entries: `value = C x + v`, at least one of them.
#[derive(Clone, Debug)]
pub(super) struct Observed {
    /// C, m×n.
    pub(super) matrix: DMatrix<f64>,
    /// y − Gv, m×1.
    pub(super) value: DVector<f64>,
    /// R, m×m.
    pub(super) noise: DMatrix<f64>,
    /// M₁, n×m: the covariance of x − x̂ with the noise. Zero if the transition departs.
    pub(super) state_noise: DMatrix<f64>,
}

impl Observed {
    /// Whether the state is correlated with the noise.
    pub(super) fn shares_noise(&self) -> bool {
        self.state_noise.iter().any(|&entry| entry != 0.0)
    }

    /// The observed rows of a step; nothing if all are missing.
    pub(super) fn at(step: &Step<f64>, timing: Timing, states: usize) -> Option<Self> {
        let present = step.reading.present();
        if present.is_empty() {
            return None;
        }
        let reading = step.reading.values();
        let offset = step.observation_input.select_rows(&present);
        let state_noise = match (timing, &step.transition) {
            (Timing::Arriving, Some(transition)) => dense(&transition.cross_noise.select_columns(&present)),
            _ => DMatrix::zeros(states, present.len()),
        };
        Some(Self {
            matrix: dense(&step.observation.select_rows(&present)),
            value: DVector::from_fn(present.len(), |i, _| reading[(i, 0)] - offset[(i, 0)]),
            noise: dense(&step.observation_noise.select(&present, &present)),
            state_noise,
        })
    }
}
