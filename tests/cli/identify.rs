//! `identify`: exact estimates from data, and refusals with their place.

use serde_json::{Value, json};

use crate::program::{feed, run};

const MOMENTS: &str = "examples/identify/moments.json";
const LEAST_SQUARES: &str = "examples/identify/least-squares.json";
const ADAPTIVE: &str = "examples/identify/adaptive.json";

fn moments(readings: &[i64]) -> Value {
    let readings: Vec<Value> = readings.iter().map(|y| json!([y])).collect();
    json!({"format": "exact-kalman/identification/1", "numbers": "exact", "moments": {"readings": readings}})
}

fn least_squares() -> Value {
    serde_json::from_str(&std::fs::read_to_string(LEAST_SQUARES).expect("a readable file")).expect("JSON")
}

fn with(mut document: Value, pointer: &str, value: Value) -> Value {
    let (parent, key) = pointer.rsplit_once('/').expect("two parts");
    match document.pointer_mut(parent).expect("a place in the document") {
        Value::Array(items) => items[key.parse::<usize>().expect("a number")] = value,
        other => other[key] = value,
    }
    document
}

/// By hand: y = (4, 2, 3) has Â = 3/2, residuals 0 and 3 − 9, so B(1) = 0, B(2) = 12, Ŵ = −8/3, V̂ = 26/3.
#[test]
fn estimates_by_hand() {
    let out = feed(&["identify", "-", "--exact"], &moments(&[4, 2, 3]).to_string()).quietly(0);
    assert_eq!(
        out,
        "3 readings
  transition               3/2
  one-step residuals       0
  two-step residuals       12
  process noise            26/3
  observation noise        -8/3
"
    );
    // Numbers as strings, as decimals, and as doubles.
    let strings = moments(&[4, 2, 3]).to_string().replace("[4]", "[\"8/2\"]").replace("[2]", "[2.0]");
    assert_eq!(feed(&["identify", "-", "--exact"], &strings).quietly(0), out);
    let doubles = moments(&[4, 2, 3]).to_string().replace("exact\"", "binary64\"").replace("[3]", "[0.1]");
    let doubles = feed(&["identify", "-", "--exact"], &doubles).quietly(0);
    // 0.1 is 3602879701896397 · 2⁻⁵⁵; half of it.
    assert!(doubles.contains("transition               3602879701896397/72057594037927936\n"), "{doubles}");
}

#[test]
fn singular_estimates_are_told() {
    let out = feed(&["identify", "-"], &moments(&[1, 1, 0]).to_string()).quietly(0);
    assert!(out.contains("kernel of the transition 1\n") && !out.contains("process noise"), "{out}");
}

/// By hand: P₀ = I, φ = (1, 0), y = 2: gain (1/2, 0), mean (1, 0), covariance diag(1/2, 1).
#[test]
fn least_squares_by_hand() {
    let out = run(&["identify", LEAST_SQUARES, "--exact"]).quietly(0);
    assert!(
        out.starts_with("output 0\n  mean                     [1, 0]\n  covariance               [[1/2, 0], [0, 1]]\n")
    );
    assert_eq!(run(&["identify", LEAST_SQUARES, "--exact", "--last"]).quietly(0).lines().count(), 3);
    // The batch answer of the last step: information I + Σφφᵀ = [[15, 97], [97, 794]], vector Σφy = (13/2, 21/2).
    let out = run(&["identify", LEAST_SQUARES, "--exact", "--last", "--format", "json"]).quietly(0);
    let document: Value = serde_json::from_str(&out).expect("JSON");
    let determinant = 15 * 794 - 97 * 97;
    let fraction = |text: &Value| {
        let text = text.as_str().expect("a string");
        let (n, d) = text.split_once('/').unwrap_or((text, "1"));
        (n.parse::<i64>().expect("a number"), d.parse::<i64>().expect("a number"))
    };
    let (n, d) = fraction(&document["steps"][0]["mean"][0]);
    assert_eq!(2 * n * determinant, (794 * 13 - 97 * 21) * d);
    let (n, d) = fraction(&document["steps"][0]["covariance"][0][1]);
    assert_eq!(n * determinant, -97 * d);
}

#[test]
fn the_adaptive_filter_is_shown() {
    let out = run(&["identify", ADAPTIVE, "--format", "json"]).quietly(0);
    let document: Value = serde_json::from_str(&out).expect("JSON");
    let steps = document["steps"].as_array().expect("an array");
    assert_eq!(steps.len(), 6);
    for step in steps {
        let number = |key: &str| step[key][0][0].as_str().expect("a string").parse::<f64>().expect("a number");
        let (s, gain, p) = (number("predicted_covariance"), number("gain"), number("filtered_covariance"));
        assert!((p - (1.0 - gain) * s).abs() <= 1e-12 * s && number("process_noise_used") >= 0.0, "{step}");
    }
}

#[test]
fn bad_input_is_refused_with_its_place() {
    let alone = |document: Value| feed(&["identify", "-"], &document.to_string()).trouble();
    let good = || moments(&[4, 2, 3]);
    let cases = [
        (moments(&[4, 2]), "moments.readings: 2 readings"),
        (moments(&[]), "moments.readings: 0 readings"),
        (with(good(), "/moments/readings/1", json!(["1", "2"])), "moments.readings[1]: "),
        (with(good(), "/moments/readings/1", json!(["NaN"])), "moments.readings[1][0]: \"NaN\" is not a finite number"),
        (with(good(), "/moments/readings/1", json!(["1/0"])), "moments.readings[1][0]: "),
        (with(good(), "/moments/readings/1", json!([null])), "moments.readings[1][0]: "),
        (with(good(), "/moments/readings", json!([[], [], []])), "no component"),
        (with(good(), "/moments/reading", json!([])), "unknown field `reading`"),
        (with(good(), "/moments/residuals", json!("best")), "unknown variant `best`"),
        (with(good(), "/numbers", json!("decimal")), "unknown variant"),
        (
            with(good(), "/least_squares", least_squares()["least_squares"].clone()),
            "either `moments` or `least_squares`",
        ),
        (json!({"format": "exact-kalman/identification/1"}), "either `moments` or `least_squares`"),
        (with(good(), "/moments/readings", json!(vec![vec!["1"; 5]; 3])), "the order 5 is too large"),
        (with(good(), "/moments/readings", json!(vec![vec!["1"]; 4001])), "4001 readings are too many"),
        (
            with(good(), "/moments/adaptive_filter", json!({"mean": ["1", "2"], "covariance": [["1"]]})),
            "moments.adaptive_filter.mean: 2 numbers where 1 are needed",
        ),
        (
            with(good(), "/moments/adaptive_filter", json!({"mean": ["1"], "covariance": [["-1"]]})),
            "moments.adaptive_filter.covariance: not positive semidefinite: v = [1] has vᵀPv = -1 < 0",
        ),
        (with(least_squares(), "/least_squares/inputs", json!(["1"])), "least_squares.inputs: 1 inputs; from 2 to 3"),
        (with(least_squares(), "/least_squares/noise", json!("-1")), "least_squares.noise: "),
        (with(least_squares(), "/least_squares/output_lags", json!(1_000_000_000)), "take fewer lags"),
        (with(least_squares(), "/least_squares/output_lags", json!(u64::MAX)), "take fewer lags"),
        (with(least_squares(), "/least_squares/output_lags", json!(-1)), "least_squares.output_lags"),
        (with(least_squares(), "/least_squares/outputs", json!([])), "least_squares.outputs: there is no output"),
        (with(least_squares(), "/least_squares/covariance/1", json!(["1", "1"])), "least_squares.covariance: "),
        (with(least_squares(), "/least_squares/covariance/1", json!(["1"])), "least_squares.covariance[1]: 1 numbers"),
    ];
    for (document, expected) in cases {
        let message = alone(document.clone());
        assert!(message.contains(expected), "{document}\n{message}");
    }
    let keep = json!({"mean": [1], "covariance": [[1]], "repair": "keep"});
    let ran = feed(&["identify", "-"], &with(moments(&[1, 1, 0]), "/moments/adaptive_filter", keep).to_string());
    assert_eq!((ran.code, ran.stdout.as_str()), (1, ""));
    assert!(ran.stderr.contains("stops at y(3)") && ran.stderr.contains("it maps [1] to zero"), "{}", ran.stderr);
    assert!(feed(&["identify", "-"], "").trouble().contains("too early"));
    assert!(feed(&["identify", "-"], "[1").code == 2);
    // Without noise, y = y₋₁ cannot be followed by something else.
    let certain = json!({"format": "exact-kalman/identification/1", "least_squares": {
        "output_lags": 1, "mean": [1], "covariance": [[0]], "noise": 0, "earlier_outputs": [1], "outputs": [1, 2]}});
    let ran = feed(&["identify", "-"], &certain.to_string());
    assert_eq!((ran.code, ran.stdout.lines().next()), (1, Some("output 0")));
    assert!(ran.stderr.contains("outputs[1]: ") && ran.stderr.contains("probability zero"), "{}", ran.stderr);
}

#[test]
fn data_that_would_be_ignored_are_refused() {
    for (key, value, expected) in [
        ("earlier_inputs", json!([1, 2]), "earlier_inputs: 2 numbers"),
        ("earlier_outputs", json!([1, 2]), "earlier_outputs: 2 numbers"),
    ] {
        let document = with(least_squares(), &format!("/least_squares/{key}"), value);
        assert!(feed(&["identify", "-"], &document.to_string()).trouble().contains(expected));
    }
}

#[test]
fn long_numbers_are_refused_before_the_work_is_begun() {
    let long: Vec<Value> = (0..24).map(|k| json!([format!("1/{}{k}1", "7".repeat(150))])).collect();
    let message = feed(&["identify", "-"], &with(moments(&[]), "/moments/readings", json!(long)).to_string()).trouble();
    assert!(message.contains("too long for 24 readings") && message.contains("\"residuals\": \"last\""), "{message}");
    let start = json!({"mean": [0, 0, 0, 0], "covariance": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]});
    let short: Vec<Value> = (1..=7).map(|k| json!([k, k * k % 7, 5 - k, k % 3])).collect();
    let document = with(with(moments(&[]), "/moments/readings", json!(short)), "/moments/adaptive_filter", start);
    feed(&["identify", "-", "--last"], &document.to_string()).quietly(0);
}

/// Every number of the examples goes through: schema, reader and program agree that they are good.
#[test]
fn examples_are_good() {
    for (file, steps) in [(MOMENTS, 6), (ADAPTIVE, 6), (LEAST_SQUARES, 3)] {
        let out = run(&["identify", file, "--format", "json"]).quietly(0);
        let document: Value = serde_json::from_str(&out).expect("JSON");
        assert_eq!(document["steps"].as_array().expect("an array").len(), steps, "{file}");
    }
    assert_eq!(run(&["identify", MOMENTS, "--exact", "--digits", "5"]).code, 2);
}
