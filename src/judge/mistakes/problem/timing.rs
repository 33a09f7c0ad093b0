//! Transitions and shared noise of the other timing.

use super::{Change, each_step};
use crate::matrix::Matrix;
use crate::model::{Before, Initial, Path, Step, Timing, Transition};
use crate::scalar::Rational;

/// What is done with the noise that transition and observation share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Cross {
    Dropped,
    OtherSign,
    /// It is shared with the reading at the other end of the transition.
    OtherEnd,
}

/// The problem with that shared noise.
pub(in super::super) fn cross_noise(cross: Cross) -> Change {
    Box::new(move |path| match cross {
        Cross::OtherEnd => other_end(path),
        Cross::Dropped | Cross::OtherSign => Some(each_step(path, |step| {
            if let Some(Transition { cross_noise, .. }) = &mut step.transition {
                *cross_noise = match cross {
                    Cross::OtherSign => -&*cross_noise,
                    _ => Matrix::zeros(cross_noise.rows(), cross_noise.columns()),
                };
            }
        })),
    })
}

/// Transition k leads into k where it should lead out of it, or the other way round; what it shares with y_k goes with it.
pub(in super::super) fn other_timing() -> Change {
    Box::new(|path| {
        let transitions: Vec<_> = path.steps().iter().map(|step| step.transition.clone()).collect();
        let known = transitions.iter().flatten();
        let (first, last) = (known.clone().next()?.clone(), known.last()?.clone());
        if transitions.iter().flatten().all(|own| *own == first && own.cross_noise.is_zero()) {
            return None;
        }
        let count = transitions.len();
        let own =
            |k: usize| transitions[k].clone().unwrap_or_else(|| if k == 0 { first.clone() } else { last.clone() });
        Some(match path.timing() {
            Timing::Departing => rebuilt(path, Timing::Arriving, |k| (k > 0).then(|| own(k))),
            Timing::Arriving => rebuilt(path, Timing::Departing, |k| (k + 1 < count).then(|| own(k))),
        })
    })
}

/// Each transition stays where it is, and shares its noise with the reading at its other end.
fn other_end(path: &Path<Rational>) -> Option<Path<Rational>> {
    let steps = path.steps();
    let of = |k: usize| steps.get(k).and_then(|step| step.transition.clone());
    let is_shared = |step: &Step<Rational>| step.transition.as_ref().is_some_and(|t| !t.cross_noise.is_zero());
    if !steps.iter().any(is_shared) {
        return None;
    }
    Some(match path.timing() {
        Timing::Departing => rebuilt(path, Timing::Arriving, |k| k.checked_sub(1).and_then(of)),
        Timing::Arriving => {
            let mut departing = rebuilt(path, Timing::Departing, |k| of(k + 1));
            if let (Before::Transition, Some(first)) = (path.initial().before, of(0)) {
                let initial = path.initial();
                let mean = &first.matrix * &initial.mean + &first.input;
                let covariance = first.matrix.congruence(&initial.covariance) + &first.noise;
                let initial = Initial { before: Before::Observation, mean, covariance, ..initial.clone() };
                departing = Path::from_parts(Timing::Departing, initial, departing.steps().to_vec());
            }
            departing
        }
    })
}

fn rebuilt(
    path: &Path<Rational>,
    timing: Timing,
    transition: impl Fn(usize) -> Option<Transition<Rational>>,
) -> Path<Rational> {
    let step = |(k, step): (usize, &Step<Rational>)| Step { transition: transition(k), ..step.clone() };
    let initial = Initial { before: Before::Observation, ..path.initial().clone() };
    Path::from_parts(timing, initial, path.steps().iter().enumerate().map(step).collect())
}
