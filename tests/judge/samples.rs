//! Cases and answers that the tests start from.

use std::sync::LazyLock;

use exact_kalman::filter::{filter, one_shot};
use exact_kalman::judge::{Judgement, Score, Truth, suite};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::Path;
use exact_kalman::protocol::{Answer, Case, MAXIMAL_LITERAL_CHARACTERS, Number, Numbers, Outcome, Reply};
use exact_kalman::scalar::{Precision, Rational, exact_value, nearest_double};
use exact_kalman::trace::{Quantity, Values};
use rayon::prelude::*;
use serde_json::{Value, json};

/// The cases of the suite with their truths, computed once.
pub(crate) static TRUTHS: LazyLock<Vec<(Case, Truth)>> = LazyLock::new(|| {
    suite()
        .into_par_iter()
        .map(|case| {
            let truth = Truth::of(&case);
            (case, truth)
        })
        .collect()
});

/// A case of the suite.
pub(crate) fn of_suite(id: &str) -> Case {
    suite().into_iter().find(|case| case.id == id).unwrap_or_else(|| panic!("no case {id}"))
}

/// A belief in exact numbers and readings that are all missing: the answer is the belief, at every step.
pub(crate) fn belief(mean: &Value, covariance: &Value, steps: usize) -> Case {
    let n = mean.as_array().expect("a list of numbers").len();
    let unit: Vec<Vec<&str>> = (0..n).map(|i| (0..n).map(|j| if i == j { "1" } else { "0" }).collect()).collect();
    let zero = vec![vec!["0"; n]; n];
    let case = json!({
        "format": "exact-kalman/case/1", "id": "belief", "numbers": "exact", "timing": "departing",
        "initial": {"before": "observation", "mean": mean, "covariance": covariance},
        "transition": unit, "observation": vec![vec!["1"; n]],
        "noise": {"process": zero, "observation": [["1"]]},
        "observations": vec![Value::Null; steps],
    });
    Case::parse(&case.to_string()).expect("a sound case")
}

pub(crate) fn path(case: &Case) -> Path<Rational> {
    case.problem().expect("a sound problem").realised().expect("a sound path")
}

/// The exact values by conditioning everything at once; by the readable recursion where that would take too long, or
/// where the start is diffuse. Neither is the route that the judge takes.
pub(crate) fn exact_values(case: &Case) -> Vec<Values<Rational>> {
    let path = path(case);
    if path.initial().diffuse.is_some() || path.steps().len() * path.sensors() > 10 {
        return filter(&path).expect("an answer").records.iter().map(exact_kalman::trace::Record::values).collect();
    }
    let law = |values: &mut Values<Rational>,
               names: [Quantity; 2],
               mean: &Matrix<Rational>,
               covariance: &Matrix<Rational>| {
        values.insert(names[0], mean.clone());
        values.insert(names[1], covariance.clone());
    };
    let steps = one_shot(&path).expect("an answer");
    steps
        .iter()
        .map(|step| {
            let mut values = Values::new();
            let (filtered, predicted) = (&step.filtered, &step.predicted);
            law(
                &mut values,
                [Quantity::FilteredMean, Quantity::FilteredCovariance],
                filtered.mean(),
                filtered.covariance(),
            );
            law(
                &mut values,
                [Quantity::PredictedMean, Quantity::PredictedCovariance],
                predicted.mean(),
                predicted.covariance(),
            );
            values
        })
        .collect()
}

/// The exact answer, through the text of an answer; literals that no answer may hold are rounded to 400 bits.
pub(crate) fn exact_answer(case: &Case) -> Answer {
    let short = |value: &Rational| {
        let is_long = Numbers::Exact.write(value).len() > MAXIMAL_LITERAL_CHARACTERS;
        if is_long { Precision::Rounded { bits: 400 }.of(value) } else { value.clone() }
    };
    let values =
        |values: Values<Rational>| values.into_iter().map(|(name, matrix)| (name, matrix.map(short))).collect();
    let steps = exact_values(case).into_iter().map(values).collect();
    Answer::parse(&Answer::answered(&case.id, steps).to_line()).expect("our own answer")
}

/// The doubles nearest to the exact answer.
pub(crate) fn rounded_answer(case: &Case) -> Answer {
    let number = |value: &Rational| Number::Finite(exact_value(nearest_double(value)).expect("a finite double"));
    let values =
        |values: Values<Rational>| values.into_iter().map(|(name, matrix)| (name, matrix.map(number))).collect();
    Answer::answered(&case.id, exact_values(case).into_iter().map(values).collect())
}

/// An answer without estimates.
pub(crate) fn outcome(case: &Case, outcome: Outcome, step: Option<usize>) -> Answer {
    Answer { outcome, step, ..Answer::answered(&case.id, Vec::new()) }
}

/// Adds to one entry.
pub(crate) fn add(
    answer: &mut Answer,
    (step, quantity, row, column): (usize, Quantity, usize, usize),
    error: &Rational,
) {
    let entry = &mut answer.steps[step].get_mut(&quantity).expect("a judged quantity")[(row, column)];
    let Number::Finite(value) = entry else { panic!("finite") };
    *value += error;
}

pub(crate) fn judge(case: &Case, answer: Answer) -> Judgement {
    Judgement::of(case.expect, &Truth::of(case), &Reply::Answer(answer))
}

pub(crate) fn score(judgement: &Judgement, quantity: Quantity) -> &Score {
    judgement.scores.iter().find(|score| score.quantity == quantity).expect("a score")
}
