//! What `solve` shows of a step: its values, by name.

use num_bigint::BigInt;

use super::steps::Step;
use crate::filter::{RationalStep, StepAhead};
use crate::matrix::{Fractions, Matrix};
use crate::scalar::Rational;
use crate::trace::{Moments, Quantity, Record, Values};

/// What is shown of a step, in numbers as they are printed.
pub(super) struct Shown<T> {
    pub(super) values: Values<T>,
    pub(super) more: Vec<(String, Matrix<T>)>,
    pub(super) ahead: Vec<Moments<T>>,
}

impl<T: Clone> Shown<T> {
    /// What is shown of a step; `number` makes what is printed of an integer over a positive one.
    ///
    /// Of the predictor that are the named quantities of its record (`everything`), or those that are shown without being
    /// asked for.
    pub(super) fn of(step: &Step, everything: bool, number: impl Fn(&BigInt, &BigInt) -> T) -> Self {
        match step {
            Step::Fast(step) => Self { values: values(step, number), more: Vec::new(), ahead: Vec::new() },
            Step::Readable(record) => named(record).map(number),
            Step::Ahead(step) => {
                let StepAhead { record, ahead } = &**step;
                let mut shown = named(record);
                if !everything {
                    shown.values.remove(&Quantity::Gain);
                    shown.more.clear();
                }
                Shown { ahead: ahead.clone(), ..shown }.map(number)
            }
        }
    }
}

/// The values of a step of the fast route, each pair of a symmetric matrix made once.
fn values<T: Clone>(step: &RationalStep, number: impl Fn(&BigInt, &BigInt) -> T) -> Values<T> {
    let printed = |(&quantity, fractions): (&Quantity, &Fractions)| {
        let Fractions { numerators, denominator } = fractions;
        let entry = |i: usize, j: usize| number(&numerators[(i, j)], denominator);
        if !quantity.is_covariance() {
            return (quantity, numerators.map(|numerator| number(numerator, denominator)));
        }
        let lower: Vec<Vec<T>> = (0..numerators.rows()).map(|i| (0..=i).map(|j| entry(i, j)).collect()).collect();
        let n = numerators.rows();
        (quantity, Matrix::from_fn(n, n, |i, j| lower[i.max(j)][i.min(j)].clone()))
    };
    step.values.iter().map(printed).collect()
}

impl Shown<Rational> {
    fn map<T>(&self, number: impl Fn(&BigInt, &BigInt) -> T) -> Shown<T> {
        let matrix = |matrix: &Matrix<Rational>| matrix.map(|entry| number(entry.numer(), entry.denom()));
        let moments = |law: &Moments<Rational>| Moments {
            mean: matrix(&law.mean),
            covariance: matrix(&law.covariance),
            diffuse: law.diffuse.as_ref().map(matrix),
        };
        Shown {
            values: self.values.iter().map(|(&quantity, values)| (quantity, matrix(values))).collect(),
            more: self.more.iter().map(|(name, values)| (name.clone(), matrix(values))).collect(),
            ahead: self.ahead.iter().map(moments).collect(),
        }
    }
}

/// The moments of a state i steps ahead, by name; of one that is still diffuse only if everything is asked for.
pub(super) fn named_ahead<T>(i: usize, law: &Moments<T>, everything: bool) -> Vec<(String, &Matrix<T>)> {
    let Moments { mean, covariance, diffuse } = law;
    match diffuse {
        None => vec![(format!("mean {i} ahead"), mean), (format!("covariance {i} ahead"), covariance)],
        Some(diffuse) if everything => vec![
            (format!("mean {i} ahead, its limit"), mean),
            (format!("covariance {i} ahead of order 1"), covariance),
            (format!("covariance {i} ahead of order kappa"), diffuse),
        ],
        Some(_) => Vec::new(),
    }
}

/// Every named quantity of a record: its values, and what is not among them.
fn named(record: &Record<Rational>) -> Shown<Rational> {
    let number = |value: Rational| Matrix::column(vec![value]);
    let mut more = Vec::new();
    let mut add = |name: &str, matrix: Matrix<Rational>| more.push((name.to_owned(), matrix));
    for (name, moments) in [("predicted", &record.predicted), ("filtered", &record.filtered)] {
        if let Some(diffuse) = &moments.diffuse {
            add(&format!("{name} mean, its limit"), moments.mean.clone());
            add(&format!("{name} covariance of order 1"), moments.covariance.clone());
            add(&format!("{name} covariance of order kappa"), diffuse.clone());
        }
    }
    if !record.observed.is_empty() {
        add("predicted observation", record.predicted_observation.clone());
        add("cross covariance", record.cross_covariance.clone());
        if record.predicted.diffuse.is_some() {
            add("gain, its limit", record.gain.clone());
        }
        if let Some(diffuse) = &record.innovation_diffuse {
            add("innovation covariance of order kappa", diffuse.clone());
        }
        add("rank of the innovation covariance", number(Rational::from_integer(record.innovation_rank.into())));
        if let Some(likelihood) = &record.likelihood {
            add("likelihood: quadratic form", number(likelihood.quadratic.clone()));
            add("likelihood: pseudo-determinant", number(likelihood.pseudo_determinant.clone()));
        }
    }
    Shown { values: record.values(), more, ahead: Vec::new() }
}
