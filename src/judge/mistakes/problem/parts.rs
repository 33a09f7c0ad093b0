//! Coefficients of another step than their own, and transposed ones.

use super::{Change, each_step, with_steps};
use crate::matrix::Matrix;
use crate::model::Step;
use crate::scalar::Rational;

/// A coefficient that may differ from step to step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Part {
    Transition,
    Input,
    ProcessNoise,
    Observation,
    ObservationNoise,
}

impl Part {
    /// The coefficient, where the step has it.
    pub(super) fn of(self, step: &mut Step<Rational>) -> Option<&mut Matrix<Rational>> {
        match self {
            Self::Transition => step.transition.as_mut().map(|transition| &mut transition.matrix),
            Self::Input => step.transition.as_mut().map(|transition| &mut transition.input),
            Self::ProcessNoise => step.transition.as_mut().map(|transition| &mut transition.noise),
            Self::Observation => Some(&mut step.observation),
            Self::ObservationNoise => Some(&mut step.observation_noise),
        }
    }
}

/// Gives each step the coefficient that `chosen` picks of all there are, in order.
fn replaced(part: Part, chosen: impl Fn(usize, usize) -> usize + Send + Sync + 'static) -> Change {
    Box::new(move |path| {
        let mut steps = path.steps().to_vec();
        let all: Vec<Matrix<Rational>> = steps.iter_mut().filter_map(|step| part.of(step).cloned()).collect();
        let last = all.len().checked_sub(1)?;
        for (place, own) in steps.iter_mut().filter_map(|step| part.of(step)).enumerate() {
            own.clone_from(&all[chosen(place, last)]);
        }
        Some(with_steps(path, steps))
    })
}

/// The coefficient of the next step, or of the one before; where there is none, the step's own.
pub(in super::super) fn of_another_step(part: Part, next: bool) -> Change {
    replaced(part, move |place, last| if next { (place + 1).min(last) } else { place.saturating_sub(1) })
}

/// The first coefficient for all steps, or the last.
pub(in super::super) fn frozen(part: Part, first: bool) -> Change {
    replaced(part, move |_, last| if first { 0 } else { last })
}

/// The coefficient transposed, if it is square.
pub(in super::super) fn transposed(part: Part) -> Change {
    Box::new(move |path| {
        let changed = each_step(path, |step| {
            if let Some(own) = part.of(step).filter(|own| own.is_square()) {
                *own = own.transpose();
            }
        });
        Some(changed)
    })
}
