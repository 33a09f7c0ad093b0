//! Other problems: a wrong filter is very often the right filter of one.

mod inputs;
mod missing;
mod noise;
mod parts;
mod start;
mod timing;

pub(super) use inputs::{negated, without};
pub(super) use missing::{Gap, gaps};
pub(super) use noise::{Covariance, noises_swapped, on_noise, root};
pub(super) use parts::{Part, frozen, of_another_step, transposed};
pub(super) use start::{Start, started};
pub(super) use timing::{Cross, cross_noise, other_timing};

use crate::model::{Path, Step};
use crate::scalar::Rational;

/// From a problem to another one; nothing where it makes no sense.
pub(super) type Change = Box<dyn Fn(&Path<Rational>) -> Option<Path<Rational>> + Send + Sync>;

/// The path with other steps.
fn with_steps(path: &Path<Rational>, steps: Vec<Step<Rational>>) -> Path<Rational> {
    Path::from_parts(path.timing(), path.initial().clone(), steps)
}

/// The path with each step changed by itself.
fn each_step(path: &Path<Rational>, mut change: impl FnMut(&mut Step<Rational>)) -> Path<Rational> {
    let mut steps = path.steps().to_vec();
    steps.iter_mut().for_each(&mut change);
    with_steps(path, steps)
}
