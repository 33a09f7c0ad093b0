//! The truth about one case, and how much of it doubles could keep.

use std::collections::BTreeMap;

use super::perturb::Perturbation;
use super::scale::Largest;
use super::{Digits, Scale, digits};
use crate::filter::{Effort, FractionFreeError, Precision, StopReason, filter_fraction_free};
use crate::gaussian::ConditionError;
use crate::model::Path;
use crate::scalar::Rational;
use crate::trace::{Quantity, Values};

/// Significant bits of the truth that digits are counted against: far more than 17 digits need.
const BITS: u32 = 256;

/// The length in bits that exact denominators may reach; what is longer is left undecided.
const MAXIMAL_BITS: u64 = 1 << 18;

const EFFORT: Effort = Effort { precision: Precision::Rounded { bits: BITS }, maximal_bits: Some(MAXIMAL_BITS) };

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
    /// Whether an innovation covariance is singular: moving the data would destroy that.
    pub singular: bool,
    largest: Largest,
}

/// What is attainable where perturbing the data would destroy the structure of the case.
const STRUCTURAL: f64 = 15.0;

impl Reference {
    /// Solves a problem and twenty perturbed ones.
    ///
    /// # Errors
    ///
    /// [`FractionFreeError`] if the exact numbers outgrow 2¹⁸ bits: the truth is then unknown here.
    pub fn of(path: &Path<Rational>) -> Result<Self, FractionFreeError> {
        let (steps, contradiction) = match filter_fraction_free(path, EFFORT) {
            Ok(steps) => (steps, None),
            Err(FractionFreeError { step, reason: StopReason::Condition(reason), computed }) => {
                (computed, Some((step, reason)))
            }
            Err(error) => return Err(error),
        };
        let observed: Vec<Vec<usize>> = path.steps().iter().map(|step| step.reading.present()).collect();
        let rank_deficient = steps.iter().zip(&observed).any(|(step, observed)| step.innovation_rank < observed.len());
        let singular = contradiction.is_some() || rank_deficient;
        let values: Vec<_> = steps.into_iter().map(|step| step.values).collect();
        let seen = observed.iter().map(Vec::as_slice).zip(&values);
        let largest = Largest::of(&path.initial().covariance, path.sensors(), seen);
        let mut reference = Self { values, observed, contradiction, attainable: Vec::new(), singular, largest };
        reference.attainable = reference.unperturbed();
        if !singular {
            reference.perturb(path);
        }
        Ok(reference)
    }

    /// The scale of a quantity at a step; nothing for what is not judged there.
    pub(super) fn scale(&self, step: usize, quantity: Quantity) -> Option<Scale> {
        self.largest.scale(quantity, self.observed.get(step)?, self.values.get(step)?)
    }

    fn unperturbed(&self) -> Vec<BTreeMap<Quantity, Digits>> {
        let start = if self.singular { Digits::new(STRUCTURAL) } else { Digits::EXACT };
        self.values.iter().map(|values| values.keys().map(|&quantity| (quantity, start)).collect()).collect()
    }

    /// Lowers what is attainable to the worst of the perturbed answers.
    fn perturb(&mut self, path: &Path<Rational>) {
        let solve = |seed: u64| -> Vec<Values<Rational>> {
            let steps = filter_fraction_free(&Perturbation::seeded(seed).of(path), Precision::Rounded { bits: BITS });
            steps.unwrap_or_else(|error| error.computed).into_iter().map(|step| step.values).collect()
        };
        let workers = std::thread::available_parallelism().map_or(1, usize::from).min(8);
        let answers: Vec<Vec<Values<Rational>>> = std::thread::scope(|scope| {
            let share = |first: usize| {
                scope.spawn(move || (0..DRAWS).skip(first).step_by(workers).map(solve).collect::<Vec<_>>())
            };
            let shares: Vec<_> = (0..workers).map(share).collect();
            shares
                .into_iter()
                .flat_map(|share| share.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
                .collect()
        });
        for answer in &answers {
            for (step, (values, truth)) in answer.iter().zip(&self.values).enumerate() {
                for (&quantity, matrix) in values {
                    let (Some(scale), Some(exact)) = (self.scale(step, quantity), truth.get(&quantity)) else {
                        continue;
                    };
                    let kept = digits::digits(quantity, matrix, exact, &scale).digits;
                    if let Some(attainable) = self.attainable[step].get_mut(&quantity) {
                        *attainable = attainable.min(kept);
                    }
                }
            }
        }
    }
}
