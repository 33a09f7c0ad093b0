//! What the judge knows about a case.

use super::Reference;
use crate::protocol::Case;

/// What the judge knows about a case.
#[derive(Clone, Debug)]
pub enum Truth {
    /// The exact answer.
    Known(Box<Reference>),
    /// The case is no problem at all, for this reason.
    BadInput(String),
    /// The exact answer costs too much.
    Unknown(String),
}

impl Truth {
    /// Solves a case exactly, and its perturbations.
    pub fn of(case: &Case) -> Self {
        let path = case.problem().and_then(|problem| problem.realised());
        match path.map(|path| Reference::of(&path)) {
            Err(why) => Self::BadInput(why.to_string()),
            Ok(Err(why)) => Self::Unknown(why.to_string()),
            Ok(Ok(reference)) => Self::Known(Box::new(reference)),
        }
    }
}
