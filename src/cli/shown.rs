//! What `solve` shows of a step: its values, by name.

use super::notation::Notation;
use super::steps::ExactStep;
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

impl<T> Shown<T> {
    /// What is shown of a step.
    ///
    /// Of the predictor that are the named quantities of its record (`everything`), or those that are shown without being
    /// asked for.
    pub(super) fn of(step: &ExactStep, everything: bool, notation: &impl Notation<Number = T>) -> Self {
        match step {
            ExactStep::Fast(RationalStep { values, .. }) => {
                let written = |(&quantity, fractions): (&Quantity, &Fractions)| {
                    (quantity, notation.matrix(fractions, quantity.is_covariance()))
                };
                Self { values: values.iter().map(written).collect(), more: Vec::new(), ahead: Vec::new() }
            }
            ExactStep::Readable(record) => named(record).written(notation),
            ExactStep::Ahead(step) => {
                let StepAhead { record, ahead } = &**step;
                let mut shown = named(record);
                if !everything {
                    shown.values.remove(&Quantity::Gain);
                    shown.more.clear();
                }
                Shown { ahead: ahead.clone(), ..shown }.written(notation)
            }
        }
    }
}

impl Shown<Rational> {
    fn written<N: Notation>(&self, notation: &N) -> Shown<N::Number> {
        let matrix = |matrix: &Matrix<Rational>| matrix.map(|entry| notation.fraction(entry));
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
