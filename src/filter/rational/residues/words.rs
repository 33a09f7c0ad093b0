//! The data of a step as machine words, ready to be taken modulo primes.

use num_bigint::BigInt;

use crate::matrix::Fractions;
use crate::modular::{Digits, PrimeField};

use super::super::laws::StepLaws;
use super::super::state::State;

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
pub(super) struct CoefficientWords {
    /// A and the covariance of the noise of the transition into the observed state, if it is still to be made.
    pub(super) transition: Option<(Words, Words)>,
    /// C above the map to the second target, if there is one; that to the first target is the identity.
    pub(super) map: Words,
    /// The covariance of the noise of observed entries and targets.
    pub(super) noise: Words,
}

impl CoefficientWords {
    pub(super) fn of(laws: StepLaws<'_>) -> Self {
        let law = laws.observation;
        let rows = |range: std::ops::Range<usize>| law.map.numerators.block(range, 0..law.states);
        let mut map = rows(0..law.observed);
        for target in 1..law.targets {
            map = map.above(&rows(law.target(target)));
        }
        Self {
            transition: laws.transition.map(|law| (Words::of(&law.map), Words::of(&law.noise))),
            map: Words::of(&Fractions { numerators: map, denominator: law.map.denominator.clone() }),
            noise: Words::of(&law.noise),
        }
    }

    /// The number of words of the longest integer.
    pub(super) fn longest(&self) -> usize {
        let transition = self.transition.iter().flat_map(|(a, q)| [a.longest(), q.longest()]);
        transition.chain([self.map.longest(), self.noise.longest()]).max().unwrap_or(0)
    }
}

/// What changes with every step.
#[derive(Debug)]
pub(super) struct ConstantWords {
    /// What is subtracted in the transition, if that is still to be made.
    pub(super) transition: Option<Words>,
    /// What is subtracted from E x.
    pub(super) observation: Words,
}

impl ConstantWords {
    pub(super) fn of(laws: StepLaws<'_>) -> Self {
        Self {
            transition: laws.transition.map(|law| Words::of(&law.constant)),
            observation: Words::of(&laws.observation.constant),
        }
    }

    /// The number of words of the longest integer.
    pub(super) fn longest(&self) -> usize {
        self.observation.longest().max(self.transition.as_ref().map_or(0, Words::longest))
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

    /// The number of its integers.
    pub(super) fn count(&self) -> usize {
        self.lower.len() + self.mean_numerators.len() + 4
    }
}
