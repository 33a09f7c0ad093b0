//! Why a document that asks a question is refused.

use super::NumberError;
use super::document::{DocumentError, MAXIMAL_DOCUMENT_BYTES, located};

/// Why a text is no document of its form.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum InputError {
    /// The text is too long.
    #[error("the document has {bytes} bytes; at most {MAXIMAL_DOCUMENT_BYTES} are read")]
    TooLong {
        /// Its length.
        bytes: usize,
    },
    /// The text is not JSON, or not of the form, or its parts do not fit together.
    #[error("{}", located(path, message))]
    Document {
        /// Where; empty for the document itself.
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
}

impl InputError {
    /// What is wrong at a place.
    pub fn at(path: impl Into<String>, message: impl Into<String>) -> Self {
        Self::Document { path: path.into(), message: message.into() }
    }
}

impl From<DocumentError> for InputError {
    fn from(error: DocumentError) -> Self {
        match error {
            DocumentError::TooLong { bytes } => Self::TooLong { bytes },
            DocumentError::Wrong { path, message } => Self::Document { path, message },
        }
    }
}
