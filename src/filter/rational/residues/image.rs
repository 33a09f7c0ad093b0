//! The state of the filter modulo one prime.

use super::joint::{Elimination, Joint};
use super::words::{CoefficientWords, ConstantWords, StateDigits, Words};
use crate::modular::{Digits, PrimeField};

/// The coefficients of a step in one field.
#[derive(Clone, Debug)]
pub(super) struct CoefficientForms {
    /// A and Q of the transition into the observed state, if it is still to be made.
    pub(super) transition: Option<(Vec<u64>, Vec<u64>)>,
    pub(super) map: Vec<u64>,
    pub(super) noise: Vec<u64>,
}

impl CoefficientForms {
    /// Nothing if the prime divides a denominator.
    pub(super) fn of(words: &CoefficientWords, field: &PrimeField, powers: &[u64]) -> Option<Self> {
        let forms = |words: &Words| {
            let mut forms = Vec::new();
            words.put_forms(field, powers, &mut forms).map(|()| forms)
        };
        let transition = match &words.transition {
            Some((a, q)) => Some((forms(a)?, forms(q)?)),
            None => None,
        };
        Some(Self { transition, map: forms(&words.map)?, noise: forms(&words.noise)? })
    }
}

/// The sizes of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// n
    pub(super) states: usize,
    /// The number of observed entries.
    pub(super) observed: usize,
    /// 1, or 2 where the transition departs from k.
    pub(super) targets: usize,
}

impl Shape {
    /// About so many products of words make a step.
    pub(super) fn work(self) -> usize {
        (self.states * self.states + 1) * self.size() * 2
    }

    pub(super) fn size(self) -> usize {
        self.observed + self.targets * self.states
    }
}

/// The covariance and the mean of the state modulo one prime, with what its cached coefficients are.
#[derive(Clone, Debug)]
pub(super) struct Image {
    /// n×n, both triangles.
    covariance: Vec<u64>,
    mean: Vec<u64>,
    /// d of the exact state, times [`Moment::pending`].
    divisor: u64,
    /// Nothing if the prime divides one of their denominators.
    coefficients: Option<CoefficientForms>,
    /// Powers of a word, enough for the data.
    pub(super) powers: Vec<u64>,
    /// What the last step found.
    found: Found,
}

/// What a step found modulo one prime.
#[derive(Clone, Debug, Default)]
struct Found {
    pivots: Vec<bool>,
    settled: bool,
    parts: Vec<u64>,
}

/// What is the same for all primes.
#[derive(Debug)]
pub(super) struct Moment<'a> {
    pub(super) shape: Shape,
    pub(super) constants: &'a ConstantWords,
    /// w u and z uₓ: the scales of the covariances and of the means of this step.
    pub(super) scales: &'a [Digits; 2],
    /// The factor by which the divisors of the images exceed the exact one.
    pub(super) pending: &'a Digits,
}

impl Image {
    /// The image of an exact state; nothing if the prime divides one of its denominators.
    pub(super) fn of(
        exact: &StateDigits,
        words: &CoefficientWords,
        field: &PrimeField,
        longest: usize,
        powers: usize,
    ) -> Option<Self> {
        let mut all = field.powers_of_a_word(longest);
        let form = |digits: &Digits| digits.form(field, &all);
        let divisor = form(&exact.divisor);
        let [inverse, mean_inverse] = field.invert_all([
            field.product(form(&exact.scale), divisor),
            field.product(form(&exact.mean_scale), divisor),
        ])?;
        let over = |inverse: u64| move |digits: &Digits| field.product(form(digits), inverse);
        let lower: Vec<u64> = exact.lower.iter().map(over(inverse)).collect();
        let n = exact.mean_numerators.len();
        let place = |i: usize, j: usize| i * (i + 1) / 2 + j;
        let covariance = (0..n * n).map(|at| (at / n, at % n)).map(|(i, j)| lower[place(i.max(j), i.min(j))]).collect();
        let mean = exact.mean_numerators.iter().map(over(mean_inverse)).collect();
        let divisor = field.product(divisor, form(&exact.pending));
        all.truncate(powers);
        let coefficients = Some(CoefficientForms::of(words, field, &all)?);
        Some(Self { covariance, mean, divisor, coefficients, powers: all, found: Found::default() })
    }

    /// Takes up other coefficients, or longer data.
    pub(super) fn refresh(&mut self, field: &PrimeField, words: &CoefficientWords, powers: usize) {
        self.powers = field.powers_of_a_word(powers.max(self.powers.len()));
        self.coefficients = CoefficientForms::of(words, field, &self.powers);
    }

    /// The next state, and its integers; nothing if the prime does not suit the data.
    pub(super) fn advance(
        &mut self,
        field: &PrimeField,
        cofactor: u64,
        moment: &Moment<'_>,
        joint: &mut Joint,
    ) -> Option<()> {
        let Moment { shape, constants, scales: [scale, mean_scale], pending } = moment;
        let coefficients = self.coefficients.as_ref()?;
        if let Some((a, q)) = &coefficients.transition {
            constants.transition.as_ref()?.put_forms(field, &self.powers, joint.constant())?;
            joint.propagate(field, a, q, &mut self.covariance, &mut self.mean);
        }
        constants.observation.put_forms(field, &self.powers, joint.constant())?;
        joint.assemble(field, coefficients, &self.covariance, &self.mean, *shape);
        let Elimination { settled, total, product_of_totals } = joint.eliminate(field, *shape, &mut self.found.pivots);
        self.found.settled = settled;

        let wu = scale.form(field, &self.powers);
        let zu = mean_scale.form(field, &self.powers);
        let inverses = [total, product_of_totals, pending.form(field, &self.powers), cofactor];
        let [inverse, of_totals, of_pending, of_cofactor] = field.invert_all(inverses)?;
        // The product of the pivots of S, as a rational number: `total / (1 · total₁ · total₂ …)`.
        let determinant = field.product(total, of_totals);
        let rank = self.rank() as u64;
        let divisor = field.product(self.divisor, of_pending);
        self.divisor = field.product(field.product(divisor, determinant), field.power(wu, rank));
        // What is multiplied by these is no form any more but a residue.
        let unit = field.residue(field.product(self.divisor, of_cofactor));
        let covariance_unit = field.product(wu, unit);
        let mean_unit = field.product(zu, unit);
        let parts = &mut self.found.parts;
        parts.clear();
        parts.push(unit);
        for target in 0..shape.targets {
            joint.hand_out(field, target, *shape, inverse, &mut self.covariance, &mut self.mean);
            parts.extend(self.mean.iter().map(|form| field.product(*form, mean_unit)));
            let lower = self.covariance.chunks_exact(shape.states).enumerate().flat_map(|(i, row)| &row[..=i]);
            parts.extend(lower.map(|form| field.product(*form, covariance_unit)));
        }
        Some(())
    }

    /// Which of the observed entries had pivots in the last step.
    pub(super) fn pivots(&self) -> &[bool] {
        &self.found.pivots
    }

    /// The rank of the innovation covariance of the last step.
    pub(super) fn rank(&self) -> usize {
        self.found.pivots.iter().filter(|pivot| **pivot).count()
    }

    /// Whether each row without a pivot vanished in the last step, its innovation included.
    pub(super) fn is_settled(&self) -> bool {
        self.found.settled
    }

    /// d′, then for each target its mean and the lower triangle of its covariance: the integers of the next state,
    /// each times the inverse of the field's cofactor.
    pub(super) fn parts(&self) -> &[u64] {
        &self.found.parts
    }
}
