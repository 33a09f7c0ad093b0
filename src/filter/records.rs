//! The recursion, one step at a time.

use super::recursion::Recursion;
use crate::gaussian::ConditionError;
use crate::model::{Path, Step};
use crate::scalar::Scalar;
use crate::trace::Record;

/// The records of [`filter`](super::filter()), one observation at a time: nothing but the state is kept.
///
/// It ends with the path, or with the reason why it cannot go on.
#[derive(Debug)]
pub struct Records<'a, S> {
    filter: Recursion<S>,
    steps: std::slice::Iter<'a, Step<S>>,
}

impl<'a, S: Scalar> Records<'a, S> {
    /// The filter before the first step of a path.
    pub fn new(path: &'a Path<S>) -> Self {
        Self { filter: Recursion::new(path), steps: path.steps().iter() }
    }
}

impl<S: Scalar> Iterator for Records<'_, S> {
    type Item = Result<Record<S>, ConditionError<S>>;

    fn next(&mut self) -> Option<Self::Item> {
        let step = self.steps.next()?;
        match self.filter.advance(step) {
            // After it has stopped there is no state, and no record.
            Ok(()) => self.filter.records.pop().map(Ok),
            Err(reason) => Some(Err(reason)),
        }
    }
}
