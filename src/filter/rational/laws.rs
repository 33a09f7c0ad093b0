//! The laws of the steps, worked out once where the system does not change.

use super::law::Law;
use crate::model::{Step, Timing, Transition};
use crate::scalar::Rational;

/// The laws of the last step: the next one has the same where it differs in its reading and inputs alone.
#[derive(Debug, Default)]
pub(super) struct Laws<'a> {
    observed: Option<(&'a Step<Rational>, Law)>,
    arriving: Option<(&'a Transition<Rational>, Law)>,
}

impl<'a> Laws<'a> {
    /// The law of a step whose predicted state is known.
    pub(super) fn of(&mut self, step: &'a Step<Rational>, timing: Timing) -> &Law {
        let law = match self.observed.take() {
            Some((last, law)) if differ_in_data_alone(last, step) => law.of_data(step, timing),
            _ => Law::of(step, timing),
        };
        &self.observed.insert((step, law)).1
    }

    /// The law of a transition alone.
    pub(super) fn of_transition(&mut self, transition: &'a Transition<Rational>) -> &Law {
        let law = match self.arriving.take() {
            Some((last, law)) if last.matrix == transition.matrix && last.noise == transition.noise => {
                law.of_input(transition)
            }
            _ => Law::of_transition(transition),
        };
        &self.arriving.insert((transition, law)).1
    }
}

fn differ_in_data_alone(last: &Step<Rational>, step: &Step<Rational>) -> bool {
    let same_transition = match (&last.transition, &step.transition) {
        (Some(last), Some(next)) => {
            last.cross_noise == next.cross_noise && last.matrix == next.matrix && last.noise == next.noise
        }
        (None, None) => true,
        _ => false,
    };
    same_transition
        && last.observation == step.observation
        && last.observation_noise == step.observation_noise
        && last.reading.present() == step.reading.present()
}
