//! An error on its way up from an entry, gathering the way to it.

use super::{CaseError, NumberError};
use crate::matrix::RaggedRows;

/// What is wrong below some field, and the indices and names that lead there, innermost first.
pub(super) struct Fault {
    way: Vec<String>,
    kind: FaultKind,
}

pub(super) enum FaultKind {
    Number(NumberError),
    Ragged(RaggedRows),
}

impl Fault {
    pub(super) fn number(error: NumberError) -> Self {
        Self { way: Vec::new(), kind: FaultKind::Number(error) }
    }

    pub(super) fn ragged(error: RaggedRows) -> Self {
        Self { way: Vec::new(), kind: FaultKind::Ragged(error) }
    }

    /// The fault as that of the part `name` of an object.
    pub(super) fn in_part(mut self, name: &str) -> Self {
        self.way.push(format!(".{name}"));
        self
    }

    /// The path below the field `name`, and what is wrong there.
    pub(super) fn located(self, name: &str) -> (String, FaultKind) {
        let path = self.way.iter().rev().fold(name.to_owned(), |path, part| path + part);
        (path, self.kind)
    }

    /// The error of a case whose field `name` has this fault.
    pub(super) fn in_field(self, name: &str) -> CaseError {
        match self.located(name) {
            (path, FaultKind::Number(source)) => CaseError::Number { path, source },
            (path, FaultKind::Ragged(source)) => CaseError::Ragged { path, source },
        }
    }
}

/// The images of all items, or the first fault with the index of its item.
pub(super) fn indexed<T, U>(items: &[T], image: impl Fn(&T) -> Result<U, Fault>) -> Result<Vec<U>, Fault> {
    let item = |(index, item)| {
        image(item).map_err(|mut fault| {
            fault.way.push(format!("[{index}]"));
            fault
        })
    };
    items.iter().enumerate().map(item).collect()
}
