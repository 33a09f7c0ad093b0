//! A transition between two states.

use nalgebra::{DMatrix, DVector};

use super::moments::{dense, dense_column};
use crate::model;

/// The equation `x₊ = A x + input + w`.
#[derive(Clone, Debug)]
pub(super) struct Transition {
    /// A, n×n.
    pub(super) matrix: DMatrix<f64>,
    /// B u, n×1.
    pub(super) input: DVector<f64>,
    /// Q, n×n.
    pub(super) noise: DMatrix<f64>,
}

/// A transition that departs from an observed state.
#[derive(Clone, Debug)]
pub(super) struct Departure<'a> {
    /// Where it leads.
    pub(super) transition: &'a Transition,
    /// M₂, n×m: the covariance of its noise with that of the observed entries.
    pub(super) cross_noise: DMatrix<f64>,
}

impl Transition {
    /// The transition of a step.
    pub(super) fn of(transition: &model::Transition<f64>) -> Self {
        Self {
            matrix: dense(&transition.matrix),
            input: dense_column(&transition.input),
            noise: dense(&transition.noise),
        }
    }
}
