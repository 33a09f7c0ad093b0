//! Programs that make mistakes, and the truths to hold them against.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use exact_kalman::judge::{Diagnosis, Judgement, Truth, suite};
use exact_kalman::matrix::Matrix;
use exact_kalman::protocol::{Answer, Case, Expect, Number, Outcome, Reply};
use exact_kalman::scalar::exact_value;
use exact_kalman::trace::{Quantity, Values};
use rayon::prelude::*;

use super::filter::{Filter, Said};
use super::model::{M, Model};

/// The cases on which mistakes are shown, with their truths: the smallest of each category that are an estimate.
pub(crate) static TRUTHS: LazyLock<Vec<(Case, Truth)>> = LazyLock::new(|| {
    let mut categories: BTreeMap<String, Vec<Case>> = BTreeMap::new();
    for case in suite().into_iter().filter(|case| case.expect == Expect::Estimate && size(case) <= LARGEST) {
        categories.entry(case.id.split('/').next().unwrap_or_default().to_owned()).or_default().push(case);
    }
    let mut cases: Vec<(usize, Case)> = Vec::new();
    for mut category in categories.into_values() {
        category.sort_by_key(size);
        cases.extend(category.into_iter().enumerate());
    }
    // The smallest of each category, then the second ones, and so on.
    cases.sort_by_key(|(rank, _)| *rank);
    let cases: Vec<Case> = cases.into_iter().take(CASES).map(|(_, case)| case).collect();
    cases.into_par_iter().map(|case| (case.clone(), Truth::of(&case))).collect()
});

/// Each subject is asked all of them, so they are to be few …
const CASES: usize = 44;

/// … and small: in steps times the square of states and sensors.
const LARGEST: usize = 360;

fn size(case: &Case) -> usize {
    let sensors = case.observations.iter().flatten().map(Vec::len).max().unwrap_or(1);
    case.observations.len() * (case.initial.mean.len() + sensors).pow(2)
}

/// The numbers of an answer, before it is written down.
pub(crate) type Steps = Vec<Values<f64>>;

fn matrix(m: &M) -> Matrix<f64> {
    Matrix::from_fn(m.nrows(), m.ncols(), |i, j| m[(i, j)])
}

fn values(said: &Said) -> Values<f64> {
    let mut values = Values::new();
    values.insert(Quantity::PredictedMean, matrix(&said.predicted.0));
    values.insert(Quantity::PredictedCovariance, matrix(&said.predicted.1));
    values.insert(Quantity::FilteredMean, matrix(&said.filtered.0));
    values.insert(Quantity::FilteredCovariance, matrix(&said.filtered.1));
    if let Some((innovation, covariance)) = &said.innovation {
        values.insert(Quantity::Innovation, matrix(innovation));
        values.insert(Quantity::InnovationCovariance, matrix(covariance));
    }
    values
}

/// What a filter of the tests answers to a case; nothing if it does not know such models.
pub(crate) fn steps(filter: &Filter<'_>, case: &Case) -> Option<Steps> {
    steps_of(filter, Model::of(case))
}

/// What it answers without a habit.
pub(crate) fn right_steps(case: &Case) -> Option<Steps> {
    steps(&Filter { habit: "", way: 0.0 }, case)
}

/// What it answers along a model.
#[expect(clippy::needless_pass_by_value, reason = "made to be asked once")]
pub(crate) fn steps_of(filter: &Filter<'_>, model: Model) -> Option<Steps> {
    let knows_diffuse = ["large-number-for-diffuse", "diffuse-part-ignored"].contains(&filter.habit);
    if model.diffuse.is_some() && !knows_diffuse {
        return None;
    }
    if model.shares_noise() && super::LINES.contains(&filter.habit) {
        return None;
    }
    let said = filter.run(&model);
    let mut steps: Steps = said.iter().map(values).collect();
    super::output::spoiled(filter, &model, &said, &mut steps);
    Some(steps)
}

pub(crate) fn answer(case: &Case, steps: Option<Steps>) -> Answer {
    let number = |value: &f64| exact_value(*value).map_or(Number::NotANumber, Number::Finite);
    let numbers = |values: &Values<f64>| values.iter().map(|(&name, matrix)| (name, matrix.map(number))).collect();
    match steps {
        Some(steps) => Answer::answered(&case.id, steps.iter().map(numbers).collect()),
        None => Answer { outcome: Outcome::Unsupported, ..Answer::answered(&case.id, Vec::new()) },
    }
}

/// The judgements on what `answers` says to each case.
pub(crate) fn judgements(answers: impl Fn(&Case) -> Option<Steps> + Sync) -> Vec<Judgement> {
    let judged =
        |(case, truth): &(Case, Truth)| Judgement::of(case.expect, truth, &Reply::Answer(answer(case, answers(case))));
    TRUTHS.par_iter().map(judged).collect()
}

/// What those judgements look like together.
pub(crate) fn diagnosis(answers: impl Fn(&Case) -> Option<Steps> + Sync) -> (Vec<Judgement>, Diagnosis) {
    let judgements = judgements(answers);
    let diagnosis = Diagnosis::of(&judgements);
    (judgements, diagnosis)
}
