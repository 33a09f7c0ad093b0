//! What the judge knows about a case.

use super::Reference;
use super::limits::is_too_much;
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
    /// Solves a case exactly, and its perturbations; a case that may take minutes is left unknown.
    pub fn of(case: &Case) -> Self {
        let path = match case.problem().and_then(|problem| problem.realised()) {
            Ok(path) => path,
            Err(why) => return Self::BadInput(why.to_string()),
        };
        if is_too_much(&path) {
            let (states, sensors, steps) = (path.states(), path.sensors(), path.steps().len());
            return Self::Unknown(format!(
                "{steps} steps of {states} states and {sensors} sensors are too many for exact numbers: with long ones they take minutes"
            ));
        }
        match Reference::of_numbers(&path, case.numbers) {
            Ok(reference) => Self::Known(Box::new(reference)),
            Err(why) => Self::Unknown(why.to_string()),
        }
    }
}
