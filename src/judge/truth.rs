//! What the judge knows about a case.

use super::Reference;
use crate::model::Path;
use crate::protocol::Case;
use crate::scalar::Rational;

/// The largest work, steps times the third power of states and sensors, that is begun at all: about a
/// minute where nothing is simple.
const MAXIMAL_WORK: u64 = 1 << 18;

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
    /// Solves a case exactly, and its perturbations; a case that would take many minutes is left unknown.
    pub fn of(case: &Case) -> Self {
        let path = match case.problem().and_then(|problem| problem.realised()) {
            Ok(path) => path,
            Err(why) => return Self::BadInput(why.to_string()),
        };
        if work(&path) > MAXIMAL_WORK {
            let (states, sensors, steps) = (path.states(), path.sensors(), path.steps().len());
            return Self::Unknown(format!(
                "{steps} steps of {states} states and {sensors} sensors are too many for exact numbers: they would take many minutes"
            ));
        }
        match Reference::of(&path) {
            Ok(reference) => Self::Known(Box::new(reference)),
            Err(why) => Self::Unknown(why.to_string()),
        }
    }
}

/// The work of a path: its steps times the third power of its states and sensors.
fn work(path: &Path<Rational>) -> u64 {
    let size = |count: usize| u64::try_from(count).unwrap_or(u64::MAX);
    size(path.states() + path.sensors()).saturating_pow(3).saturating_mul(size(path.steps().len()))
}
