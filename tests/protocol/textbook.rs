//! The example subject in Python, against one-shot conditioning of everything at once.

use std::time::Duration;

use exact_kalman::protocol::{Case, Limits, Number, Outcome, Reply, Subject};
use exact_kalman::scalar::nearest_double;
use exact_kalman::trace::Quantity;
use serde_json::{Value, json};

use crate::samples::{full, walk, with};

fn textbook() -> Option<Subject> {
    let found = std::process::Command::new("python3").arg("--version").output().is_ok();
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/subjects/textbook.py");
    let limits = Limits { case_time: Duration::from_secs(20), ..Limits::default() };
    found.then(|| Subject::new(&["python3".to_owned(), script.to_owned()], limits))
}

/// The two timings of shared noise, with inputs and a missing reading: scalar, so that truth fits in a line.
fn shared(timing: &str, before: &str) -> Value {
    let sample = with(walk(), "/timing", timing.into());
    let sample = with(sample, "/initial/before", before.into());
    let sample = with(sample, "/noise/cross", json!([["0.5"]]));
    let sample = with(sample, "/input", json!({"matrix": [["2"]], "vector": ["0.5"]}));
    with(sample, "/observation_input", json!({"vector": ["0.25"]}))
}

/// The last filtered mean and variance of a scalar case.
fn last(subject: &mut Subject, case: &Value) -> (f64, f64) {
    let case = Case::parse(&case.to_string()).expect("a sound case");
    let reply = subject.ask(&case.id, &case.to_line());
    let Reply::Answer(answer) = reply else { panic!("{reply}") };
    assert_eq!(answer.outcome, Outcome::Answered, "{:?}", answer.message);
    let values = answer.steps.last().expect("at least one");
    let double = |quantity| match &values[&quantity][(0, 0)] {
        Number::Finite(value) => nearest_double(value),
        other => panic!("{other:?}"),
    };
    (double(Quantity::FilteredMean), double(Quantity::FilteredCovariance))
}

#[test]
fn shared_noise_in_both_timings() {
    let Some(mut subject) = textbook() else { return };
    // x_0 ~ N(0, 1), y_0 = x_0 + 1/4 + v_0 = 1, x_1 = x_0 + 1 + w, y_1 = x_1 + 1/4 + v_1 = 3, all variances 1.
    // Departing, cov(w_0, v_0) = 1/2: (x_1, y_0, y_1) has means (1, 1/4, 5/4) and covariance
    // [2, 3/2, 2; 3/2, 2, 3/2; 2, 3/2, 3]. With S = [2, 3/2; 3/2, 3], det S = 15/4,
    // gain = [3/2, 2] S⁻¹ = [6/15, 7/15], mean = 1 + 6/15·3/4 + 7/15·7/4 = 127/60, variance = 2 − 9/15 − 14/15 = 7/15.
    let (mean, variance) = last(&mut subject, &shared("departing", "observation"));
    assert!((mean - 127.0 / 60.0).abs() < 1e-14 && (variance - 7.0 / 15.0).abs() < 1e-14, "{mean} {variance}");
    // Arriving, cov(w_1, v_1) = 1/2: cov(x_1, y_0) = 1, cov(x_1, y_1) = 5/2, cov(y_0, y_1) = 1, var y_1 = 4:
    // S = [2, 1; 1, 4], det S = 7, gain = [3/14, 4/7], mean = 1 + 3/14·3/4 + 4/7·7/4 = 121/56,
    // variance = 2 − 3/14 − 10/7 = 5/14.
    let (mean, variance) = last(&mut subject, &shared("arriving", "observation"));
    assert!((mean - 121.0 / 56.0).abs() < 1e-14 && (variance - 5.0 / 14.0).abs() < 1e-14, "{mean} {variance}");
    // Arriving with a transition before the only reading, y_0 = 1: x_0 ~ N(1, 2), cov(x_0, y_0) = 5/2, var y_0 = 4,
    // mean = 1 + 5/8·(1 − 5/4) = 27/32, variance = 2 − 25/16 = 7/16.
    let one = with(shared("arriving", "transition"), "/observations", json!([["1"]]));
    assert_eq!(last(&mut subject, &one), (27.0 / 32.0, 7.0 / 16.0));
    // The same noise as factors: D = [1, 0], F = [1/2, h] with h² = 3/4 has no rational h; take F = [3/5, 4/5].
    let factors = json!({"process_factor": [["1", "0"]], "observation_factor": [["0.6", "0.8"]]});
    let cross = with(walk(), "/noise/cross", json!([["0.6"]]));
    let (by_factors, by_covariances) =
        (last(&mut subject, &with(walk(), "/noise", factors)), last(&mut subject, &cross));
    assert!((by_factors.0 - by_covariances.0).abs() < 1e-14 && (by_factors.1 - by_covariances.1).abs() < 1e-14);
    // A missing reading adds the variance of one step: x_1 ~ N(1/2, 3/2).
    let missing = with(walk(), "/observations/1", Value::Null);
    assert_eq!(last(&mut subject, &missing), (0.5, 1.5));
}

#[test]
fn what_it_cannot_do_it_says() {
    let Some(mut subject) = textbook() else { return };
    let mut outcome = |case: &Value| {
        let case = Case::parse(&case.to_string()).expect("a sound case");
        match subject.ask(&case.id, &case.to_line()) {
            Reply::Answer(answer) => (answer.outcome, answer.step, answer.steps.len()),
            reply => panic!("{reply}"),
        }
    };
    assert_eq!(outcome(&full()), (Outcome::Unsupported, None, 0));
    let singular = json!({"process": [["0"]], "observation": [["0"]]});
    // The first reading tells everything; the second has no variance left.
    assert_eq!(outcome(&with(walk(), "/noise", singular)), (Outcome::Error, Some(1), 1));
}
