//! What `solve` shows of a case: the values of each step, by name.

use crate::filter::{
    Effort, FilterError, RationalFilterError, RationalStep, StepAhead, filter, filter_rational, predict_ahead,
};
use crate::matrix::Matrix;
use crate::model::{Path, PathAhead};
use crate::scalar::{Precision, Rational};
use crate::trace::{Moments, Quantity, Record, Values};

/// What is shown of a step.
pub(super) struct Shown {
    pub(super) values: Values<Rational>,
    pub(super) more: Vec<(String, Matrix<Rational>)>,
    pub(super) ahead: Vec<Moments<Rational>>,
}

/// Why there is no answer from some step on.
pub(super) struct Stopped {
    pub(super) step: usize,
    pub(super) reason: String,
}

/// The filter, by its fast route.
pub(super) fn solved(path: &Path<Rational>) -> (Vec<Shown>, Option<Stopped>) {
    let show = |step: &RationalStep| Shown {
        values: step.fractions(Precision::Exact).values,
        more: Vec::new(),
        ahead: Vec::new(),
    };
    match filter_rational(path, Effort::default()) {
        Ok(steps) => (steps.iter().map(show).collect(), None),
        Err(RationalFilterError { step, reason, computed }) => {
            (computed.iter().map(show).collect(), Some(Stopped { step, reason: reason.to_string() }))
        }
    }
}

/// The filter, with every named quantity.
pub(super) fn traced(path: &Path<Rational>) -> (Vec<Shown>, Option<Stopped>) {
    let (records, stopped) = match filter(path) {
        Ok(trace) => (trace.records, None),
        Err(error) => (error.computed, Some(Stopped { step: error.step, reason: error.source.to_string() })),
    };
    (records.iter().map(everything).collect(), stopped)
}

/// The predictor, with every named quantity of its records or with those that are shown without being asked for.
pub(super) fn predicted(path: &PathAhead<Rational>, trace: bool) -> (Vec<Shown>, Option<Stopped>) {
    let (computed, stopped) = match predict_ahead(path) {
        Ok(computed) => (computed, None),
        Err(FilterError { step, source, computed }) => (computed, Some(Stopped { step, reason: source.to_string() })),
    };
    let show = |StepAhead { record, ahead }: StepAhead<Rational>| {
        let mut shown = everything(&record);
        if !trace {
            shown.values.remove(&Quantity::Gain);
            shown.more.clear();
        }
        Shown { ahead, ..shown }
    };
    (computed.steps.into_iter().map(show).collect(), stopped)
}

/// The moments of a state i steps ahead, by name; of one that is still diffuse only if everything is asked for.
pub(super) fn named_ahead(i: usize, law: &Moments<Rational>, everything: bool) -> Vec<(String, &Matrix<Rational>)> {
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

/// Every named quantity of a record that is not among its values.
fn everything(record: &Record<Rational>) -> Shown {
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
