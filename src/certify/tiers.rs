//! Exact while that is cheap or needed, enclosed from then on.

use std::iter::Skip;

use super::filter::CertifiedStep;
use super::standing::Standing;
use super::{CertifiedFilter, NotEnclosed};
use crate::filter::{Effort, RationalFilter, RationalStep, StepValues, StopReason};
use crate::gaussian::{ConditionError, Inconsistent};
use crate::matrix::{Fractions, Matrix};
use crate::model::{Path, Timing};
use crate::scalar::{Precision, Rational};
use crate::trace::Quantity;

/// How far exact numbers go, and how many bits enclosures have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tiers {
    /// Denominators up to so many bits are carried exactly; enclosures begin beyond.
    pub exact_bits: u64,
    /// The bits with which enclosures begin.
    pub bits: u64,
    /// The bits beyond which they are not raised: exact numbers go on instead.
    pub most_bits: u64,
    /// How accurate enclosures must be, in bits: see [`CertifiedStep::accuracy`].
    pub accuracy: u64,
    /// The most bits of denominators where nothing but exact numbers decides.
    pub maximal_bits: Option<u64>,
}

impl Default for Tiers {
    /// Exact up to 2¹¹ bits; enclosures with 192 bits, raised up to 2¹² bits, to 30 digits; no limit where nothing else
    /// decides.
    fn default() -> Self {
        Self { exact_bits: 1 << 11, bits: 192, most_bits: 1 << 12, accuracy: 100, maximal_bits: None }
    }
}

/// One step of either tier.
#[derive(Clone, Debug)]
pub enum TieredStep {
    /// The exact results.
    Exact(RationalStep),
    /// Enclosures of them, with the exact rank of the innovation covariance.
    Certified(Box<CertifiedStep>),
}

/// The filter along a path: exact as long as denominators are short, a start is diffuse, or an innovation covariance is
/// singular; enclosed elsewhere. The bits of enclosures are doubled where they decide nothing.
#[derive(Debug)]
pub struct TieredFilter<'a> {
    path: &'a Path<Rational>,
    tiers: Tiers,
    exact: RationalFilter<'a>,
    /// The steps that the exact filter has done.
    exact_steps: usize,
    /// What it handed on last, and before which step.
    begin: Option<(usize, Belief)>,
    certified: Option<Skip<CertifiedFilter<'a>>>,
    bits: u64,
    done: usize,
    /// Exact steps before enclosures are tried again, where they decided nothing; more each time.
    patience: usize,
    /// The steps before which they are not.
    patient_until: usize,
    /// After an error there is nothing more.
    ended: bool,
    /// How it is found whether an enclosed step can be printed, with so many digits.
    digits: Option<(Proof, u32)>,
}

/// Beyond this power of two, up or down, no double lies by far, and fractions take too much memory.
const FARTHEST: u64 = 1 << 14;

type Proof = fn(&CertifiedStep, u32) -> Standing;

type Belief = (Matrix<Rational>, Matrix<Rational>);

impl<'a> TieredFilter<'a> {
    /// The filter before the first step of a path.
    pub fn new(path: &'a Path<Rational>, tiers: Tiers) -> Self {
        let effort = Effort { maximal_bits: tiers.maximal_bits, ..Effort::default() };
        Self {
            path,
            tiers,
            exact: RationalFilter::new(path, effort),
            exact_steps: 0,
            begin: None,
            certified: None,
            bits: tiers.bits,
            done: 0,
            patience: 1,
            patient_until: 0,
            ended: false,
            digits: None,
        }
    }

    /// The filter for numbers that are printed: steps are enclosed where so many decimal digits of every entry are proved, else
    /// exact. Its numbers are of any size.
    #[cfg(feature = "judge")]
    pub fn to_digits(path: &'a Path<Rational>, digits: u32, most_bits: u64, maximal_bits: Option<u64>) -> Self {
        let bits = super::digits::bits_for(digits).min(most_bits);
        let exact_bits = (4 * bits).max(Tiers::default().exact_bits);
        let tiers = Tiers { exact_bits, bits, most_bits, accuracy: 0, maximal_bits };
        Self { digits: Some((CertifiedStep::standing, digits)), ..Self::new(path, tiers) }
    }

    /// The length of the numbers of the last step: denominators, or the bits of enclosures.
    pub fn bits(&self) -> u64 {
        if self.certified.is_some() { self.bits } else { self.exact.bits() }
    }

    /// The next step by exact numbers, those of the steps that were enclosed made up for; what it hands on begins the next
    /// enclosures once denominators are long.
    fn exactly(&mut self) -> Option<Result<TieredStep, StopReason>> {
        let mut last = None;
        while self.exact_steps <= self.done {
            match self.exact.next()? {
                Ok(step) => last = Some(step),
                Err(reason) => return Some(Err(reason)),
            }
            self.exact_steps += 1;
        }
        let step = last?;
        if let Some(bits) = magnitude(&step).filter(|bits| *bits > FARTHEST && self.digits.is_none()) {
            return Some(Err(StopReason::TooLong { bits, limit: FARTHEST }));
        }
        if self.exact.bits() > self.tiers.exact_bits && self.done + 1 >= self.patient_until {
            // What departs from this step shows in the next one: that is done twice.
            let before = if self.path.timing() == Timing::Departing { self.done } else { self.done + 1 };
            let names = match self.path.timing() {
                Timing::Arriving => [Quantity::FilteredMean, Quantity::FilteredCovariance],
                Timing::Departing => [Quantity::PredictedMean, Quantity::PredictedCovariance],
            };
            let [mean, covariance] = names.map(|name| step.exactly(name));
            if let (Some(mean), Some(covariance)) = (mean, covariance) {
                self.begin = Some((before, (mean, covariance)));
                self.bits = self.tiers.bits;
                self.enclose(self.done + 1);
            }
        }
        self.done += 1;
        Some(Ok(TieredStep::Exact(step)))
    }

    /// Enclosures from where they began, with the steps before the wanted one passed over.
    fn enclose(&mut self, wanted: usize) {
        self.certified = self.begin.as_ref().map(|(before, (mean, covariance))| {
            CertifiedFilter::resumed(self.path, *before, (mean, covariance), self.bits).skip(wanted - before)
        });
    }
}

impl Iterator for TieredFilter<'_> {
    type Item = Result<TieredStep, StopReason>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let next = self.advance();
        self.ended = !matches!(next, Some(Ok(_)));
        next
    }
}

/// What came of an enclosed step.
enum Found {
    Enough(Box<CertifiedStep>),
    /// Undecided at this step, or at one that was passed over, or not accurate.
    Short,
    /// More bits would not help: it takes exact numbers.
    Tied,
    /// Numbers as far from one as this power of two.
    TooFar(u64),
    /// Sensors that repeat others say something else.
    Contradiction(Inconsistent<Rational>),
}

impl TieredFilter<'_> {
    fn found(&self, next: Option<Result<CertifiedStep, NotEnclosed>>) -> Found {
        let step = match next {
            Some(Ok(step)) => step,
            Some(Err(NotEnclosed::Contradiction(proof))) => return Found::Contradiction(proof),
            Some(Err(NotEnclosed::Undecided(_))) | None => return Found::Short,
        };
        if step.accuracy().is_some_and(|bits| bits < self.tiers.accuracy) {
            return Found::Short;
        }
        if let Some(bits) = step.magnitude().filter(|bits| *bits > FARTHEST) {
            return Found::TooFar(bits);
        }
        match self.digits.map(|(standing, digits)| standing(&step, digits)) {
            None | Some(Standing::Proved) => Found::Enough(Box::new(step)),
            Some(Standing::Short) => Found::Short,
            Some(Standing::Tied) => Found::Tied,
        }
    }

    fn advance(&mut self) -> Option<Result<TieredStep, StopReason>> {
        while let Some(certified) = &mut self.certified {
            let next = certified.next();
            if next.is_none() && self.done == self.path.steps().len() {
                return None;
            }
            match self.found(next) {
                Found::Enough(step) => {
                    self.done += 1;
                    return Some(Ok(TieredStep::Certified(step)));
                }
                Found::TooFar(bits) if self.digits.is_none() => {
                    return Some(Err(StopReason::TooLong { bits, limit: FARTHEST }));
                }
                Found::Contradiction(proof) => {
                    return Some(Err(StopReason::Condition(ConditionError::Inconsistent(proof))));
                }
                Found::Short if self.bits < self.tiers.most_bits => {
                    self.bits = (2 * self.bits).min(self.tiers.most_bits);
                    self.enclose(self.done);
                }
                _ => {
                    self.certified = None;
                    self.patient_until = self.done + self.patience;
                    self.patience = self.patience.saturating_mul(2);
                }
            }
        }
        self.exactly()
    }
}

/// The largest power of two, up or down, of an entry that is not zero.
fn magnitude(step: &RationalStep) -> Option<u64> {
    let of = |fractions: &Fractions| {
        let under = fractions.denominator.bits();
        let sizes = fractions.numerators.entries().iter().filter(|entry| entry.bits() > 0);
        sizes.map(|entry| entry.bits().abs_diff(under)).max()
    };
    step.values.values().filter_map(of).max()
}

impl TieredStep {
    /// The results as fractions of so many bits: rounded, or the middles of what encloses them.
    pub fn fractions(&self, bits: u32) -> StepValues {
        match self {
            Self::Exact(step) => step.fractions(Precision::Rounded { bits }),
            Self::Certified(step) => step.middles(bits.into()),
        }
    }
}
