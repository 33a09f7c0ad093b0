//! Each case that must be refused has exactly one fault: put right, it is a valid problem.

use exact_kalman::judge::suite;
use exact_kalman::protocol::{Case, Expect};
use serde_json::{Value, json};

/// The id, where the fault is told, where it lies in the document, and what puts it right.
fn repairs() -> Vec<(&'static str, &'static str, &'static str, Value)> {
    vec![
        ("refuse/asymmetric-prior", "initial.covariance", "/initial/covariance/1/0", json!("1")),
        ("refuse/indefinite-prior", "initial.covariance", "/initial/covariance", json!([["500", "80"], ["80", "500"]])),
        ("refuse/nan-in-prior", "initial.covariance[1][1]", "/initial/covariance/1/1", json!("10")),
        ("refuse/asymmetric-process-noise", "noise.process", "/noise/process/1/0", json!("0.5")),
        ("refuse/negative-variance", "noise.observation", "/noise/observation/0/0", json!("1")),
        ("refuse/cross-noise-too-large", "noise", "/noise/cross/0/0", json!("1")),
        ("refuse/nan-reading", "observations[1][0]", "/observations/1", Value::Null),
        ("refuse/infinite-reading", "observations[1][0]", "/observations/1/0", json!("2")),
        ("refuse/overflow", "observations[1][0]", "/observations/1/0", json!("1e300")),
        ("refuse/observation-too-wide", "observation", "/observation", json!([["1", "0"]])),
        ("refuse/ragged-transition", "transition", "/transition/1", json!(["0", "1"])),
        ("refuse/one-matrix-too-few", "observation", "/observation/2", json!([["1", "0"]])),
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
        let mut document: Value = serde_json::from_str(&case.to_line()).unwrap();
        match document.pointer_mut(pointer) {
            Some(entry) => *entry = repair,
            None => document["observation"].as_array_mut().unwrap().push(repair),
        }
        let repaired = Case::parse(&document.to_string()).unwrap();
        assert_eq!(refusal(&repaired), None, "{id}");
    }
}
