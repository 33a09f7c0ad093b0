//! What can be wrong with a case, with its path.

use super::document::{DocumentError, MAXIMAL_DOCUMENT_BYTES, located};
use super::{NumberError, witness};
use crate::matrix::RaggedRows;
use crate::model::{Field, ModelError};
use crate::scalar::Rational;

/// Why a text is not a case, or a case not a problem.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CaseError {
    /// The text is longer than [`MAXIMAL_DOCUMENT_BYTES`].
    #[error("the case has {bytes} bytes; at most {MAXIMAL_DOCUMENT_BYTES} are read, split it")]
    TooLong {
        /// Its length.
        bytes: usize,
    },
    /// The text is not JSON, or not of the form of a case.
    #[error("{}", located(path, message))]
    Document {
        /// Where, such as `noise.process[3][1][0]`; empty for the document itself.
        path: String,
        /// What is wrong.
        message: String,
    },
    /// A number literal has no value.
    #[error("{path}: {source}")]
    Number {
        /// Where, such as `noise.process[3][1][0]`.
        path: String,
        /// What is wrong.
        source: NumberError,
    },
    /// The rows of a matrix differ in length.
    #[error("{path}: {source}")]
    Ragged {
        /// Where, such as `noise.process[3]`.
        path: String,
        /// What is wrong.
        source: RaggedRows,
    },
    /// The case is well formed and describes no model.
    #[error("{}", described(.0))]
    Model(Box<ModelError<Rational>>),
}

impl From<ModelError<Rational>> for CaseError {
    fn from(error: ModelError<Rational>) -> Self {
        Self::Model(Box::new(error))
    }
}

impl From<DocumentError> for CaseError {
    fn from(error: DocumentError) -> Self {
        match error {
            DocumentError::TooLong { bytes } => Self::TooLong { bytes },
            DocumentError::Wrong { path, message } => Self::Document { path, message },
        }
    }
}

/// The path of the field, then what the model says, with a short witness where there is one.
fn described(error: &ModelError<Rational>) -> String {
    let field = match error {
        ModelError::Empty(field) | ModelError::Length { field, .. } => Some(*field),
        ModelError::Shape { place, .. }
        | ModelError::Absent { place }
        | ModelError::Asymmetric { place, .. }
        | ModelError::Indefinite { place, .. }
        | ModelError::Infinite { place, .. } => Some(place.field),
        ModelError::IndefiniteAndDiffuse => Some(Field::InitialDiffuse),
        ModelError::NoTransitionBefore => None,
    };
    let path = field.map_or("initial.before", path);
    match error {
        ModelError::Indefinite { place, matrix, proof } => {
            let proof = witness::described(matrix, proof);
            format!("{path}: {place} is not positive semidefinite: {proof}; no random vector has this covariance")
        }
        other => format!("{path}: {other}"),
    }
}

/// Where a field stands in the document.
fn path(field: Field) -> &'static str {
    match field {
        Field::InitialMean => "initial.mean",
        Field::InitialCovariance => "initial.covariance",
        Field::InitialDiffuse => "initial.diffuse",
        Field::Transition => "transition",
        Field::Observation => "observation",
        Field::ProcessFactor => "noise.process_factor",
        Field::ObservationFactor => "noise.observation_factor",
        Field::ProcessNoise => "noise.process",
        Field::CrossNoise => "noise.cross",
        Field::ObservationNoise => "noise.observation",
        Field::JointNoise => "noise",
        Field::InputMatrix => "input.matrix",
        Field::Input => "input.vector",
        Field::ObservationInputMatrix => "observation_input.matrix",
        Field::ObservationInput => "observation_input.vector",
        Field::Observations => "observations",
    }
}
