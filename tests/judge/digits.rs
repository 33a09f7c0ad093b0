//! Known errors have known digits.
#![expect(clippy::float_cmp, reason = "whole numbers of digits are met exactly")]

use exact_kalman::judge::{Judgement, Truth, Verdict};
use exact_kalman::matrix::Matrix;
use exact_kalman::protocol::{Answer, Case, Number, Reply};
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::trace::{Quantity, Values};
use serde_json::{Value, json};

use crate::samples::{add, belief, exact_answer, judge, of_suite, score};

fn ten_to(power: i32) -> Rational {
    ratio(10, 1).pow(power)
}

/// The digits of one entry of one quantity that is wrong by the given error.
fn digits(case: &Case, place: (usize, Quantity, usize, usize), error: &Rational) -> f64 {
    let mut answer = exact_answer(case);
    add(&mut answer, place, error);
    let judgement = judge(case, answer);
    let score = score(&judgement, place.1);
    if score.fewest.value() < 17.0 {
        assert_eq!((score.step, score.worst.row, score.worst.column), (place.0, place.2, place.3));
    }
    assert_eq!(score.fewest, score.worst.digits);
    score.fewest.value()
}

#[test]
fn errors_of_covariances_are_relative_to_the_standard_deviations() {
    // √(4·9) = 6, √(4·4) = 4, √(9·9) = 9.
    let case = belief(&json!(["0", "0"]), &json!([["4", "1"], ["1", "9"]]), 1);
    for k in -3..=16 {
        for (row, column, unit) in [(0, 1, 6), (1, 0, 6), (0, 0, 4), (1, 1, 9)] {
            let place = (0, Quantity::FilteredCovariance, row, column);
            for sign in [1, -1] {
                assert_eq!(digits(&case, place, &(ten_to(-k) * ratio(sign * unit, 1))), f64::from(k));
            }
        }
    }
}

#[test]
fn a_hair_more_than_a_power_of_ten_is_a_digit_less() {
    let case = belief(&json!(["0"]), &json!([["1"]]), 1);
    let place = (0, Quantity::FilteredCovariance, 0, 0);
    let hair = ratio(1, 1) + ten_to(-30);
    for k in 1..=16 {
        let (more, less) = (digits(&case, place, &(ten_to(-k) * &hair)), digits(&case, place, &(ten_to(-k) / &hair)));
        assert!(more < f64::from(k) && less >= f64::from(k), "{k}: {more} {less}");
    }
}

#[test]
fn digits_between_whole_numbers() {
    // √(2·3) = √6: an error of 10⁻⁵ has 5 + ½ log₁₀ 6 digits. The bound is that of doubles near 300 in magnitude.
    let case = belief(&json!(["0", "0"]), &json!([["2", "1"], ["1", "3"]]), 1);
    let found = digits(&case, (0, Quantity::FilteredCovariance, 0, 1), &ten_to(-5));
    assert!((found - (5.0 + 0.5 * 6.0_f64.log10())).abs() < 1e-13, "{found}");
}

#[test]
fn errors_of_means_are_relative_to_the_larger_of_mean_and_deviation() {
    // |1000| > √4; √4 > |1/1000|; |−3| = √9.
    let mean = json!(["1000", "0.001", "-3"]);
    let case = belief(&mean, &json!([["4", "0", "0"], ["0", "4", "0"], ["0", "0", "9"]]), 2);
    for k in -3..=16 {
        for (row, unit) in [(0, 1000), (1, 2), (2, 3)] {
            let place = (1, Quantity::FilteredMean, row, 0);
            assert_eq!(digits(&case, place, &(ten_to(-k) * ratio(unit, 1))), f64::from(k));
        }
    }
}

#[test]
fn a_variance_of_zero_is_measured_by_the_largest_of_the_run() {
    // The prior variance is 4, the sensor has no noise: after the reading 1 the variance is 0.
    let text = r#"{"format":"exact-kalman/case/1","id":"known","timing":"departing",
        "initial":{"before":"observation","mean":["0"],"covariance":[["4"]]},"transition":[["1"]],"observation":[["1"]],
        "noise":{"process":[["0"]],"observation":[["0"]]},"observations":[["1"]]}"#;
    let case = Case::parse(text).expect("a sound case");
    assert_eq!(digits(&case, (0, Quantity::FilteredCovariance, 0, 0), &(ratio(4, 1) * ten_to(-5))), 5.0);
    assert_eq!(digits(&case, (0, Quantity::FilteredMean, 0, 0), &(ratio(2, 1) * ten_to(-5))), 5.0);
    // Nothing sets a scale for a state that is always known: only the exact value is right.
    let never = belief(&json!(["0", "0"]), &json!([["1", "0"], ["0", "0"]]), 1);
    assert_eq!(digits(&never, (0, Quantity::FilteredCovariance, 1, 1), &ten_to(-300)), 0.0);
    assert_eq!(digits(&never, (0, Quantity::FilteredCovariance, 1, 1), &ratio(0, 1)), 17.0);
    assert_eq!(digits(&never, (0, Quantity::FilteredMean, 1, 0), &ten_to(-300)), 0.0);
}

#[test]
fn seventeen_is_the_cap_and_means_exact() {
    let case = belief(&json!(["1"]), &json!([["1"]]), 1);
    for error in [ratio(0, 1), ten_to(-17), ten_to(-30), ten_to(-400)] {
        assert_eq!(digits(&case, (0, Quantity::FilteredMean, 0, 0), &error), 17.0);
    }
    assert!(digits(&case, (0, Quantity::FilteredMean, 0, 0), &(ten_to(-17) * ratio(11, 10))) < 17.0);
}

#[test]
fn magnitudes_do_not_matter() {
    for exponent in [-300, 300, -2000, 2000] {
        let scale = ten_to(exponent);
        let (mean, variance) = (format!("-1e{exponent}"), format!("1e{}", 2 * exponent));
        let case = belief(&json!([mean]), &json!([[variance]]), 1);
        for k in [-6, 3, 12] {
            assert_eq!(digits(&case, (0, Quantity::FilteredMean, 0, 0), &(ten_to(-k) * &scale)), f64::from(k));
            let error = ten_to(-k) * &scale * &scale;
            assert_eq!(digits(&case, (0, Quantity::FilteredCovariance, 0, 0), &error), f64::from(k));
        }
    }
}

/// The judgement on an answer in which one quantity at one step is replaced.
fn with(case: &Case, step: usize, quantity: Quantity, value: Option<Matrix<Number>>) -> Judgement {
    let mut answer = exact_answer(case);
    let values: &mut Values<Number> = &mut answer.steps[step];
    match value {
        Some(value) => values.insert(quantity, value),
        None => values.remove(&quantity),
    };
    judge(case, answer)
}

#[test]
fn what_has_no_digits_is_wrong_and_named() {
    let case = of_suite("basic/constant-velocity");
    let zero = Number::Finite(ratio(0, 1));
    let column = |entry: &Number| Matrix::column(vec![zero.clone(), entry.clone()]);
    let (nan, infinite) = (Number::NotANumber, Number::Infinite { negative: true });
    let wide = Matrix::from_fn(2, 3, |_, _| zero.clone());
    for (value, words) in [
        (Some(column(&nan)), "filtered mean at step 5 has an entry NaN"),
        (Some(column(&infinite)), "filtered mean at step 5 has an entry -Infinity"),
        (Some(wide), "filtered mean at step 5 is 2×3 where 2×1 is needed"),
        (None, "filtered mean at step 5 is missing"),
    ] {
        let judgement = with(&case, 5, Quantity::FilteredMean, value);
        assert_eq!((judgement.verdict, judgement.remarks), (Verdict::Wrong, vec![words.to_owned()]));
    }
}

#[test]
fn not_a_number_in_a_covariance_is_wrong_too() {
    let case = of_suite("basic/constant");
    let judgement = with(&case, 1, Quantity::PredictedCovariance, Some(Matrix::column(vec![Number::NotANumber])));
    assert_eq!(judgement.verdict, Verdict::Wrong);
    assert_eq!(judgement.remarks, ["predicted covariance at step 1 has an entry NaN"]);
}

#[test]
fn a_quantity_that_is_never_given_is_not_judged() {
    let case = of_suite("basic/constant");
    let mut answer = exact_answer(&case);
    for values in &mut answer.steps {
        values.retain(|quantity, _| *quantity == Quantity::PredictedMean);
    }
    let judgement = judge(&case, answer);
    assert_eq!(judgement.verdict, Verdict::Agrees);
    assert_eq!(judgement.scores.iter().map(|score| score.quantity).collect::<Vec<_>>(), [Quantity::PredictedMean]);
}

#[test]
fn a_gain_is_not_judged() {
    let case = of_suite("basic/constant");
    let line = json!({"id": case.id, "outcome": "answered", "steps": [
        {"filtered_mean": ["0.5"], "gain": [["99"]]}, {"filtered_mean": ["1"], "gain": [["99"]]}]});
    let reply = Reply::Answer(Answer::parse(&line.to_string()).expect("a sound answer"));
    assert_eq!(Judgement::of(case.expect, &Truth::of(&case), &reply).verdict, Verdict::Agrees);
    let only: Value =
        json!({"id": case.id, "outcome": "answered", "steps": [{"gain": [["0.5"]]}, {"gain": [["0.5"]]}]});
    let reply = Reply::Answer(Answer::parse(&only.to_string()).expect("a sound answer"));
    assert_eq!(Judgement::of(case.expect, &Truth::of(&case), &reply).verdict, Verdict::Wrong);
}
