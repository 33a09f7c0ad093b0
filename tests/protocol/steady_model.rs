//! The documents of `steady`: schema and reader agree about them, cases are read, and the page shows an example.

use exact_kalman::model::UnifiedStep;
use exact_kalman::protocol::{Case, SteadyModel};
use exact_kalman::scalar::ratio;
use serde_json::{Value, json};

use crate::samples::with;
use crate::schema::valid;

const SCHEMA: &str = include_str!("../../schema/steady.schema.json");
const PAGE: &str = include_str!("../../docs/STEADY.md");

fn agree(value: &Value, expected: bool) {
    let schema: Value = serde_json::from_str(SCHEMA).expect("JSON");
    assert_eq!(valid(&schema, &schema, value), expected, "schema: {value}");
    assert_eq!(SteadyModel::parse(&value.to_string()).is_ok(), expected, "reader: {value}");
}

fn filter() -> Value {
    json!({"format": "exact-kalman/steady/1", "id": "a", "about": "b", "numbers": "exact", "timing": "arriving",
        "transition": [[2]], "observation": [["1"]],
        "noise": {"process": [[3]], "cross": [["1/2"]], "observation": [["0.25"]]}})
}

fn factors() -> Value {
    with(filter(), "/noise", json!({"process_factor": [[1, 2]], "observation_factor": [[3, 4]]}))
}

fn control() -> Value {
    json!({"format": "exact-kalman/steady/1", "id": "a",
        "control": {"a": [[1, 2], [3, 4]], "b": [[5], [6]], "q": [[1, 0], [0, 1]], "r": [[7]], "s": [[8], [9]]}})
}

#[test]
fn schema_and_reader_agree() {
    for (full, optional) in
        [(filter(), &["about", "numbers", "cross"][..]), (factors(), &["about", "numbers"]), (control(), &["s"])]
    {
        agree(&full, true);
        for pointer in ["", "/noise", "/control"] {
            let Some(members) = full.pointer(pointer).and_then(Value::as_object) else { continue };
            for key in members.keys() {
                let mut less = full.clone();
                less.pointer_mut(pointer).and_then(Value::as_object_mut).expect("an object").remove(key);
                agree(&less, optional.contains(&key.as_str()));
                for other in [json!(null), json!(true), json!({"z": 1}), json!([[["1"]]])] {
                    agree(&with(full.clone(), &format!("{pointer}/{key}"), other), false);
                }
            }
            agree(&with(full.clone(), &format!("{pointer}/unknown"), json!("x")), false);
        }
    }
    agree(&with(filter(), "/control", control()["control"].clone()), false);
}

#[test]
fn the_step_is_the_one_of_the_notes() {
    let one = |value: exact_kalman::scalar::Rational| exact_kalman::matrix::Matrix::from_fn(1, 1, |_, _| value.clone());
    // H = C A, S + Q C, R + C Q C + 2 C S.
    let expected = UnifiedStep {
        transition: one(ratio(2, 1)),
        observation: one(ratio(2, 1)),
        process_noise: one(ratio(3, 1)),
        cross_noise: one(ratio(7, 2)),
        observation_noise: one(ratio(17, 4)),
    };
    let read = |value: &Value| SteadyModel::parse(&value.to_string()).expect("a model");
    assert_eq!(read(&filter()).unified(), expected);
    // Q = 5, S = 11, R = 25.
    let departing = with(factors(), "/timing", json!("departing"));
    assert_eq!(read(&departing).unified().cross_noise, one(ratio(11, 1)));
    let of_control = read(&control()).unified();
    assert_eq!(of_control.transition[(0, 1)], ratio(3, 1));
    assert_eq!(of_control.observation.shape().to_string(), "1×2");
    assert_eq!(of_control.cross_noise[(1, 0)], ratio(9, 1));
    for value in [filter(), factors(), control()] {
        let model = read(&value);
        assert_eq!(read(&model.document()), model);
    }
}

#[test]
fn cases_are_read_where_they_do_not_change() {
    let case = |transition: Value| {
        json!({"format": "exact-kalman/case/1", "id": "walk", "timing": "departing",
            "initial": {"before": "observation", "mean": ["0"], "covariance": [["1"]]},
            "transition": transition, "observation": [["1"]],
            "noise": {"process": [["0.1"]], "observation": [["1"]]}, "observations": [["1"], null]})
        .to_string()
    };
    let text = case(json!([["1"]]));
    let model = SteadyModel::parse(&text).expect("a model");
    assert!(Case::parse(&text).is_ok());
    // A tenth is a double there.
    assert_ne!(model.unified().process_noise[(0, 0)], ratio(1, 10));
    let refused = SteadyModel::parse(&case(json!([[["1"]], [["2"]]]))).expect_err("it changes");
    assert!(refused.to_string().starts_with("transition: changes with time"), "{refused}");
}

#[test]
fn the_page_shows_an_example() {
    let shown = PAGE.split("```json").nth(1).and_then(|rest| rest.split("```").next()).expect("a document");
    let file = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/steady/radar.json"));
    let file = SteadyModel::parse(&file.expect("an example")).expect("a model");
    assert_eq!(SteadyModel::parse(shown).expect("a model"), file);
    let schema: Value = serde_json::from_str(SCHEMA).expect("JSON");
    for entry in std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/steady")).expect("a directory") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            continue;
        }
        let text = std::fs::read_to_string(path).expect("a text");
        let value: Value = serde_json::from_str(&text).expect("JSON");
        assert!(valid(&schema, &schema, &value), "{value}");
        assert!(SteadyModel::parse(&text).is_ok());
    }
}
