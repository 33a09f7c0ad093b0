//! What came back from a subject.

use std::fmt;
use std::time::Duration;

use super::super::Answer;

/// What came back for one case.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Reply {
    /// An answer.
    Answer(Answer),
    /// A line that starts like an answer and is none.
    Malformed {
        /// What is wrong, with its path.
        detail: String,
        /// The beginning of the line.
        line: String,
    },
    /// No answer within the time for one case.
    TimedOut {
        /// The time.
        limit: Duration,
    },
    /// The program ended, or closed its output, before it answered.
    Died {
        /// How it ended, in words.
        status: String,
        /// The last 4 KiB that it printed on standard error.
        stderr: String,
    },
    /// More output than allowed for one case.
    Flooded {
        /// The number of bytes allowed.
        limit: usize,
    },
    /// The program could not be started.
    NotStarted {
        /// Why.
        detail: String,
    },
}

impl fmt::Display for Reply {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Answer(answer) => write!(f, "answer to {}", answer.id),
            Self::Malformed { detail, line } => write!(f, "malformed answer: {detail}; the line begins {line:?}"),
            Self::TimedOut { limit } => write!(
                f,
                "no answer within {limit:?}; if it was answered, flush standard output after every line, \
                 or allow more time"
            ),
            Self::Died { status, stderr } if stderr.trim().is_empty() => {
                write!(f, "died before it answered: {status}; nothing on standard error")
            }
            Self::Died { status, stderr } => {
                write!(f, "died before it answered: {status}; standard error ends: {}", stderr.trim_end())
            }
            Self::Flooded { limit } => write!(f, "printed more than {limit} bytes for one case"),
            Self::NotStarted { detail } => f.write_str(detail),
        }
    }
}
