//! What an identity consists of.

use std::fmt;

use super::entries::Entries;
use crate::matrix::Matrix;
use crate::scalar::{Field, ZeroTest};

/// The dimensions of an identity's matrices, with their letters: `n = 2, m = 1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    letters: &'static [&'static str],
    numbers: &'static [usize],
}

/// The numbers of a size, with zeros behind them: what bodies take apart.
pub(super) type Numbers = [usize; 5];

impl Size {
    /// The numbers, in the order of the letters.
    pub fn numbers(&self) -> &'static [usize] {
        self.numbers
    }

    pub(super) fn all(letters: &'static [&'static str], sizes: &[&'static [usize]]) -> Vec<Self> {
        let size = |&numbers: &&'static [usize]| {
            assert_eq!(numbers.len(), letters.len(), "each letter has a number");
            Self { letters, numbers }
        };
        sizes.iter().map(size).collect()
    }

    pub(super) fn padded(&self) -> Numbers {
        std::array::from_fn(|place| self.numbers.get(place).copied().unwrap_or(0))
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
    /// The sides are lists of different lengths.
    #[error("one side has {left} steps, the other {right}")]
    Lengths {
        /// That of the first.
        left: usize,
        /// That of the second.
        right: usize,
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
    /// What was supposed, beyond that the code decides as it does for variables: "where …".
    const WHERE: &'static str;
    /// What differs in the twin.
    const SLIP: &'static str;
    const LETTERS: &'static [&'static str];
    const SYMBOLIC: &'static [&'static [usize]];
    /// Further ones, whose proofs take seconds.
    const HEAVY: &'static [&'static [usize]] = &[];
    const RANDOM: &'static [&'static [usize]];

    fn sides<F: Field>(numbers: Numbers, twin: bool, entries: &mut Entries<'_, F>) -> Result<Sides<F>, Failure>;
}

/// What a routine answered instead of a value.
pub(super) fn no_value(error: impl fmt::Debug) -> Failure {
    Failure::NoValue(format!("{error:?}").chars().take(160).collect())
}

/// What belongs together; a step that is missing on one side is a failure, not left out.
pub(super) fn paired<A, B>(
    left: impl IntoIterator<Item = A>,
    right: impl IntoIterator<Item = B>,
) -> Result<Vec<(A, B)>, Failure> {
    let (left, right): (Vec<A>, Vec<B>) = (left.into_iter().collect(), right.into_iter().collect());
    if left.len() == right.len() {
        Ok(left.into_iter().zip(right).collect())
    } else {
        Err(Failure::Lengths { left: left.len(), right: right.len() })
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_step_is_a_failure() {
        assert_eq!(paired([1, 2], ["a", "b"]), Ok(vec![(1, "a"), (2, "b")]));
        assert_eq!(paired([1, 2], ["a"]), Err(Failure::Lengths { left: 2, right: 1 }));
    }
}
