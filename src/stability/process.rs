//! How modes follow each other.

use super::Mode;
use crate::matrix::{Matrix, Shape};
use crate::scalar::OrderedField;

/// A Markov chain on finitely many modes; the mode of time 0 has the law `initial`.
///
/// # Examples
///
/// An observation that arrives three times out of four:
///
/// ```
/// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}, stability::{Mode, ModeProcess}};
///
/// let scalar = |value| Matrix::<Rational>::diagonal(&[value]);
/// let mode = |h| Mode::new(scalar(ratio(3, 2)), scalar(ratio(h, 1)), scalar(ratio(1, 1)), scalar(ratio(1, 1)));
/// let link = ModeProcess::independent(vec![mode(0)?, mode(1)?], vec![ratio(1, 4), ratio(3, 4)])?;
/// assert_eq!(link.states(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModeProcess<S> {
    modes: Vec<Mode<S>>,
    initial: Vec<S>,
    transition: Matrix<S>,
}

/// Why modes and probabilities make no process.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ProcessError<S> {
    /// There is no mode.
    #[error("a process has at least one mode")]
    Empty,
    /// A mode has a state of another dimension.
    #[error("mode {mode} has {found} states, the first one {expected}")]
    Dimension {
        /// The mode, counted from 0.
        mode: usize,
        /// d of the first mode.
        expected: usize,
        /// d of this mode.
        found: usize,
    },
    /// The number of probabilities is not that of the modes.
    #[error("{found} initial probabilities for {expected} modes")]
    InitialLength {
        /// The number of modes.
        expected: usize,
        /// The number of probabilities.
        found: usize,
    },
    /// The matrix of transition probabilities does not fit the modes.
    #[error("the transition probabilities are {found} for {modes} modes")]
    TransitionShape {
        /// The number of modes.
        modes: usize,
        /// The shape.
        found: Shape,
    },
    /// A probability is negative.
    #[error("a probability {} is negative", of(*row))]
    Negative {
        /// The mode from which; nothing for the initial law.
        row: Option<usize>,
        /// The mode to which.
        mode: usize,
        /// The number.
        value: S,
    },
    /// Probabilities do not add up to one.
    #[error("the probabilities {} do not add up to one", of(*row))]
    Sum {
        /// The mode from which; nothing for the initial law.
        row: Option<usize>,
        /// What they add up to.
        sum: S,
    },
}

fn of(row: Option<usize>) -> String {
    row.map_or_else(|| "of the first mode".to_owned(), |row| format!("of the mode after mode {row}"))
}

impl<S: OrderedField> ModeProcess<S> {
    /// The chain with this law of the first mode, and `transition[(i, j)]` the probability that mode j follows mode i.
    ///
    /// # Errors
    ///
    /// [`ProcessError`] where dimensions differ or probabilities are none.
    pub fn markov(modes: Vec<Mode<S>>, initial: Vec<S>, transition: Matrix<S>) -> Result<Self, ProcessError<S>> {
        let expected = modes.first().ok_or(ProcessError::Empty)?.states();
        if let Some((mode, part)) = modes.iter().enumerate().find(|(_, part)| part.states() != expected) {
            return Err(ProcessError::Dimension { mode, expected, found: part.states() });
        }
        let count = modes.len();
        if initial.len() != count {
            return Err(ProcessError::InitialLength { expected: count, found: initial.len() });
        }
        if transition.shape() != (Shape { rows: count, columns: count }) {
            return Err(ProcessError::TransitionShape { modes: count, found: transition.shape() });
        }
        check_law(None, &initial)?;
        (0..count).try_for_each(|row| check_law(Some(row), transition.row(row)))?;
        Ok(Self { modes, initial, transition })
    }

    /// Modes drawn anew at each time, with these probabilities.
    ///
    /// # Errors
    ///
    /// As for [`ModeProcess::markov`].
    pub fn independent(modes: Vec<Mode<S>>, probabilities: Vec<S>) -> Result<Self, ProcessError<S>> {
        let count = modes.len();
        if probabilities.len() != count {
            return Err(ProcessError::InitialLength { expected: count, found: probabilities.len() });
        }
        let transition = Matrix::from_fn(count, count, |_, mode| probabilities[mode].clone());
        Self::markov(modes, probabilities, transition)
    }

    /// d.
    pub fn states(&self) -> usize {
        self.modes[0].states()
    }

    /// The modes.
    pub fn modes(&self) -> &[Mode<S>] {
        &self.modes
    }

    /// The law of the first mode.
    pub fn initial(&self) -> &[S] {
        &self.initial
    }

    /// The probability that the mode `to` follows the mode `from`.
    pub fn transition(&self) -> &Matrix<S> {
        &self.transition
    }

    /// The modes that follow a mode with positive probability.
    ///
    /// # Panics
    ///
    /// If there is no such mode.
    pub fn successors(&self, from: usize) -> impl Iterator<Item = usize> + '_ {
        (0..self.modes.len()).filter(move |&to| self.transition[(from, to)] > S::zero())
    }

    /// The modes that occur at some time with positive probability, in ascending order.
    pub fn reachable(&self) -> Vec<usize> {
        let mut found: Vec<bool> = self.initial.iter().map(|probability| *probability > S::zero()).collect();
        let mut pending: Vec<usize> = (0..found.len()).filter(|&mode| found[mode]).collect();
        while let Some(from) = pending.pop() {
            for to in self.successors(from) {
                if !std::mem::replace(&mut found[to], true) {
                    pending.push(to);
                }
            }
        }
        (0..found.len()).filter(|&mode| found[mode]).collect()
    }
}

fn check_law<S: OrderedField>(row: Option<usize>, law: &[S]) -> Result<(), ProcessError<S>> {
    if let Some((mode, value)) = law.iter().enumerate().find(|(_, value)| **value < S::zero()) {
        return Err(ProcessError::Negative { row, mode, value: value.clone() });
    }
    let sum = law.iter().fold(S::zero(), |sum, value| sum.plus(value));
    if sum == S::one() { Ok(()) } else { Err(ProcessError::Sum { row, sum }) }
}
