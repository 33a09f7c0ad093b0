//! Enclosures alone, with as many bits as the digits that are wanted take.

use std::iter::Skip;

use super::digits::bits_for;
use super::standing::Standing;
use super::{CertifiedFilter, CertifiedStep};
use crate::model::{Path, PathAhead};
use crate::scalar::Rational;

/// Enclosures decided too little with all the bits that they may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Short {
    /// Whether a covariance is regular.
    #[error(
        "the start is diffuse, the covariance of the innovation singular or too near to it, or repeated sensors contradict each other: enclosures of \
         {bits} bits do not decide"
    )]
    Rank {
        /// The bits that they had.
        bits: u64,
    },
    /// The digits of some number.
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
/// the path, or where the most bits decide too little.
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
    type Item = Result<CertifiedStep, Short>;

    fn next(&mut self) -> Option<Self::Item> {
        while !self.ended && self.done < self.path.steps().len() {
            let short = match self.steps.next() {
                Some(Ok(step)) if step.standing(self.digits) != Standing::Short => {
                    self.done += 1;
                    return Some(Ok(step));
                }
                Some(Ok(_)) => Short::Digits { bits: self.bits },
                // At this step, or at one that was passed over.
                _ => Short::Rank { bits: self.bits },
            };
            if self.bits >= self.most_bits {
                self.ended = true;
                return Some(Err(short));
            }
            self.bits = self.bits.saturating_mul(2).min(self.most_bits);
            self.begin();
        }
        None
    }
}
