//! Processes of random modes against the enumeration of all their paths.

mod draws;
mod expectation;
mod observability;
mod uniform_bound;

use exact_kalman::scalar::{Rational, Scalar, ratio};
use exact_kalman::stability::ModeProcess;

type Process = ModeProcess<Rational>;

/// A path from time 0, or from any time on, and its probability given that it begins there.
#[derive(Clone)]
struct Weighted {
    modes: Vec<usize>,
    probability: Rational,
}

/// Every path of `steps` modes that has positive probability, from time 0 on, in lexicographic order.
fn paths(process: &Process, steps: usize) -> Vec<Weighted> {
    let whole = Weighted { modes: Vec::new(), probability: ratio(1, 1) };
    (0..steps).fold(vec![whole], |paths, _| paths.iter().flat_map(|path| continued(process, path)).collect())
}

fn continued(process: &Process, path: &Weighted) -> Vec<Weighted> {
    let all = 0..process.modes().len();
    let grown = all.map(|mode| {
        let step = match path.modes.last() {
            Some(&last) => &process.transition()[(last, mode)],
            None => &process.initial()[mode],
        };
        let modes = path.modes.iter().copied().chain([mode]).collect();
        Weighted { modes, probability: path.probability.times(step) }
    });
    grown.filter(|path| path.probability > ratio(0, 1)).collect()
}

/// Every path of `steps` modes that begins at some time with positive probability. What occurs at all occurs before time
/// n, n being the number of modes.
fn windows(process: &Process, steps: usize) -> Vec<Vec<usize>> {
    let count = process.modes().len();
    let mut begun: Vec<usize> =
        (1..=count).flat_map(|time| paths(process, time)).map(|path| path.modes[path.modes.len() - 1]).collect();
    begun.sort_unstable();
    begun.dedup();
    let begun = begun.into_iter().map(|mode| Weighted { modes: vec![mode], probability: ratio(1, 1) }).collect();
    let grown = (1..steps)
        .fold(begun, |paths: Vec<Weighted>, _| paths.iter().flat_map(|path| continued(process, path)).collect());
    grown.into_iter().map(|path| path.modes).collect()
}
