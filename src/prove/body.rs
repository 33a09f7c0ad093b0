//! What an identity consists of.

use std::fmt;

use super::entries::Entries;
use crate::matrix::Matrix;
use crate::scalar::{Field, ZeroTest};

/// The dimensions of an identity's matrices, with their letters: `n = 2, m = 1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    letters: &'static [&'static str],
    numbers: [usize; 3],
}

impl Size {
    /// The numbers, in the order of the letters; unused ones are zero.
    pub fn numbers(&self) -> [usize; 3] {
        self.numbers
    }

    pub(super) fn all(letters: &'static [&'static str], numbers: &[[usize; 3]]) -> Vec<Self> {
        numbers.iter().map(|&numbers| Self { letters, numbers }).collect()
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts: Vec<String> =
            self.letters.iter().zip(self.numbers).map(|(letter, number)| format!("{letter} = {number}")).collect();
        f.write_str(&parts.join(", "))
    }
}

/// Why an identity is not established, or its twin not disproved.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Failure {
    /// The sides differ.
    #[error("equation {equation} fails: entry ({row}, {column}) of its sides differs")]
    Differs {
        /// Which equation, counted from 1.
        equation: usize,
        /// The row, counted from 0.
        row: usize,
        /// The column, counted from 0.
        column: usize,
    },
    /// The shapes of the sides differ.
    #[error("equation {equation} fails: its sides have different shapes")]
    Shapes {
        /// Which equation, counted from 1.
        equation: usize,
    },
    /// A routine returned an error.
    #[error("no value: {0}")]
    NoValue(String),
    /// The rational functions passed the bound of work.
    #[error("the rational functions are too large for this size")]
    TooLarge,
    /// Runs at different points took different decisions, so no bound of the error is known.
    #[error("the decisions differ from point to point")]
    Decisions,
    /// The degrees are so large that random points show nothing.
    #[error("the degrees are too large for a check at random points")]
    NoBound,
    /// No point was found at which the twin fails while the identity holds.
    #[error("the twin survives {0} points")]
    TwinSurvives(usize),
}

/// Pairs of matrices that should be equal.
pub(super) type Sides<F> = Vec<(Matrix<F>, Matrix<F>)>;

/// An identity, over any field.
pub(super) trait Body {
    const IDENTIFIERS: &'static [&'static str];
    const NAME: &'static str;
    /// What differs in the twin.
    const SLIP: &'static str;
    const LETTERS: &'static [&'static str];
    const SYMBOLIC: &'static [[usize; 3]];
    /// Further ones, whose proofs take seconds.
    const HEAVY: &'static [[usize; 3]] = &[];
    const RANDOM: &'static [[usize; 3]];

    fn sides<F: Field>(numbers: [usize; 3], twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure>;
}

/// What a routine answered instead of a value.
pub(super) fn no_value(error: impl fmt::Debug) -> Failure {
    Failure::NoValue(format!("{error:?}").chars().take(160).collect())
}

/// The first difference, if there is one.
pub(super) fn compared<F: Field>(sides: &Sides<F>) -> Result<(), Failure> {
    if sides.is_empty() {
        return Err(Failure::NoValue("there is no equation".to_owned()));
    }
    for (place, (left, right)) in sides.iter().enumerate() {
        let equation = place + 1;
        if left.shape() != right.shape() {
            return Err(Failure::Shapes { equation });
        }
        for row in 0..left.rows() {
            for column in 0..left.columns() {
                match left[(row, column)].minus(&right[(row, column)]).zero_test() {
                    ZeroTest::Zero => {}
                    ZeroTest::Nonzero => return Err(Failure::Differs { equation, row, column }),
                    ZeroTest::Undecided => return Err(Failure::TooLarge),
                }
            }
        }
    }
    Ok(())
}
