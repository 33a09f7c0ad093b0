//! An answer, with values.

use serde::{Deserialize, Serialize};

use super::ahead_document::LawDocument;
use super::answer_document::{AnswerDocument, Nested, StepDocument};
use super::answer_number::AnswerNumber;
use super::document::{self, DocumentError, MAXIMAL_DOCUMENT_BYTES, located};
use super::{Number, NumberError};
use crate::matrix::{Matrix, RaggedRows};
use crate::trace::Values;

/// What a subject did with a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// It estimated.
    Answered,
    /// It refused the input as bad.
    Refused,
    /// It estimated, and says that data and model contradict each other.
    Flagged,
    /// It failed.
    Error,
    /// It does not know this kind of model.
    Unsupported,
}

impl std::fmt::Display for Outcome {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(match self {
            Self::Answered => "answered",
            Self::Refused => "refused",
            Self::Flagged => "flagged",
            Self::Error => "error",
            Self::Unsupported => "unsupported",
        })
    }
}

/// What a subject says to a case.
///
/// What is read has entries of type [`Number`]; to write an answer, use `f64` or
/// [`Rational`](crate::scalar::Rational).
///
/// # Examples
///
/// ```
/// use exact_kalman::protocol::{Answer, Number};
/// use exact_kalman::scalar::ratio;
/// use exact_kalman::trace::Quantity;
///
/// let line = r#"{"id":"walk","outcome":"answered","steps":[{"filtered_mean":["0.5"]}]}"#;
/// let answer = Answer::parse(line)?;
/// assert_eq!(answer.steps[0][&Quantity::FilteredMean][(0, 0)], Number::Finite(ratio(1, 2)));
/// # Ok::<(), exact_kalman::protocol::AnswerError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answer<T = Number> {
    /// The id of the case.
    pub id: String,
    /// What the subject did.
    pub outcome: Outcome,
    /// The step at which it failed or flagged, from 0.
    pub step: Option<usize>,
    /// Why, in words.
    pub message: Option<String>,
    /// The results by name, one entry per observation.
    pub steps: Vec<Values<T>>,
    /// For each step k the laws of x_{k+1}, x_{k+2}, … given y_0, …, y_k, nothing where there is no finite one. Empty if no
    /// step has any; not judged.
    pub ahead: Vec<Vec<Option<LawAhead<T>>>>,
}

/// The law of a state ahead of the observations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LawAhead<T> {
    /// The mean, n×1.
    pub mean: Matrix<T>,
    /// The covariance, n×n.
    pub covariance: Matrix<T>,
}

/// Why a text is not an answer.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum AnswerError {
    /// The text is longer than [`MAXIMAL_DOCUMENT_BYTES`].
    #[error("the answer has {bytes} bytes; at most {MAXIMAL_DOCUMENT_BYTES} are read")]
    TooLong {
        /// Its length.
        bytes: usize,
    },
    /// The text is not JSON, or not of the form of an answer.
    #[error("{}", located(path, message))]
    Document {
        /// Where, such as `steps[3].filtered_covariance[1][0]`; empty for the document itself.
        path: String,
        /// What is wrong.
        message: String,
    },
    /// A number has no value.
    #[error("{path}: {source}")]
    Number {
        /// Where.
        path: String,
        /// What is wrong.
        source: NumberError,
    },
    /// The rows of a matrix differ in length.
    #[error("{path}: {source}")]
    Ragged {
        /// Where.
        path: String,
        /// What is wrong.
        source: RaggedRows,
    },
}

impl Answer<Number> {
    /// Reads one answer.
    ///
    /// # Errors
    ///
    /// [`AnswerError`] with the path of what is wrong.
    pub fn parse(text: &str) -> Result<Self, AnswerError> {
        document::parse::<AnswerDocument>(text).map_err(|error| AnswerError::from_document(error, text))?.values()
    }
}

impl<T: AnswerNumber> Answer<T> {
    /// An answer with estimates.
    pub fn answered(id: impl Into<String>, steps: Vec<Values<T>>) -> Self {
        Self { id: id.into(), outcome: Outcome::Answered, step: None, message: None, steps, ahead: Vec::new() }
    }

    /// The answer on one line, every number a string.
    pub fn to_line(&self) -> String {
        let step = |(k, values): (usize, &Values<T>)| StepDocument {
            quantities: values.iter().map(|(name, matrix)| (*name, Nested::of(*name, matrix))).collect(),
            ahead: self.ahead.get(k).into_iter().flatten().map(|law| law.as_ref().map(LawDocument::of)).collect(),
        };
        document::line(&AnswerDocument {
            id: self.id.clone(),
            outcome: self.outcome,
            numbers: T::NUMBERS,
            step: self.step,
            message: self.message.clone(),
            steps: self.steps.iter().enumerate().map(step).collect(),
        })
    }
}

impl AnswerError {
    fn from_document(error: DocumentError, text: &str) -> Self {
        match error {
            DocumentError::TooLong { bytes } => Self::TooLong { bytes },
            DocumentError::Wrong { path, message } => {
                // What default JSON writers of several languages print for a float that is not finite.
                let bare =
                    [":NaN", ": NaN", "[NaN", ", NaN", ",NaN", "Infinity"].iter().any(|name| text.contains(name));
                let syntax = message.starts_with("expected value") || message.starts_with("invalid number");
                let hint = if bare && syntax { "; JSON has no NaN or Infinity: write \"NaN\", in quotes" } else { "" };
                Self::Document { path, message: message + hint }
            }
        }
    }
}
