//! The laws of the steps, worked out once where the system does not change.

use std::borrow::Cow;

use super::law::Law;
use super::state::State;
use crate::model::{Step, Timing, Transition};
use crate::scalar::Rational;

/// The laws of the last step: the next one has the same where it differs in its reading and inputs alone.
#[derive(Debug, Default)]
pub(super) struct Laws<'a> {
    observed: Option<(&'a Step<Rational>, Law)>,
    arriving: Option<(&'a Transition<Rational>, Law)>,
    generation: u64,
}

/// The laws of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct StepLaws<'l> {
    /// That of the transition into the observed state, if it is still to be made.
    pub(super) transition: Option<&'l Law>,
    /// That of the observation and its targets.
    pub(super) observation: &'l Law,
    /// Laws with the same number differ in their constants alone.
    pub(super) generation: u64,
}

impl<'a> Laws<'a> {
    /// The laws of a step, given the transition that is still to be made before its observation.
    pub(super) fn of(
        &mut self,
        step: &'a Step<Rational>,
        transition: Option<&'a Transition<Rational>>,
        timing: Timing,
    ) -> StepLaws<'_> {
        let (observed, new_observed) = match self.observed.take() {
            Some((last, law)) if last.differs_in_data_alone(step) => (law.of_data(step, timing), false),
            _ => (Law::of(step, timing), true),
        };
        let (arriving, new_arriving) = match (self.arriving.take(), transition) {
            (Some((last, law)), Some(next)) if last.matrix == next.matrix && last.noise == next.noise => {
                (Some((next, law.of_input(next))), false)
            }
            (last, next) => (next.map(|next| (next, Law::of_transition(next))), last.is_some() || next.is_some()),
        };
        self.generation += u64::from(new_observed || new_arriving);
        self.arriving = arriving;
        let observation = &self.observed.insert((step, observed)).1;
        let transition = self.arriving.as_ref().map(|(_, law)| law);
        StepLaws { transition, observation, generation: self.generation }
    }
}

impl StepLaws<'_> {
    /// The state that is observed.
    pub(super) fn predicted<'s>(&self, state: &'s State) -> Cow<'s, State> {
        self.transition.map_or(Cow::Borrowed(state), |law| Cow::Owned(state.propagated(law)))
    }
}
