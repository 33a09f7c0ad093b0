//! The state of the filter modulo one prime.

use super::words::{CoefficientWords, Constants, StateDigits};
use crate::modular::{Digits, PrimeField};

/// The coefficients of a step in one field.
#[derive(Clone, Debug)]
pub(super) struct CoefficientForms {
    /// A and Q of the transition into the observed state, if it is still to be made.
    transition: Option<(Vec<u64>, Vec<u64>)>,
    map: Vec<u64>,
    noise: Vec<u64>,
}

impl CoefficientForms {
    /// Nothing if the prime divides a denominator.
    pub(super) fn of(words: &CoefficientWords, field: &PrimeField, powers: &[u64]) -> Option<Self> {
        let transition = match &words.transition {
            Some((a, q)) => Some((a.forms(field, powers)?, q.forms(field, powers)?)),
            None => None,
        };
        Some(Self { transition, map: words.map.forms(field, powers)?, noise: words.noise.forms(field, powers)? })
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

    fn size(self) -> usize {
        self.observed + self.targets * self.states
    }
}

/// What a step found modulo one prime.
#[derive(Clone, Debug)]
pub(super) struct Found {
    /// Which of the observed entries have pivots.
    pub(super) pivots: Vec<bool>,
    /// Whether each row without a pivot vanishes, its innovation included.
    pub(super) settled: bool,
    /// d′, then for each target its mean and the lower triangle of its covariance: the integers of the next state,
    /// each times the inverse of the field's cofactor.
    pub(super) parts: Vec<u64>,
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
}

/// What is the same for all primes.
#[derive(Debug)]
pub(super) struct Moment<'a> {
    pub(super) shape: Shape,
    pub(super) constants: &'a Constants,
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
        let covariance = exact.numerators.iter().map(over(inverse)).collect();
        let mean = exact.mean_numerators.iter().map(over(mean_inverse)).collect();
        let divisor = field.product(divisor, form(&exact.pending));
        all.truncate(powers);
        let coefficients = Some(CoefficientForms::of(words, field, &all)?);
        Some(Self { covariance, mean, divisor, coefficients, powers: all })
    }

    /// Takes up other coefficients, or longer data.
    pub(super) fn refresh(&mut self, field: &PrimeField, words: &CoefficientWords, powers: usize) {
        self.powers = field.powers_of_a_word(powers.max(self.powers.len()));
        self.coefficients = CoefficientForms::of(words, field, &self.powers);
    }

    /// The next state, and its integers; nothing if the prime does not suit the data.
    pub(super) fn advance(&mut self, field: &PrimeField, cofactor: u64, moment: &Moment<'_>) -> Option<Found> {
        let Moment { shape, constants, scales: [scale, mean_scale], pending } = moment;
        let coefficients = self.coefficients.take()?;
        if let Some((a, q)) = &coefficients.transition {
            let input = constants.input_words.as_ref()?.forms(field, &self.powers)?;
            self.mean = (a.chunks_exact(shape.states).zip(&input))
                .map(|(row, input)| field.sum(field.inner_product(row, &self.mean), *input))
                .collect();
            self.covariance = congruence(field, a, &self.covariance, q, shape.states);
        }
        let constant = constants.law_words.forms(field, &self.powers)?;
        let mut joint = Joint::of(field, self, &coefficients, &constant, *shape);
        self.coefficients = Some(coefficients);
        let (pivots, settled) = joint.eliminate(*shape);

        let wu = scale.form(field, &self.powers);
        let zu = mean_scale.form(field, &self.powers);
        let inverses =
            field.invert_all([joint.total, joint.product_of_totals, pending.form(field, &self.powers), cofactor])?;
        let [inverse, of_totals, of_pending, of_cofactor] = inverses;
        // The product of the pivots of S, as a rational number: `total / (1 · total₁ · total₂ …)`.
        let determinant = field.product(joint.total, of_totals);
        let rank = pivots.iter().filter(|pivot| **pivot).count() as u64;
        let divisor =
            field.product(field.product(field.product(self.divisor, of_pending), determinant), field.power(wu, rank));
        self.divisor = divisor;
        // What is multiplied by these is no form any more but a residue.
        let unit = field.residue(field.product(divisor, of_cofactor));
        let covariance_unit = field.product(wu, unit);
        let mean_unit = field.product(zu, unit);
        let mut parts = Vec::with_capacity(1 + shape.targets * shape.states * (shape.states + 3) / 2);
        parts.push(unit);
        for target in 0..shape.targets {
            joint.hand_out(target, *shape, inverse, self, |parts_mean, parts_covariance| {
                parts.extend(parts_mean.iter().map(|form| field.product(*form, mean_unit)));
                parts.extend(parts_covariance.iter().map(|form| field.product(*form, covariance_unit)));
            });
        }
        Some(Found { pivots, settled, parts })
    }
}

/// `A P Aᵀ + Q`, P symmetric.
fn congruence(field: &PrimeField, a: &[u64], p: &[u64], q: &[u64], n: usize) -> Vec<u64> {
    let moved: Vec<u64> =
        a.chunks_exact(n).flat_map(|row| p.chunks_exact(n).map(|c| field.inner_product(row, c))).collect();
    let mut result = vec![0; n * n];
    for i in 0..n {
        for j in 0..=i {
            let entry = field.inner_product(&moved[i * n..][..n], &a[j * n..][..n]);
            let entry = field.sum(entry, q[i * n + j]);
            result[i * n + j] = entry;
            result[j * n + i] = entry;
        }
    }
    result
}

/// The joint covariance of observed entries and targets, its lower triangle, and the column `constant − E x`.
struct Joint<'a> {
    field: &'a PrimeField,
    size: usize,
    rows: Vec<u64>,
    column: Vec<u64>,
    /// The product of all pivots as they were met.
    total: u64,
    /// The product of the values of `total` before each pivot.
    product_of_totals: u64,
}

impl<'a> Joint<'a> {
    fn of(
        field: &'a PrimeField,
        image: &Image,
        coefficients: &CoefficientForms,
        constant: &[u64],
        shape: Shape,
    ) -> Self {
        let (n, m, size) = (shape.states, shape.observed, shape.size());
        let CoefficientForms { map, noise, .. } = coefficients;
        let p = &image.covariance;
        // E P, for the rows of C and of the second target.
        let seen: Vec<u64> =
            map.chunks_exact(n).flat_map(|row| p.chunks_exact(n).map(|c| field.inner_product(row, c))).collect();
        // The place in `map` of a row of the joint covariance, if it is none of the first target.
        let place = |row: usize| if row < m { Some(row) } else { row.checked_sub(m + n).map(|row| m + row) };
        let mut rows = vec![0; size * size];
        for i in 0..size {
            for j in 0..=i {
                let entry = match (place(i), place(j)) {
                    (Some(i), Some(j)) => field.inner_product(&seen[i * n..][..n], &map[j * n..][..n]),
                    (None, Some(j)) => seen[j * n + i - m],
                    (None, None) => p[(i - m) * n + j - m],
                    // Between the two targets: not needed.
                    (Some(_), None) => continue,
                };
                rows[i * size + j] = field.sum(entry, noise[i * size + j]);
            }
        }
        let expected = |row: usize| match place(row) {
            Some(place) => field.inner_product(&map[place * n..][..n], &image.mean),
            None => image.mean[row - m],
        };
        let column = (0..size).map(|row| field.difference(constant[row], expected(row))).collect();
        Self { field, size, rows, column, total: field.one(), product_of_totals: field.one() }
    }

    /// Eliminates the observed entries without a division: `a ↦ pivot · a − b c`, so that all is multiplied by each pivot.
    ///
    /// Which of them have pivots, and whether the rows of the others vanish.
    fn eliminate(&mut self, shape: Shape) -> (Vec<bool>, bool) {
        let mut pivots = vec![false; shape.observed];
        let mut settled = true;
        for (row, is_pivot) in pivots.iter_mut().enumerate() {
            let pivot = self.rows[row * self.size + row];
            if pivot == 0 {
                let below = row + 1..self.size;
                settled &= self.column[row] == 0 && below.into_iter().all(|i| self.rows[i * self.size + row] == 0);
            } else {
                *is_pivot = true;
                self.eliminate_row(row, pivot, shape);
                self.product_of_totals = self.field.product(self.product_of_totals, self.total);
                self.total = self.field.product(self.total, pivot);
            }
        }
        (pivots, settled)
    }

    fn eliminate_row(&mut self, row: usize, pivot: u64, shape: Shape) {
        let (field, size) = (self.field, self.size);
        let factors: Vec<u64> = (0..size).map(|i| self.rows[i * size + row]).collect();
        let head = self.column[row];
        for i in row + 1..size {
            let factor = factors[i];
            // A target's row: the observed entries, then its own target's.
            let target =
                i.checked_sub(shape.observed).map(|place| shape.observed + place / shape.states * shape.states);
            let observed = row + 1..=i.min(shape.observed.saturating_sub(1));
            let own = target.map_or(0..0, |first| first..i + 1);
            for j in observed.chain(own) {
                let entry = &mut self.rows[i * size + j];
                *entry = field.minor(pivot, *entry, factor, factors[j]);
            }
            self.column[i] = field.minor(pivot, self.column[i], factor, head);
        }
    }

    /// Mean and lower triangle of a target's covariance, which become the image's if it is the last one.
    fn hand_out(
        &self,
        target: usize,
        shape: Shape,
        inverse: u64,
        image: &mut Image,
        mut take: impl FnMut(&[u64], &[u64]),
    ) {
        let (n, first) = (shape.states, shape.observed + target * shape.states);
        let minus = self.field.negative(inverse);
        let mean: Vec<u64> =
            self.column[first..first + n].iter().map(|form| self.field.product(*form, minus)).collect();
        let lower = (0..n).flat_map(|i| (0..=i).map(move |j| (first + i) * self.size + first + j));
        let lower: Vec<u64> = lower.map(|place| self.field.product(self.rows[place], inverse)).collect();
        take(&mean, &lower);
        if target + 1 == shape.targets {
            let place = |i: usize, j: usize| i * (i + 1) / 2 + j;
            image.covariance = (0..n * n).map(|at| lower[place((at / n).max(at % n), (at / n).min(at % n))]).collect();
            image.mean = mean;
        }
    }
}
