//! Cases that the tests start from, as text: none of it is written by the code under test.

use serde_json::{Value, json};

/// A valid case with one of everything; two states, one sensor, three readings.
pub(crate) fn full() -> Value {
    json!({
        "format": "exact-kalman/case/1",
        "id": "sample/full",
        "about": "One of everything.",
        "numbers": "binary64",
        "expect": "estimate",
        "flags": ["time-varying"],
        "timing": "departing",
        "initial": {"before": "observation", "mean": ["0", "1"], "covariance": [["2", "0.5"], ["0.5", "1"]],
            "diffuse": [["1", "0"], ["0", "0"]]},
        "transition": [[["1", "1"], ["0", "1"]], [["1", "0.5"], ["0", "1"]], null],
        "observation": [["1", "0"]],
        "noise": {"process": [["1", "0"], ["0", "1"]], "cross": [["0.5"], ["0"]], "observation": [["1"]]},
        "input": {"matrix": [["1"], ["2"]], "vector": [["3"], ["4"], null]},
        "observation_input": {"vector": ["0.25"]},
        "rules": {"transition": "sampling interval"},
        "observations": [["1120"], null, ["-3.5e2"]]
    })
}

/// A random walk: one state, one sensor, two readings.
pub(crate) fn walk() -> Value {
    json!({
        "format": "exact-kalman/case/1", "id": "walk", "timing": "departing",
        "initial": {"before": "observation", "mean": ["0"], "covariance": [["1"]]},
        "transition": [["1"]], "observation": [["1"]],
        "noise": {"process": [["1"]], "observation": [["1"]]},
        "observations": [["1"], ["3"]]
    })
}

/// The sample with the value at a JSON pointer replaced; a key that is not there is added.
pub(crate) fn with(mut sample: Value, pointer: &str, value: Value) -> Value {
    if let Some(place) = sample.pointer_mut(pointer) {
        *place = value;
        return sample;
    }
    let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
    let parent = sample.pointer_mut(parent).and_then(Value::as_object_mut).expect("an object");
    parent.insert(key.to_owned(), value);
    sample
}
