//! The documents of `stability`: schema and reader agree about them, and refusals name the place.

use exact_kalman::protocol::StabilityModel;
use exact_kalman::scalar::ratio;
use serde_json::{Value, json};

use crate::samples::with;
use crate::schema::valid;

const SCHEMA: &str = include_str!("../../schema/stability.schema.json");

fn agree(value: &Value, expected: bool) {
    let schema: Value = serde_json::from_str(SCHEMA).expect("JSON");
    assert_eq!(valid(&schema, &schema, value), expected, "schema: {value}");
    assert_eq!(StabilityModel::parse(&value.to_string()).is_ok(), expected, "reader: {value}");
}

/// Every key, but `probabilities`, which `chain` excludes.
fn full() -> Value {
    json!({"format": "exact-kalman/stability/1", "id": "a", "about": "b", "numbers": "exact",
        "transition": [[2]], "observation": [["1"]], "process_noise": [[1]], "observation_noise": [["1/2"]],
        "modes": [
            {"name": "lost", "observation": [[0]]},
            {"name": "seen", "transition": [[3]], "observation": [[1], [2]], "process_noise": [[4]],
             "observation_noise": [[1, 0], [0, 1]]}],
        "chain": {"initial": [1, 0], "transition": [["1/4", "0.75"], [0.5, 0.5]]},
        "initial_covariance": [[7]]})
}

fn independent() -> Value {
    let mut model = with(full(), "/probabilities", json!(["1/4", "3/4"]));
    model.as_object_mut().expect("an object").remove("chain");
    model
}

#[test]
fn schema_and_reader_agree() {
    agree(&full(), true);
    agree(&independent(), true);
    let required = ["format", "id", "modes", "chain", "name", "initial"];
    for pointer in ["", "/modes/0", "/modes/1", "/chain"] {
        let document = full();
        for key in document.pointer(pointer).and_then(Value::as_object).expect("an object").keys() {
            let may_lack = !required.contains(&key.as_str()) && pointer != "/chain";
            let mut less = full();
            less.pointer_mut(pointer).and_then(Value::as_object_mut).expect("an object").remove(key);
            agree(&less, may_lack);
            for other in [json!(null), json!(true), json!({"a": 1}), json!([[["1"]]]), json!(-1)] {
                agree(&with(full(), &format!("{pointer}/{key}"), other), false);
            }
        }
        agree(&with(full(), &format!("{pointer}/unknown"), json!("x")), false);
    }
    agree(&with(full(), "/probabilities", json!(["1/4", "3/4"])), false);
    agree(&with(full(), "/modes", json!([])), false);
    agree(&json!([]), false);
}

#[test]
fn a_mode_has_what_it_gives_and_what_all_share() {
    let model = StabilityModel::parse(&full().to_string()).expect("a model");
    let (lost, seen) = (model.mode(0).expect("fits"), model.mode(1).expect("fits"));
    let entries = |matrix: &exact_kalman::matrix::Matrix<_>| matrix.entries().to_vec();
    assert_eq!(entries(&lost.transition), [ratio(2, 1)]);
    assert_eq!(entries(&lost.observation), [ratio(0, 1)]);
    assert_eq!(entries(&lost.process_noise), [ratio(1, 1)]);
    assert_eq!(entries(&lost.observation_noise), [ratio(1, 2)]);
    assert_eq!(entries(&seen.transition), [ratio(3, 1)]);
    assert_eq!(entries(&seen.observation), [ratio(1, 1), ratio(2, 1)]);
    assert_eq!(entries(&seen.process_noise), [ratio(4, 1)]);
    let chain = model.probabilities().expect("numbers");
    assert_eq!(chain.initial, [ratio(1, 1), ratio(0, 1)]);
    assert_eq!(entries(&chain.transition), [ratio(1, 4), ratio(3, 4), ratio(1, 2), ratio(1, 2)]);
    let drawn = StabilityModel::parse(&independent().to_string()).expect("a model").probabilities().expect("numbers");
    assert_eq!(drawn.initial, [ratio(1, 4), ratio(3, 4)]);
    assert_eq!(entries(&drawn.transition), [ratio(1, 4), ratio(3, 4), ratio(1, 4), ratio(3, 4)]);
    assert_eq!(entries(&model.initial_covariance().expect("a covariance")), [ratio(7, 1)]);
}

#[test]
fn refusals_name_the_place() {
    let refused = |pointer: &str, value: Value| {
        let model = StabilityModel::parse(&with(full(), pointer, value).to_string()).expect("a document");
        let modes = (0..model.modes.len()).try_for_each(|index| model.mode(index).map(|_| ()));
        let rest = modes.and_then(|()| model.probabilities()).and_then(|_| model.initial_covariance());
        rest.expect_err("refused").to_string()
    };
    for (pointer, value, message) in [
        ("/transition", json!([]), "transition: is empty"),
        ("/transition", json!([[1, 2]]), "transition[0]: 2 numbers where 1 are needed"),
        ("/modes/1/transition", json!([[1], [2]]), "modes[1].transition: 2 rows where 1 are needed"),
        ("/modes/1/observation", json!([[1, 2]]), "modes[1].observation[0]: 2 numbers where 1 are needed"),
        ("/modes/1/observation", json!([[1]]), "modes[1].observation_noise: 2 rows where 1 are needed"),
        ("/process_noise", json!([[-1]]), "process_noise: not positive semidefinite: v = [1] has vᵀPv = -1"),
        ("/observation_noise", json!([["one"]]), "observation_noise[0][0]: \"one\" is not a number"),
        ("/chain/initial", json!([1]), "chain.initial: 1 numbers where 2 are needed"),
        ("/chain/transition", json!([[1, 0]]), "chain.transition: 1 rows where 2 are needed"),
        ("/initial_covariance", json!([[1, 0]]), "initial_covariance[0]: 2 numbers where 1 are needed"),
    ] {
        let found = refused(pointer, value);
        assert!(found.starts_with(message), "{found}");
    }
    let mut less = full();
    less.as_object_mut().expect("an object").remove("process_noise");
    let model = StabilityModel::parse(&less.to_string()).expect("a document");
    let message = model.mode(0).expect_err("nothing to take").to_string();
    assert_eq!(
        message,
        "modes[0].process_noise: is missing: give it in the mode \"lost\", or beside the modes for all"
    );
}
