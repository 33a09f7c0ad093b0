//! What is done where readings are missing.

use super::{Change, with_steps};
use crate::matrix::Matrix;
use crate::model::{Observation, Step, Timing};
use crate::scalar::{Rational, ratio};

/// A way to treat what is missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Gap {
    /// A missing entry is read as 0.
    Zero,
    /// A missing entry is read as the last one of its sensor.
    LastReading,
    /// A reading with a missing entry is not used at all.
    WholeReading,
    /// No time passes where nothing is read.
    NoTime,
}

/// The problem in which the gaps are treated so.
pub(in super::super) fn gaps(gap: Gap) -> Change {
    Box::new(move |path| {
        let mut steps = path.steps().to_vec();
        if gap == Gap::NoTime {
            stop_time(&mut steps, path.timing());
            return Some(with_steps(path, steps));
        }
        let mut last: Vec<Option<Rational>> = vec![None; path.sensors()];
        for step in &mut steps {
            let entries = step.reading.entries();
            let filled = match gap {
                Gap::WholeReading if entries.iter().any(Option::is_none) => vec![None; entries.len()],
                Gap::Zero => entries.iter().map(|y| y.clone().or_else(|| Some(ratio(0, 1)))).collect(),
                Gap::LastReading => {
                    entries.iter().zip(&last).map(|(y, last)| y.clone().or_else(|| last.clone())).collect()
                }
                _ => entries.to_vec(),
            };
            last.clone_from(&filled);
            step.reading = Observation::new(filled);
        }
        Some(with_steps(path, steps))
    })
}

/// The transition beside an observation without any entry does nothing.
fn stop_time(steps: &mut [Step<Rational>], timing: Timing) {
    for (k, step) in steps.iter_mut().enumerate() {
        let is_beside = timing == Timing::Departing || k > 0;
        let nothing = step.reading.present().is_empty();
        if let Some(transition) = step.transition.as_mut().filter(|_| nothing && is_beside) {
            let n = transition.matrix.rows();
            transition.matrix = Matrix::identity(n);
            transition.input = Matrix::zeros(n, 1);
            transition.noise = Matrix::zeros(n, n);
        }
    }
}
