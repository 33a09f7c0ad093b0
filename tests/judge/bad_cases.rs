//! Each case that must be refused has exactly one fault: put right, it is a valid problem.

use exact_kalman::judge::suite;
use exact_kalman::protocol::{Case, Expect};
use serde_json::{Value, json};

/// The id, where the fault is told, where it lies in the document, and what puts it right.
fn repairs() -> Vec<(&'static str, &'static str, &'static str, Value)> {
    let [pair, twin] = [[["1", "0"], ["0", "1"]], [["1", "0.5"], ["0.5", "1"]]].map(|rows| json!(rows));
    vec![
        ("refuse/asymmetric-prior", "initial.covariance", "/initial/covariance/1/0", json!("1")),
        ("refuse/indefinite-prior", "initial.covariance", "/initial/covariance", json!([["500", "80"], ["80", "500"]])),
        ("refuse/negative-prior", "initial.covariance", "/initial/covariance/1/1", json!("1")),
        ("refuse/covariance-without-variance", "initial.covariance", "/initial/covariance/1/1", json!("1")),
        ("refuse/asymmetric-process-noise", "noise.process", "/noise/process/1/0", json!("0.5")),
        ("refuse/indefinite-process-noise", "noise.process", "/noise/process", twin.clone()),
        ("refuse/negative-process-noise", "noise.process", "/noise/process/1/1", json!("0.001")),
        ("refuse/negative-variance", "noise.observation", "/noise/observation/0/0", json!("1")),
        ("refuse/one-negative-of-two", "noise.observation", "/noise/observation/1/1", json!("0.5")),
        ("refuse/indefinite-observation-noise", "noise.observation", "/noise/observation", twin.clone()),
        ("refuse/asymmetric-observation-noise", "noise.observation", "/noise/observation/1/0", json!("0.5")),
        ("refuse/cross-noise-too-large", "noise", "/noise/cross/0/0", json!("1")),
        ("refuse/cross-noise-without-noise", "noise", "/noise/observation/0/0", json!("1")),
        ("refuse/late-indefinite-noise", "noise.process", "/noise/process/1", twin),
        ("refuse/nan-in-prior", "initial.covariance[1][1]", "/initial/covariance/1/1", json!("10")),
        ("refuse/infinite-prior", "initial.covariance[0][0]", "/initial/covariance/0/0", json!("10")),
        ("refuse/nan-in-mean", "initial.mean[1]", "/initial/mean/1", json!("0")),
        ("refuse/nan-in-transition", "transition[0][1]", "/transition/0/1", json!("0.1")),
        ("refuse/infinite-transition", "transition[1][1]", "/transition/1/1", json!("1")),
        ("refuse/nan-in-observation", "observation[0][1]", "/observation/0/1", json!("0")),
        ("refuse/nan-in-process-noise", "noise.process[0][0]", "/noise/process/0/0", json!("1")),
        ("refuse/nan-in-observation-noise", "noise.observation[0][0]", "/noise/observation/0/0", json!("0.5")),
        ("refuse/nan-in-input", "input.vector[1][0]", "/input/vector/1/0", json!("1")),
        ("refuse/nan-reading", "observations[1][0]", "/observations/1", Value::Null),
        ("refuse/infinite-reading", "observations[1][0]", "/observations/1/0", json!("2")),
        ("refuse/overflow", "observations[1][0]", "/observations/1/0", json!("1e300")),
        ("refuse/overflow-of-single", "observations[1][0]", "/observations/1/0", json!("1e38")),
        ("refuse/not-a-number", "observations[1][0]", "/observations/1/0", json!("2")),
        ("refuse/decimal-comma", "observations[1][0]", "/observations/1/0", json!("2.5")),
        ("refuse/observation-too-wide", "observation", "/observation", json!([["1", "0"]])),
        ("refuse/ragged-transition", "transition", "/transition/1", json!(["0", "1"])),
        ("refuse/transition-not-square", "transition", "/transition", pair.clone()),
        ("refuse/mean-too-long", "initial.covariance", "/initial/mean", json!(["0", "0"])),
        ("refuse/prior-too-small", "initial.covariance", "/initial/covariance", pair.clone()),
        ("refuse/process-noise-too-small", "noise.process", "/noise/process", pair.clone()),
        ("refuse/observation-noise-too-large", "noise.observation", "/noise/observation", json!([["0.5"]])),
        ("refuse/cross-noise-transposed", "noise.cross", "/noise/cross", json!([["0.25"], ["0.25"]])),
        ("refuse/too-many-readings", "observations", "/observations/1", json!(["2"])),
        ("refuse/rows-without-sensor", "observation", "/observation", json!([["1", "0"]])),
        ("refuse/input-too-short", "input.vector", "/input/vector/1", json!(["1", "0"])),
        ("refuse/one-matrix-too-few", "observation", "/observation/2", json!([["1", "0"]])),
        ("refuse/one-noise-too-many", "noise.observation", "/noise/observation", json!([["1"]])),
        ("refuse/matrix-left-out", "transition", "/transition/1", pair.clone()),
        ("refuse/no-state", "initial.mean", "/initial/mean", json!(["0"])),
        ("refuse/no-reading", "observations", "/observations", json!([["1"]])),
        ("refuse/before-transition-departing", "initial.before", "/initial/before", json!("observation")),
        ("refuse/diffuse-indefinite", "initial.diffuse", "/initial/diffuse", pair),
    ]
}

fn refusal(case: &Case) -> Option<String> {
    case.problem().and_then(|problem| problem.realised()).err().map(|error| error.to_string())
}

#[test]
fn every_bad_case_is_refused_for_its_one_fault() {
    let repairs = repairs();
    let bad: Vec<Case> = suite().into_iter().filter(|case| case.expect == Expect::Refuse).collect();
    assert!(bad.iter().map(|case| case.id.as_str()).eq(repairs.iter().map(|repair| repair.0)));
    for (case, (id, place, pointer, repair)) in bad.iter().zip(repairs) {
        let why = refusal(case).expect(id);
        assert!(why.starts_with(&format!("{place}: ")), "{id}: {why}");
        let mut document: Value = serde_json::from_str(&case.to_line()).expect("JSON");
        match document.pointer_mut(pointer) {
            Some(entry) => *entry = repair,
            None => document["observation"].as_array_mut().expect("an array").push(repair),
        }
        let repaired = Case::parse(&document.to_string()).expect("a sound case");
        assert_eq!(refusal(&repaired), None, "{id}");
    }
}
