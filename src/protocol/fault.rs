//! An error on its way up from an entry, gathering indices.

use super::{CaseError, NumberError};
use crate::matrix::RaggedRows;

/// What is wrong below some field, and the indices that lead there, innermost first.
pub(super) struct Fault {
    indices: Vec<usize>,
    kind: FaultKind,
}

pub(super) enum FaultKind {
    Number(NumberError),
    Ragged(RaggedRows),
}

impl Fault {
    pub(super) fn number(error: NumberError) -> Self {
        Self { indices: Vec::new(), kind: FaultKind::Number(error) }
    }

    pub(super) fn ragged(error: RaggedRows) -> Self {
        Self { indices: Vec::new(), kind: FaultKind::Ragged(error) }
    }

    /// The path below the field `name`, and what is wrong there.
    pub(super) fn located(self, name: &str) -> (String, FaultKind) {
        let path = self.indices.iter().rev().fold(name.to_owned(), |path, index| format!("{path}[{index}]"));
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
            fault.indices.push(index);
            fault
        })
    };
    items.iter().enumerate().map(item).collect()
}
