//! The data of a step as machine words, ready to be taken modulo primes.

use num_bigint::BigInt;

use crate::matrix::Fractions;
use crate::model::{Step, Timing};
use crate::modular::{Digits, PrimeField};
use crate::scalar::Rational;

use super::super::law::Law;
use super::super::state::State;
use super::Steps;

/// A matrix over one denominator, row by row.
#[derive(Clone, Debug)]
pub(super) struct Words {
    numerators: Vec<Digits>,
    denominator: Denominator,
}

/// A positive integer by which is divided.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Denominator {
    digits: Digits,
    /// The exponent, for a power of two.
    power_of_two: Option<u64>,
}

impl Denominator {
    fn of(value: &BigInt) -> Self {
        let twos = value.trailing_zeros().filter(|twos| value.bits() == twos + 1);
        Self { digits: value.into(), power_of_two: twos }
    }

    /// The form of its inverse, unless the prime divides it.
    fn inverse(&self, field: &PrimeField, powers: &[u64]) -> Option<u64> {
        match self.power_of_two {
            Some(exponent) => Some(field.power(field.half(), exponent)),
            None => field.inverse(self.digits.form(field, powers)),
        }
    }
}

impl Words {
    fn of(matrix: &Fractions) -> Self {
        Self {
            numerators: matrix.numerators.entries().iter().map(Digits::from).collect(),
            denominator: Denominator::of(&matrix.denominator),
        }
    }

    /// The number of words of its longest integer.
    pub(super) fn longest(&self) -> usize {
        let numerators = self.numerators.iter().map(Digits::len).max().unwrap_or(0);
        numerators.max(self.denominator.digits.len())
    }

    /// Appends the forms of its entries, unless the prime divides the denominator.
    pub(super) fn put_forms(&self, field: &PrimeField, powers: &[u64], forms: &mut Vec<u64>) -> Option<()> {
        let inverse = self.denominator.inverse(field, powers)?;
        forms.extend(self.numerators.iter().map(|digits| field.product(digits.form(field, powers), inverse)));
        Some(())
    }
}

/// What may be the same from step to step.
#[derive(Debug)]
pub(super) struct Coefficients {
    pub(super) law: Law,
    /// The transition into the observed state, if it is still to be made: A and the covariance of its noise.
    pub(super) transition: Option<(Fractions, Fractions)>,
    pub(super) words: CoefficientWords,
}

/// [`Coefficients`] as words.
#[derive(Debug)]
pub(super) struct CoefficientWords {
    pub(super) transition: Option<(Words, Words)>,
    /// C above the map to the second target, if there is one.
    pub(super) map: Words,
    /// The covariance of the noise of observed entries and targets.
    pub(super) noise: Words,
}

impl Coefficients {
    pub(super) fn of(step: &Step<Rational>, timing: Timing, propagate: bool) -> Self {
        let law = Law::of(step, timing);
        let transition = step.transition.as_ref().filter(|_| propagate);
        let transition = transition.map(|t| (Fractions::of(&t.matrix), Fractions::of(&t.noise)));
        // The map to the first target is the identity.
        let rows = |range: std::ops::Range<usize>| law.map.numerators.block(range, 0..law.states);
        let mut map = rows(0..law.observed);
        for target in 1..law.targets {
            map = map.above(&rows(law.target(target)));
        }
        let map = Fractions { numerators: map, denominator: law.map.denominator.clone() };
        let words = CoefficientWords {
            transition: transition.as_ref().map(|(a, q)| (Words::of(a), Words::of(q))),
            map: Words::of(&map),
            noise: Words::of(&law.noise),
        };
        Self { law, transition, words }
    }

    /// Whether they are those of a step, given that they are those of the step before it.
    pub(super) fn serve(&self, steps: Steps<'_>) -> bool {
        let Steps { before: Some(before), step, propagate, .. } = steps else { return false };
        let transitions = match (&before.transition, &step.transition) {
            (Some(a), Some(b)) => (&a.matrix, &a.noise, &a.cross_noise) == (&b.matrix, &b.noise, &b.cross_noise),
            (a, b) => a.is_none() && b.is_none(),
        };
        transitions
            && self.transition.is_some() == (propagate && step.transition.is_some())
            && before.observation == step.observation
            && before.observation_noise == step.observation_noise
            && before.reading.present() == step.reading.present()
    }
}

impl CoefficientWords {
    /// The number of words of the longest integer.
    pub(super) fn longest(&self) -> usize {
        let transition = self.transition.iter().flat_map(|(a, q)| [a.longest(), q.longest()]);
        transition.chain([self.map.longest(), self.noise.longest()]).max().unwrap_or(0)
    }
}

/// What changes with every step.
#[derive(Debug)]
pub(super) struct Constants {
    /// The constant of the law: observed values less inputs, then minus the inputs of the targets.
    pub(super) law: Fractions,
    /// The input of the transition into the observed state, if that is still to be made.
    pub(super) input: Option<Fractions>,
    pub(super) law_words: Words,
    pub(super) input_words: Option<Words>,
}

impl Constants {
    pub(super) fn of(step: &Step<Rational>, timing: Timing, propagate: bool) -> Self {
        let law = Fractions::of(&Law::constant(step, timing));
        let input = step.transition.as_ref().filter(|_| propagate).map(|t| Fractions::of(&t.input));
        let (law_words, input_words) = (Words::of(&law), input.as_ref().map(Words::of));
        Self { law, input, law_words, input_words }
    }

    /// The number of words of the longest integer.
    pub(super) fn longest(&self) -> usize {
        self.law_words.longest().max(self.input_words.as_ref().map_or(0, Words::longest))
    }
}

/// An exact state as words.
#[derive(Debug)]
pub(super) struct StateDigits {
    /// The lower triangle of N, row by row.
    pub(super) lower: Vec<Digits>,
    pub(super) mean_numerators: Vec<Digits>,
    pub(super) scale: Digits,
    pub(super) mean_scale: Digits,
    pub(super) divisor: Digits,
    /// The factor by which the divisors of images exceed the state's.
    pub(super) pending: Digits,
}

impl StateDigits {
    pub(super) fn of(state: &State, pending: &BigInt) -> Self {
        let lower = (0..state.numerators.rows()).flat_map(|i| (0..=i).map(move |j| (i, j)));
        Self {
            lower: lower.map(|place| (&state.numerators[place]).into()).collect(),
            mean_numerators: state.mean_numerators.entries().iter().map(Digits::from).collect(),
            scale: (&state.scale).into(),
            mean_scale: (&state.mean_scale).into(),
            divisor: (&state.divisor).into(),
            pending: pending.into(),
        }
    }

    /// The number of words of the longest integer.
    pub(super) fn longest(&self) -> usize {
        let integers = self.lower.iter().chain(&self.mean_numerators);
        let integers = integers.chain([&self.scale, &self.mean_scale, &self.divisor, &self.pending]);
        integers.map(Digits::len).max().unwrap_or(0)
    }
}
