//! A filter that believes itself steady, as a known package does: from the step on at which the square of the change of the
//! predicted variance is below 10⁻¹⁹, the variances are kept.

use exact_kalman::judge::{Diagnosis, Judgement, Verdict};
use exact_kalman::matrix::Matrix;
use exact_kalman::protocol::{Answer, Case, Number, Reply};
use exact_kalman::scalar::exact_value;
use exact_kalman::trace::{Quantity, Values};
use serde_json::Value;

use crate::samples::TRUTHS;

fn number(value: &Value) -> f64 {
    value.as_str().and_then(|text| text.parse().ok()).expect("a number")
}

/// Constant scalar systems whose noise is not shared; S, the filtered variance and the predicted one of the step at which
/// it rests are kept.
fn answer(case: &Case) -> Answer {
    let text: Value = serde_json::from_str(&case.to_line()).expect("JSON");
    let one = |matrix: &Value| number(&matrix[0][0]);
    let (a, c) = (one(&text["transition"]), one(&text["observation"]));
    let (q, r) = (one(&text["noise"]["process"]), one(&text["noise"]["observation"]));
    let (mut x, mut p) = (number(&text["initial"]["mean"][0]), one(&text["initial"]["covariance"]));
    let mut kept: Option<(f64, f64, f64)> = None;
    let readings = text["observations"].as_array().expect("readings").iter().enumerate();
    let steps = readings.map(|(k, reading)| {
        let (s, filtered) = match kept {
            Some((s, filtered, _)) => (s, filtered),
            None => (c * p * c + r, p - p * c / (c * p * c + r) * c * p),
        };
        let mean = x + p * c / s * (number(&reading[0]) - c * x);
        let entry = |value: f64| Matrix::column(vec![Number::Finite(exact_value(value).expect("finite"))]);
        let values: Values<Number> = [
            (Quantity::PredictedMean, entry(x)),
            (Quantity::PredictedCovariance, entry(p)),
            (Quantity::FilteredMean, entry(mean)),
            (Quantity::FilteredCovariance, entry(filtered)),
        ]
        .into();
        let next = kept.map_or_else(|| a * filtered * a + q, |(.., p)| p);
        if kept.is_none() && k > 0 && (next - p) * (next - p) < 1e-19 {
            kept = Some((s, filtered, p));
        }
        (x, p) = (a * mean, next);
        values
    });
    Answer::answered(&case.id, steps.collect())
}

#[test]
fn variances_that_rest_by_the_sum_of_squares_are_named() {
    let judged = ["basic/damped", "basic/alternating", "units/micro", "units/nano"].map(|id| {
        let (case, truth) = TRUTHS.iter().find(|(case, _)| case.id == id).unwrap_or_else(|| panic!("no case {id}"));
        Judgement::of(case.expect, truth, &Reply::Answer(answer(case)))
    });
    let explanations = Diagnosis::of(&judged).explanations;
    let first = explanations.first().expect("a name");
    assert_eq!(first.mistake.name, "covariance-rests-too-early");
    assert!(first.ways.iter().any(|way| way.starts_with("10^-19 for the sum of squares")), "{:?}", first.ways);
    // In small units it rests at the second step: that is wrong, and not only worth a few digits.
    assert_eq!(judged[2].verdict, Verdict::Wrong);
    assert!(matches!(judged[0].verdict, Verdict::Loses { .. }), "{}", judged[0].verdict);
    assert!([2, 3].iter().all(|place| first.explains.contains(place)), "{:?}", first.explains);
}
