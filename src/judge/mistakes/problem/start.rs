//! Other starts.

use super::Change;
use crate::matrix::Matrix;
use crate::model::{Before, Initial, Path, Step, Timing, Transition};
use crate::scalar::Rational;

/// A way to begin.
#[derive(Clone, Debug)]
pub(in super::super) enum Start {
    /// One transition before the given law is that of the first state, though it is.
    Moved { with_input: bool },
    /// As before, and transition k leads into k from then on.
    MovedByEachStep,
    /// The law before the first transition is taken for that after it.
    NotMoved,
    /// The mean is 0.
    MeanZero,
    /// The covariance is I.
    CovarianceIdentity,
    /// The covariance is 0.
    CovarianceZero,
    /// The diffuse part is left out.
    WithoutDiffuse,
    /// The diffuse part counts so many times.
    DiffuseTimes(Rational),
}

/// The problem with that start.
pub(in super::super) fn started(start: Start) -> Change {
    Box::new(move |path| {
        let initial = path.initial();
        let n = path.states();
        let with = |initial: Initial<Rational>| Path::from_parts(path.timing(), initial, path.steps().to_vec());
        Some(match &start {
            Start::Moved { with_input } => {
                let first = first_transition(path).filter(|_| initial.before == Before::Observation)?;
                with(moved(initial, first, *with_input))
            }
            Start::MovedByEachStep => return moved_by_each_step(path),
            Start::NotMoved => return not_moved(path),
            Start::MeanZero => with(Initial { mean: Matrix::zeros(n, 1), ..initial.clone() }),
            Start::CovarianceIdentity => {
                with(Initial { covariance: Matrix::identity(n), diffuse: None, ..initial.clone() })
            }
            Start::CovarianceZero => {
                with(Initial { covariance: Matrix::zeros(n, n), diffuse: None, ..initial.clone() })
            }
            Start::WithoutDiffuse => with(Initial { diffuse: None, ..initial.clone() }),
            Start::DiffuseTimes(factor) => {
                let covariance = &initial.covariance + initial.diffuse.as_ref()?.scaled(factor);
                with(Initial { covariance, diffuse: None, ..initial.clone() })
            }
        })
    })
}

/// The transition that comes first; the one after it where the first state has none of its own.
fn first_transition(path: &Path<Rational>) -> Option<&Transition<Rational>> {
    path.steps().iter().find_map(|step| step.transition.as_ref())
}

fn moved(initial: &Initial<Rational>, transition: &Transition<Rational>, with_input: bool) -> Initial<Rational> {
    let a = &transition.matrix;
    let mean = a * &initial.mean;
    Initial {
        mean: if with_input { mean + &transition.input } else { mean },
        covariance: a.congruence(&initial.covariance) + &transition.noise,
        diffuse: initial.diffuse.as_ref().map(|part| a.congruence(part)),
        ..initial.clone()
    }
}

/// Predict by the step's own transition, then read: as many loops are written.
fn moved_by_each_step(path: &Path<Rational>) -> Option<Path<Rational>> {
    if path.initial().before == Before::Transition || path.timing() == Timing::Arriving {
        return None;
    }
    let mut last = first_transition(path)?.clone();
    let steps = path.steps().iter().map(|step| {
        if let Some(own) = &step.transition {
            last = own.clone();
        }
        Step { transition: Some(last.clone()), ..step.clone() }
    });
    let steps = steps.collect();
    Some(Path::from_parts(Timing::Arriving, Initial { before: Before::Transition, ..path.initial().clone() }, steps))
}

fn not_moved(path: &Path<Rational>) -> Option<Path<Rational>> {
    if path.initial().before == Before::Observation {
        return None;
    }
    let mut steps = path.steps().to_vec();
    steps.first_mut()?.transition = None;
    Some(Path::from_parts(path.timing(), Initial { before: Before::Observation, ..path.initial().clone() }, steps))
}
