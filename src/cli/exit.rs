//! How the program ends.

use std::io;
use std::process::ExitCode;

use crate::protocol::{CaseError, InputError};
use crate::report::Report;

/// The exit codes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Exit {
    /// All agree.
    Clean = 0,
    /// Some finding.
    Findings = 1,
    /// Usage, input, output.
    Trouble = 2,
    /// Nothing wrong, but something undecided or too long, or nothing judged at all.
    Undecided = 3,
    /// Ctrl-C, as shells count it: 128 and the number of the signal.
    Interrupted = 130,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}

impl Exit {
    pub(super) fn of(report: &Report) -> Self {
        if report.unjudged > 0 && !report.at_first_finding {
            Self::Interrupted
        } else if !report.findings().is_empty() {
            Self::Findings
        } else if report.is_undecided() || report.is_unsupported() {
            Self::Undecided
        } else {
            Self::Clean
        }
    }

    /// The one that says more: an interruption, then trouble, findings, what is undecided.
    pub(super) fn or(self, other: Self) -> Self {
        let order = [Self::Interrupted, Self::Trouble, Self::Findings, Self::Undecided];
        order.into_iter().find(|exit| [self, other].contains(exit)).unwrap_or(Self::Clean)
    }
}

/// Why the program could not do what it was asked for.
#[derive(Debug, thiserror::Error)]
pub(super) enum Trouble {
    #[error("{place}: {source}")]
    Input { place: String, source: io::Error },
    #[error("{place} holds more than {limit} bytes, the most that is read")]
    TooLarge { place: String, limit: usize },
    #[error("{place}: {source}")]
    Case { place: String, source: CaseError },
    #[error("{place}: {source}")]
    Question { place: String, source: InputError },
    #[error("{place}: {message}")]
    Other { place: String, message: String },
    #[error("cannot write: {0}")]
    Output(#[from] io::Error),
}
