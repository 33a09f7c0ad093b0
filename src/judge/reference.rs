//! The truth about one case, and how much of it doubles could keep.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::data_kind::{DataKind, Moved};
use super::likelihood::LogLikelihood;
use super::limits::maximal_bits;
use super::mistakes::Shown;
use super::perturb::Perturbation;
use super::scale::Largest;
use super::{Digits, Scale, digits};
use crate::certify::{TieredFilter, Tiers};
use crate::filter::{RationalFilterError, StepValues, StopReason};
use crate::gaussian::ConditionError;
use crate::model::Path;
use crate::protocol::Numbers;
use crate::scalar::Rational;
use crate::trace::{Quantity, Values};

/// Significant bits of the truth that digits are counted against: far more than 17 digits need.
pub(super) const BITS: u32 = 256;

/// How the truth about a path is found: exactly while numbers are short, then in enclosures of many more digits than are
/// counted; exactly again where these cannot decide.
fn tiers(path: &Path<Rational>) -> Tiers {
    let maximal_bits = Some(maximal_bits(path));
    Tiers { exact_bits: 1 << 14, bits: 512, accuracy: BITS.into(), maximal_bits, ..Tiers::default() }
}

/// How many perturbed problems are solved.
const DRAWS: u64 = 20;

/// The exact answer of a case, and what is attainable.
#[derive(Clone, Debug)]
pub struct Reference {
    /// The exact values, one entry per step up to the end or to the contradiction.
    pub values: Vec<Values<Rational>>,
    /// Which entries were observed, per step.
    pub observed: Vec<Vec<usize>>,
    /// The step whose data have probability zero, with the reason.
    pub contradiction: Option<(usize, ConditionError<Rational>)>,
    /// The digits that a backward-stable method would have kept, per step.
    pub attainable: Vec<BTreeMap<Quantity, Digits>>,
    /// The ranks of the innovation covariances, per step up to the end or to the contradiction.
    pub ranks: Vec<usize>,
    /// Whether moving the data may destroy what the case is about: an innovation covariance is singular, or a diffuse
    /// start would be resolved at another step. Then only perturbations count that do not, and at most 15 digits.
    pub structural: bool,
    /// The problem.
    pub path: Path<Rational>,
    /// Which known mistakes show in answers of one kind; written when it is first asked.
    pub(super) shown: Shown,
    largest: Largest,
}

/// How many bits the numbers of a case have, as the exponent of the relative move of its data.
pub(super) fn moved_bits(numbers: Numbers) -> u32 {
    if numbers == Numbers::Binary32 { 24 } else { DOUBLE }
}

/// The bits of a double.
const DOUBLE: u32 = 53;

/// [`STRUCTURAL`], and as many digits fewer as the numbers are shorter than doubles.
fn structural_digits(bits: u32) -> Digits {
    Digits::new((f64::from(DOUBLE) - f64::from(bits)).mul_add(-std::f64::consts::LOG10_2, STRUCTURAL))
}

/// The most that counts as attainable where perturbing the data may destroy the structure of the case.
const STRUCTURAL: f64 = 15.0;

impl Reference {
    /// Solves a problem and twenty perturbed ones; where none of these keeps the structure of the case, twenty more whose
    /// readings are as they were.
    ///
    /// # Errors
    ///
    /// [`RationalFilterError`] if the exact numbers grow too long for an answer within about a minute: the truth is then
    /// unknown here.
    pub fn of(path: &Path<Rational>) -> Result<Self, RationalFilterError> {
        Self::of_numbers(path, Numbers::Binary64)
    }

    /// The same for data that are numbers of this kind: those of single precision are moved by a relative 2⁻²⁴.
    ///
    /// # Errors
    ///
    /// As for [`of`](Self::of).
    pub fn of_numbers(path: &Path<Rational>, numbers: Numbers) -> Result<Self, RationalFilterError> {
        let (mut steps, mut contradiction) = (Vec::new(), None);
        for step in TieredFilter::new(path, tiers(path)) {
            match step {
                Ok(step) => steps.push(step.fractions(BITS)),
                Err(StopReason::Condition(reason)) => contradiction = Some((steps.len(), reason)),
                Err(reason) => return Err(RationalFilterError { step: steps.len(), reason, computed: Vec::new() }),
            }
        }
        let observed: Vec<Vec<usize>> = path.steps().iter().map(|step| step.reading.present()).collect();
        LogLikelihood::default().insert_into(&mut steps);
        let ranks: Vec<usize> = steps.iter().map(|step| step.innovation_rank).collect();
        let singular = ranks.iter().zip(&observed).any(|(rank, observed)| *rank < observed.len());
        let values: Vec<_> = steps.into_iter().map(|step| step.values).collect();
        let seen = observed.iter().map(Vec::as_slice).zip(&values);
        let largest = Largest::of(&path.initial().covariance, path.sensors(), seen);
        let structural = contradiction.is_some() || singular;
        let mut reference = Self {
            values,
            observed,
            contradiction,
            attainable: Vec::new(),
            ranks,
            structural,
            path: path.clone(),
            shown: Shown::default(),
            largest,
        };
        reference.attainable = reference.attained(path, moved_bits(numbers));
        Ok(reference)
    }

    /// What is left of the answer in the perturbed problems. Where they must not lose the structure of the case, only those
    /// count that have kept it, and never for more than 15 digits.
    fn attained(&mut self, path: &Path<Rational>, bits: u32) -> Vec<BTreeMap<Quantity, Digits>> {
        let mut answers = perturbed_answers(path, Moved::all(bits));
        let all = answers.len();
        answers.retain(|answer| self.is_alike(answer));
        self.structural |= answers.len() < all;
        if !self.structural {
            return self.kept(&answers, Digits::EXACT);
        }
        if answers.is_empty() {
            answers = perturbed_answers(path, Moved::all_but(DataKind::Reading, bits));
            answers.retain(|answer| self.is_alike(answer));
        }
        self.kept(&answers, structural_digits(bits))
    }

    /// The digits that the answers keep where only these data are moved, without a look at structure; nothing if no answer
    /// has kept it.
    pub(super) fn kept_where(&self, path: &Path<Rational>, moved: Moved) -> Option<Vec<BTreeMap<Quantity, Digits>>> {
        let mut answers = perturbed_answers(path, moved);
        answers.retain(|answer| self.is_alike(answer));
        (!answers.is_empty()).then(|| self.kept(&answers, Digits::EXACT))
    }

    /// The scale of a quantity at a step; nothing for what is not judged there.
    pub(super) fn scale(&self, step: usize, quantity: Quantity) -> Option<Scale> {
        self.largest.scale(quantity, self.observed.get(step)?, self.values.get(step)?)
    }

    fn everywhere(&self, digits: Digits) -> Vec<BTreeMap<Quantity, Digits>> {
        self.values.iter().map(|values| values.keys().map(|&quantity| (quantity, digits)).collect()).collect()
    }

    /// Whether an answer has the ranks of the exact one, and values at the same places.
    fn is_alike(&self, answer: &[StepValues]) -> bool {
        let alike = |(step, (values, rank)): (&StepValues, (&Values<Rational>, &usize))| {
            step.innovation_rank == *rank && step.values.keys().eq(values.keys())
        };
        answer.len() == self.values.len() && answer.iter().zip(self.values.iter().zip(&self.ranks)).all(alike)
    }

    /// The fewest digits that any of the answers has kept, and no more than `most`.
    fn kept(&self, answers: &[Vec<StepValues>], most: Digits) -> Vec<BTreeMap<Quantity, Digits>> {
        let mut kept = self.everywhere(most);
        for (step, (kept, truth)) in kept.iter_mut().zip(&self.values).enumerate() {
            for (&quantity, kept) in kept {
                let (Some(scale), Some(exact)) = (self.scale(step, quantity), truth.get(&quantity)) else { continue };
                for theirs in answers.iter().filter_map(|answer| answer.get(step)?.values.get(&quantity)) {
                    *kept = kept.min(digits::digits(quantity, theirs, exact, &scale).digits);
                }
            }
        }
        kept
    }
}

/// The answers to the perturbed problems, computed side by side on the threads of the caller's pool; their order does not
/// depend on that.
fn perturbed_answers(path: &Path<Rational>, moved: Moved) -> Vec<Vec<StepValues>> {
    let likelihood = LogLikelihood::default();
    let solve = |seed: u64| {
        let moved = Perturbation::seeded(seed, moved).of(path);
        let tiers = Tiers { exact_bits: 1 << 11, bits: 256, accuracy: 120, ..tiers(&moved) };
        let solved = TieredFilter::new(&moved, tiers).map_while(Result::ok);
        let mut steps: Vec<_> = solved.map(|step| step.fractions(BITS)).collect();
        likelihood.insert_into(&mut steps);
        steps
    };
    (0..DRAWS).into_par_iter().map(solve).collect()
}
