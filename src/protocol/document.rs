//! What reading a case and reading an answer have in common.

use serde::de::{Deserialize, DeserializeOwned, Deserializer};
use serde::ser::Serialize;

use super::InputError;

/// The most bytes a case or an answer may have: 64 MiB.
pub const MAXIMAL_DOCUMENT_BYTES: usize = 64 << 20;

/// Why a text is not a document.
pub(super) enum DocumentError {
    /// It is longer than [`MAXIMAL_DOCUMENT_BYTES`].
    TooLong { bytes: usize },
    /// Something at the path is wrong.
    Wrong { path: String, message: String },
}

/// Reads one document; nothing but white space may follow it.
pub(super) fn parse<T: DeserializeOwned>(text: &str) -> Result<T, DocumentError> {
    if text.len() > MAXIMAL_DOCUMENT_BYTES {
        return Err(DocumentError::TooLong { bytes: text.len() });
    }
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let document = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let path = error.path().to_string();
        // A path of «.» is the document itself.
        DocumentError::Wrong {
            path: if path == "." { String::new() } else { path },
            message: match error.inner() {
                early if early.is_eof() => format!("the text ends too early: {early}"),
                other => other.to_string(),
            },
        }
    })?;
    let rest = |error: serde_json::Error| DocumentError::Wrong { path: String::new(), message: error.to_string() };
    deserializer.end().map_err(rest)?;
    Ok(document)
}

/// Reads one document that is an object: a derived reader would take a list of its parts as well.
pub(super) fn parse_object<T: DeserializeOwned>(text: &str) -> Result<T, InputError> {
    if !text.trim_start().is_empty() && !text.trim_start().starts_with('{') {
        return Err(InputError::at("", "an object is expected"));
    }
    Ok(parse(text)?)
}

/// The document on one line.
pub(super) fn line(document: &impl Serialize) -> String {
    // Only strings and lists are written, to memory: serde_json fails for neither.
    serde_json::to_string(document).unwrap_or_default()
}

/// An optional field: if the key is there, so is the value; `null` is not a way to leave it out.
pub(super) fn present<'de, T: Deserialize<'de>, D: Deserializer<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}

/// `path: message`, or the message alone for the document itself.
pub(super) fn located(path: &str, message: &dyn std::fmt::Display) -> String {
    if path.is_empty() { message.to_string() } else { format!("{path}: {message}") }
}

/// The beginning of a text of unknown length, for messages.
pub(super) fn excerpt(text: &str) -> String {
    const CHARACTERS: usize = 200;
    let mut characters = text.chars();
    let head: String = characters.by_ref().take(CHARACTERS).collect();
    if characters.next().is_some() { format!("{head}…") } else { head }
}
