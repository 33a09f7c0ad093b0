//! Enclosures alone, with as many bits as the digits that are wanted take.

use std::iter::Skip;

use super::digits::bits_for;
use super::standing::Standing;
use super::{CertifiedFilter, CertifiedStep, NotEnclosed};
use crate::gaussian::Inconsistent;
use crate::model::{Path, PathAhead};
use crate::scalar::Rational;

/// Why enclosures go no further.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Halt {
    /// Sensors that repeat others say something else.
    #[error("{}", NotEnclosed::Contradiction(.0.clone()))]
    Contradiction(Inconsistent<Rational>),
    /// With all the bits that they may have they do not decide whether a covariance is regular.
    #[error(
        "the start is diffuse, or the covariance of the innovation singular or too near to it: enclosures of {bits} bits do not decide"
    )]
    Rank {
        /// The bits that they had.
        bits: u64,
    },
    /// Nor the digits of some number.
    #[error("enclosures of {bits} bits do not prove the digits that are wanted")]
    Digits {
        /// The bits that they had.
        bits: u64,
    },
}

/// The enclosed filter along a path, whose bits are doubled until so many digits of each entry are proved, or an entry is known
/// to many more and may be zero or a tie all the same.
///
/// When bits are raised the run begins anew, and passes over the steps that were handed out; nothing else is kept. It ends with
/// the path, where the most bits decide too little, or where sensors contradict each other.
#[derive(Debug)]
pub struct RaisedFilter<'a> {
    path: &'a Path<Rational>,
    ahead: Option<&'a PathAhead<Rational>>,
    everything: bool,
    digits: u32,
    bits: u64,
    most_bits: u64,
    steps: Skip<CertifiedFilter<'a>>,
    done: usize,
    ended: bool,
}

impl<'a> RaisedFilter<'a> {
    /// The filter before the first step of a path, for so many digits.
    pub fn new(path: &'a Path<Rational>, digits: u32, most_bits: u64) -> Self {
        let bits = bits_for(digits).min(most_bits);
        let done = 0;
        let steps = CertifiedFilter::new(path, bits).skip(done);
        Self { path, ahead: None, everything: false, digits, bits, most_bits, steps, done, ended: false }
    }

    /// The same filter with everything that [`CertifiedFilter::everything`] adds.
    #[must_use]
    pub fn everything(self) -> Self {
        Self { everything: true, ..self }.begun()
    }

    /// The same filter along the path of a predictor.
    #[must_use]
    pub fn ahead(self, path: &'a PathAhead<Rational>) -> Self {
        Self { ahead: Some(path), ..self }.begun()
    }

    /// The bits of the enclosures.
    pub fn bits(&self) -> u64 {
        self.bits
    }

    /// Begins anew, with the steps passed over that were handed out.
    fn begun(mut self) -> Self {
        self.begin();
        self
    }

    fn begin(&mut self) {
        let filter = CertifiedFilter::new(self.path, self.bits);
        let filter = if self.everything { filter.everything() } else { filter };
        let filter = match self.ahead {
            Some(path) => filter.ahead(path),
            None => filter,
        };
        self.steps = filter.skip(self.done);
    }
}

impl Iterator for RaisedFilter<'_> {
    type Item = Result<CertifiedStep, Halt>;

    fn next(&mut self) -> Option<Self::Item> {
        while !self.ended && self.done < self.path.steps().len() {
            let halt = match self.steps.next() {
                Some(Ok(step)) if step.standing(self.digits) != Standing::Short => {
                    self.done += 1;
                    return Some(Ok(step));
                }
                Some(Ok(_)) => Halt::Digits { bits: self.bits },
                Some(Err(NotEnclosed::Contradiction(proof))) => {
                    self.ended = true;
                    return Some(Err(Halt::Contradiction(proof)));
                }
                // At this step, or at one that was passed over.
                _ => Halt::Rank { bits: self.bits },
            };
            if self.bits >= self.most_bits {
                self.ended = true;
                return Some(Err(halt));
            }
            self.bits = self.bits.saturating_mul(2).min(self.most_bits);
            self.begin();
        }
        None
    }
}
