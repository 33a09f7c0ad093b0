//! The joint law of one step's observation and its targets, given the state before it.

use num_bigint::BigInt;

use super::Sensors;
use crate::matrix::{Fractions, Matrix, least_common_multiple};
use crate::model::{Step, Timing, Transition};
use crate::scalar::Rational;

/// `(y, x, x₊) = E x₋ + noise`: the observed entries first, then x_k, then x_{k+1} where the transition departs from k.
#[derive(Debug)]
pub(super) struct Law {
    /// The number of observed entries.
    pub(super) observed: usize,
    /// n
    pub(super) states: usize,
    /// 1, or 2 where the transition departs from k.
    pub(super) targets: usize,
    /// E
    pub(super) map: Fractions,
    /// What is added to E P Eᵀ. In arriving timing that is no covariance where the noise of y is correlated with x: with
    /// Γ = cov(x, noise of y) the entries are `R + CΓ + ΓᵀCᵀ` and Γ. The whole is one.
    pub(super) noise: Fractions,
    /// What is subtracted from E x₋: the innovation is the first entries of `constant − E x₋`.
    pub(super) constant: Fractions,
}

impl Law {
    /// The law of a step whose predicted state is known.
    pub(super) fn of(step: &Step<Rational>, timing: Timing) -> Self {
        let sensors = Sensors::of(step);
        let n = sensors.matrix.columns();
        let shared = sensors.shared_with_state(timing);
        let (_, noise) = sensors.covariances(&Matrix::zeros(n, n), &shared);
        let zeros = Matrix::zeros(n, n);
        let mut map = sensors.matrix.above(&Matrix::identity(n));
        let mut covariance = noise.beside(&shared.transpose()).above(&shared.beside(&zeros));
        let departing = departing(step, timing);
        if let Some(transition) = departing {
            let cross = &sensors.cross_noise;
            map = map.above(&transition.matrix);
            covariance = covariance
                .beside(&cross.transpose().above(&zeros))
                .above(&cross.beside(&zeros).beside(&transition.noise));
        }
        Self {
            observed: sensors.observed.len(),
            states: n,
            targets: 1 + usize::from(departing.is_some()),
            map: Fractions::of(&map),
            noise: Fractions::of(&covariance),
            constant: constant(step, timing),
        }
    }

    /// The law of a transition alone: one target and nothing observed.
    pub(super) fn of_transition(transition: &Transition<Rational>) -> Self {
        Self {
            observed: 0,
            states: transition.matrix.rows(),
            targets: 1,
            map: Fractions::of(&transition.matrix),
            noise: Fractions::of(&transition.noise),
            constant: Fractions::of(&-&transition.input),
        }
    }

    /// This law with the reading and the inputs of another step.
    pub(super) fn of_data(self, step: &Step<Rational>, timing: Timing) -> Self {
        Self { constant: constant(step, timing), ..self }
    }

    /// This law of a transition with the input of another.
    pub(super) fn of_input(self, transition: &Transition<Rational>) -> Self {
        Self { constant: Fractions::of(&-&transition.input), ..self }
    }

    /// w, a common denominator of E ⊗ E and of the noise.
    pub(super) fn scale(&self) -> BigInt {
        least_common_multiple(&self.map.denominator * &self.map.denominator, &self.noise.denominator)
    }

    /// z, a common denominator of E and of the constants.
    pub(super) fn mean_scale(&self) -> BigInt {
        least_common_multiple(self.map.denominator.clone(), &self.constant.denominator)
    }

    /// The rows of the target with this number.
    pub(super) fn target(&self, target: usize) -> std::ops::Range<usize> {
        let first = self.observed + target * self.states;
        first..first + self.states
    }

    /// Whether an entry of the joint covariance is needed: those between two targets are not.
    pub(super) fn is_needed(&self, i: usize, j: usize) -> bool {
        i.min(j) < self.observed || self.target_of(i) == self.target_of(j)
    }

    /// The target to which a row belongs, if it is not an observed entry.
    pub(super) fn target_of(&self, row: usize) -> Option<usize> {
        row.checked_sub(self.observed).map(|place| place / self.states)
    }
}

/// The transition that departs from a step.
fn departing(step: &Step<Rational>, timing: Timing) -> Option<&Transition<Rational>> {
    step.transition.as_ref().filter(|_| timing == Timing::Departing)
}

fn constant(step: &Step<Rational>, timing: Timing) -> Fractions {
    let observed = step.reading.present();
    let seen = step.reading.values() - step.observation_input.select_rows(&observed);
    let constant = seen.above(&Matrix::zeros(step.observation.columns(), 1));
    match departing(step, timing) {
        Some(transition) => Fractions::of(&constant.above(&-&transition.input)),
        None => Fractions::of(&constant),
    }
}
