//! Covariances that are dropped, changed entry by entry, or taken for each other.

use super::super::real::Real;
use super::parts::Part;
use super::{Change, each_step, with_steps};
use crate::matrix::Matrix;
use crate::model::{Initial, Path};
use crate::scalar::{Rational, Scalar as _};

/// A covariance of the problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Covariance {
    Process,
    Observation,
    Initial,
}

/// The problem with a covariance changed.
pub(in super::super) fn on_noise(
    which: Covariance,
    change: impl Fn(&Matrix<Rational>) -> Matrix<Rational> + Send + Sync + 'static,
) -> Change {
    let part = match which {
        Covariance::Process => Part::ProcessNoise,
        Covariance::Observation => Part::ObservationNoise,
        Covariance::Initial => {
            return Box::new(move |path| {
                let initial = path.initial();
                let initial = Initial { covariance: change(&initial.covariance), ..initial.clone() };
                Some(Path::from_parts(path.timing(), initial, path.steps().to_vec()))
            });
        }
    };
    Box::new(move |path| {
        Some(each_step(path, |step| {
            if let Some(own) = part.of(step) {
                *own = change(own);
            }
        }))
    })
}

/// Process and observation noise taken for each other, where they have one size.
pub(in super::super) fn noises_swapped() -> Change {
    Box::new(|path| {
        if path.states() != path.sensors() {
            return None;
        }
        let mut steps = path.steps().to_vec();
        for step in &mut steps {
            if let Some(transition) = &mut step.transition {
                std::mem::swap(&mut transition.noise, &mut step.observation_noise);
            }
        }
        Some(with_steps(path, steps))
    })
}

/// The root, to 256 bits, of the magnitude; with the sign of the number.
pub(in super::super) fn root(value: &Rational) -> Rational {
    let zero = Rational::zero();
    let magnitude = if *value < zero { value.negated() } else { value.clone() };
    let root = Real::from(&magnitude).root().map_or_else(Rational::zero, |root| root.value());
    if *value < zero { root.negated() } else { root }
}
