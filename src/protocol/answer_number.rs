//! The numbers of an answer as they are written.

use super::number::{name_of, shortest_double};
use super::{Decimal, Number, Numbers};
use crate::scalar::Rational;

mod sealed {
    pub trait Sealed {}
    impl Sealed for f64 {}
    impl Sealed for crate::scalar::Rational {}
    impl Sealed for super::Number {}
    impl Sealed for super::Decimal {}
}

/// A type whose values can be written into an answer: `f64`, [`Rational`], [`Number`], [`Decimal`].
pub trait AnswerNumber: sealed::Sealed {
    /// What the strings mean.
    const NUMBERS: Numbers;

    /// The literal.
    fn literal(&self) -> String;
}

impl AnswerNumber for f64 {
    const NUMBERS: Numbers = Numbers::Binary64;

    fn literal(&self) -> String {
        shortest_double(*self)
    }
}

impl AnswerNumber for Rational {
    const NUMBERS: Numbers = Numbers::Exact;

    fn literal(&self) -> String {
        Numbers::Exact.write(self)
    }
}

impl AnswerNumber for Number {
    const NUMBERS: Numbers = Numbers::Exact;

    fn literal(&self) -> String {
        match self {
            Self::Finite(value) => Numbers::Exact.write(value),
            Self::Infinite { negative } => name_of(false, *negative).to_owned(),
            Self::NotANumber => name_of(true, false).to_owned(),
        }
    }
}

impl AnswerNumber for Decimal {
    const NUMBERS: Numbers = Numbers::Exact;

    fn literal(&self) -> String {
        self.to_string()
    }
}
