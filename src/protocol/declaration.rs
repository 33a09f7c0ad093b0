//! What a subject says of itself.

use serde::{Deserialize, Serialize};

use super::document::{self, present};
use super::{Case, InputError};

/// The most bytes that a declaration may have: 64 KiB.
pub const MAXIMAL_DECLARATION_BYTES: usize = 1 << 16;

/// What every version of the format begins with.
const FORMAT: &str = "exact-kalman/subject/";

/// What a subject says of itself on a line of its own, before its first answer.
///
/// It decides which cases are asked, and never how an answer is judged.
///
/// # Examples
///
/// ```
/// use exact_kalman::protocol::Declaration;
///
/// let line = r#"{"format":"exact-kalman/subject/1","name":"filterpy 1.4.5","unsupported":["diffuse"]}"#;
/// assert!(Declaration::is_meant_by(line));
/// assert_eq!(Declaration::parse(line)?.unsupported, ["diffuse"]);
/// # Ok::<(), exact_kalman::protocol::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Declaration {
    /// The format and its version.
    pub format: DeclarationFormat,
    /// The name under which the answers are shown, beside the command.
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Flags of cases that are not for it.
    #[serde(default)]
    pub unsupported: Vec<String>,
}

/// The format of a declaration, with its version.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum DeclarationFormat {
    /// The only version so far.
    #[default]
    #[serde(rename = "exact-kalman/subject/1")]
    One,
}

impl Declaration {
    /// Whether a line is meant as a declaration, of whatever version: its format says so. No answer has a format.
    pub fn is_meant_by(line: &str) -> bool {
        #[derive(Deserialize)]
        struct OnlyFormat {
            format: String,
        }
        serde_json::from_str(line).is_ok_and(|OnlyFormat { format }| format.starts_with(FORMAT))
    }

    /// Reads a declaration.
    ///
    /// # Errors
    ///
    /// [`InputError`] with the path of what is wrong, or if it has more than [`MAXIMAL_DECLARATION_BYTES`].
    pub fn parse(line: &str) -> Result<Self, InputError> {
        if line.len() > MAXIMAL_DECLARATION_BYTES {
            let message = format!("{} bytes; a declaration has at most {MAXIMAL_DECLARATION_BYTES}", line.len());
            return Err(InputError::at("", message));
        }
        document::parse_object(line)
    }

    /// The first flag of a case that is declared unsupported.
    pub fn unsupported_flag<'a>(&self, case: &'a Case) -> Option<&'a str> {
        case.flags.iter().map(String::as_str).find(|flag| self.unsupported.iter().any(|known| known == flag))
    }
}
