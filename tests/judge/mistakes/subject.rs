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

/// The cases on which mistakes are shown: few, since each subject is asked all of them, small, and such that each mistake
/// shows in more than one.
const CASES: [&str; 44] = [
    "basic/constant",
    "basic/two-sensors-by-hand",
    "basic/observation-offset",
    "basic/damped",
    "basic/random-walk",
    "basic/far-mean",
    "basic/known-input",
    "basic/constant-velocity",
    "basic/two-sensors",
    "conventions/variance-not-deviation",
    "conventions/first-reading-counts",
    "conventions/every-cross-arriving",
    "conventions/every-cross-departing",
    "conventions/every-index-arriving",
    "conventions/every-index-before",
    "conventions/every-index-departing",
    "conventions/start-at-the-reading",
    "conventions/start-before-the-transition",
    "conventions/transposed-observation",
    "conventions/transposed-transition",
    "varying/transition",
    "varying/transition-into",
    "varying/process-noise",
    "varying/sensor-noise",
    "varying/irregular-sampling",
    "varying/regressors",
    "missing/varying-noise",
    "missing/with-input",
    "missing/whole-steps",
    "missing/one-of-two-sensors",
    "missing/last-in-part",
    "correlated/departing",
    "correlated/factors-departing",
    "input/both",
    "input/pulses",
    "diffuse/random-walk",
    "diffuse/one-direction",
    "units/micro",
    "units/nano",
    "units/side-by-side",
    "units/trend-1e-5",
    "adapted/regression-with-feedback",
    "collinear/noise-1e-14",
    "prior/correlated-2-10",
];

/// The cases with their truths.
pub(crate) static TRUTHS: LazyLock<Vec<(Case, Truth)>> = LazyLock::new(|| {
    let all: BTreeMap<String, Case> = suite().into_iter().map(|case| (case.id.clone(), case)).collect();
    let case = |id: &&str| all.get(*id).cloned().unwrap_or_else(|| panic!("{id} is no case of the suite"));
    let cases: Vec<Case> = CASES.iter().map(case).collect();
    assert!(cases.iter().all(|case| case.expect == Expect::Estimate));
    cases.into_par_iter().map(|case| (case.clone(), Truth::of(&case))).collect()
});

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
