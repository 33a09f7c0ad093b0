//! A diffuse start, P₀ = P* + κ P∞ as κ → ∞: one observation of a state whose covariance still grows with κ.

use super::recursion::propagated;
use super::series::{Conditioned, Joint};
use super::update::{Sensors, likelihood};
use crate::gaussian::ConditionError;
use crate::matrix::Matrix;
use crate::model::{Timing, Transition};
use crate::scalar::{Scalar, ZeroTest};
use crate::trace::{Moments, Record};

/// The diffuse part, unless it is certainly zero.
pub(super) fn part<S: Scalar>(diffuse: Option<Matrix<S>>) -> Option<Matrix<S>> {
    diffuse.filter(|part| part.entries().iter().any(|entry| entry.zero_test() != ZeroTest::Zero))
}

/// What is observed of a state with a diffuse part.
pub(super) struct Observed<S> {
    predicted: Moments<S>,
    innovation: Matrix<S>,
    /// S, without its part of order κ.
    covariance: Matrix<S>,
    diffuse: Matrix<S>,
    /// cov(x, y), without its part of order κ.
    cross: Matrix<S>,
    cross_diffuse: Matrix<S>,
}

impl<S: Scalar> Observed<S> {
    pub(super) fn of(predicted: Moments<S>, sensors: &Sensors<S>, timing: Timing) -> Self {
        let n = predicted.mean.rows();
        let c = &sensors.matrix;
        let growing = predicted.diffuse.clone().unwrap_or_else(|| Matrix::zeros(n, n));
        let (cross, covariance) = sensors.covariances(&predicted.covariance, &sensors.shared_with_state(timing));
        Self {
            innovation: &sensors.values - c * &predicted.mean - &sensors.input,
            covariance,
            diffuse: c.congruence(&growing),
            cross,
            cross_diffuse: growing * c.transpose(),
            predicted,
        }
    }

    /// The record of the step: the state conditioned on what is observed.
    pub(super) fn record(self, sensors: &Sensors<S>) -> Result<Record<S>, ConditionError<S>> {
        let joint = self.joint(&self.predicted, &self.cross, &self.cross_diffuse);
        let Conditioned { law: filtered, gain, rank } = joint.conditioned(&self.predicted.mean, &self.innovation)?;
        let innovation_diffuse = part(Some(self.diffuse));
        let likelihood = if innovation_diffuse.is_none() {
            let pseudo_inverse = self.covariance.pseudo_inverse()?;
            Some(likelihood(&self.covariance, &pseudo_inverse, &self.innovation)?)
        } else {
            None
        };
        Ok(Record {
            observed: sensors.observed.clone(),
            predicted: self.predicted,
            predicted_observation: &sensors.values - &self.innovation,
            innovation: self.innovation,
            innovation_covariance: self.covariance,
            innovation_rank: rank,
            cross_covariance: self.cross,
            innovation_diffuse,
            gain,
            filtered,
            likelihood,
        })
    }

    /// The next state given what is observed, when the transition departs from here.
    pub(super) fn departed(
        &self,
        transition: &Transition<S>,
        sensors: &Sensors<S>,
    ) -> Result<Moments<S>, ConditionError<S>> {
        let next = propagated(&self.predicted, transition);
        let cross = &transition.matrix * &self.cross + &sensors.cross_noise;
        let joint = self.joint(&next, &cross, &(&transition.matrix * &self.cross_diffuse));
        Ok(joint.conditioned(&next.mean, &self.innovation)?.law)
    }

    /// The joint covariance of the observed entries and a target.
    fn joint(&self, target: &Moments<S>, cross: &Matrix<S>, cross_diffuse: &Matrix<S>) -> Joint<S> {
        let n = target.mean.rows();
        let growing = target.diffuse.clone().unwrap_or_else(|| Matrix::zeros(n, n));
        Joint {
            observed: self.innovation.rows(),
            finite: bordered(&self.covariance, cross, &target.covariance),
            diffuse: bordered(&self.diffuse, cross_diffuse, &growing),
        }
    }
}

/// `[upper crossᵀ; cross lower]`
fn bordered<S: Scalar>(upper: &Matrix<S>, cross: &Matrix<S>, lower: &Matrix<S>) -> Matrix<S> {
    upper.beside(&cross.transpose()).above(&cross.beside(lower))
}
