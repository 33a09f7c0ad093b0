//! The JSON Schemas against the readers: a small validator of the keywords that the schemas use.

use exact_kalman::protocol::{Answer, Case};
use exact_kalman::trace::Quantity;
use serde_json::{Value, json};

use crate::samples::{full, walk, with};

pub(crate) const CASE: &str = include_str!("../../schema/case.schema.json");
pub(crate) const ANSWER: &str = include_str!("../../schema/answer.schema.json");

/// Whether the value is valid; panics at a keyword that it does not know, so that none is silently skipped.
pub(crate) fn valid(root: &Value, schema: &Value, value: &Value) -> bool {
    let properties = |key: &str| schema["properties"].get(key);
    schema.as_object().expect("a schema").iter().all(|(keyword, rule)| match keyword.as_str() {
        "$schema" | "title" | "description" | "default" | "$defs"
        // Grammar is the readers' business; it is tested with them.
        | "pattern" | "maxLength" => true,
        "type" => match rule.as_str().expect("a type") {
            "object" => value.is_object(),
            "array" => value.is_array(),
            "string" => value.is_string(),
            "boolean" => value.is_boolean(),
            "null" => value.is_null(),
            "number" => value.is_number(),
            "integer" => value.is_i64() || value.is_u64(),
            other => panic!("type {other}"),
        },
        "const" => value == rule,
        "enum" => rule.as_array().expect("a list").contains(value),
        "minLength" => value.as_str().is_none_or(|text| text.chars().count() as u64 >= rule.as_u64().expect("a length")),
        "minimum" => value.as_i64().is_none_or(|number| number >= rule.as_i64().expect("an integer")),
        "required" => value.as_object().is_none_or(|object| {
            rule.as_array().expect("a list").iter().all(|key| object.contains_key(key.as_str().expect("a key")))
        }),
        "properties" => value.as_object().is_none_or(|object| {
            object.iter().all(|(key, item)| properties(key).is_none_or(|rule| valid(root, rule, item)))
        }),
        "additionalProperties" => value.as_object().is_none_or(|object| {
            let others = object.iter().filter(|(key, _)| properties(key).is_none());
            others.into_iter().all(|(_, item)| rule.is_object() && valid(root, rule, item))
        }),
        "items" => value.as_array().is_none_or(|list| list.iter().all(|item| valid(root, rule, item))),
        "anyOf" => rule.as_array().expect("a list").iter().any(|rule| valid(root, rule, value)),
        "oneOf" => {
            rule.as_array().expect("a list").iter().filter(|rule| valid(root, rule, value)).count() == 1
        }
        "minItems" => value.as_array().is_none_or(|list| list.len() as u64 >= rule.as_u64().expect("a length")),
        "$ref" => {
            let pointer = rule.as_str().and_then(|text| text.strip_prefix('#')).expect("a local reference");
            valid(root, root.pointer(pointer).expect("the definition"), value)
        }
        other => panic!("keyword {other}"),
    })
}

fn check(schema: &str, value: &Value) -> bool {
    let schema: Value = serde_json::from_str(schema).expect("JSON");
    valid(&schema, &schema, value)
}

/// Schema and reader agree about a document.
fn agree_on_case(value: &Value, expected: bool) {
    assert_eq!(check(CASE, value), expected, "schema: {value}");
    assert_eq!(Case::parse(&value.to_string()).is_ok(), expected, "reader: {value}");
}

fn agree_on_answer(value: &Value, expected: bool) {
    assert_eq!(check(ANSWER, value), expected, "schema: {value}");
    assert_eq!(Answer::parse(&value.to_string()).is_ok(), expected, "reader: {value}");
}

#[test]
fn cases() {
    agree_on_case(&full(), true);
    agree_on_case(&walk(), true);
    let factors = json!({"process_factor": [["1"]], "observation_factor": [[["1"]], null]});
    agree_on_case(&with(walk(), "/noise", factors), true);
    // Every key, left out or of another type.
    for pointer in ["", "/initial", "/noise", "/input", "/observation_input"] {
        let keys: Vec<String> = full()
            .pointer(pointer)
            .expect("a place in the document")
            .as_object()
            .expect("an object")
            .keys()
            .cloned()
            .collect();
        for key in keys {
            let mut less = full();
            less.pointer_mut(pointer)
                .expect("a place in the document")
                .as_object_mut()
                .expect("an object")
                .remove(&key);
            agree_on_case(&less, check(CASE, &less));
            for other in [json!(null), json!(1), json!(true), json!({"a": 1}), json!([[[["1"]]]]), json!("?")] {
                let changed = with(full(), &format!("{pointer}/{key}"), other);
                agree_on_case(&changed, check(CASE, &changed));
            }
        }
        agree_on_case(&with(full(), &format!("{pointer}/unknown"), json!("x")), false);
    }
    for (pointer, value) in [
        ("/transition", json!([["1"], null])),
        ("/transition", json!([["1"], [["1"]]])),
        ("/transition", json!([[null]])),
        ("/transition", json!([[[]], ["1"]])),
        ("/input/vector", json!([[], "1"])),
        ("/transition", json!([1])),
        ("/input/vector", json!(["1", ["1"]])),
        ("/input/vector", json!(["1", null])),
        ("/observations", json!([["1"], [["1"]]])),
        ("/observations", json!([1])),
        ("/rules", json!({"a": 1})),
    ] {
        agree_on_case(&with(full(), pointer, value), false);
    }
    for (pointer, value) in [
        ("/transition", json!([])),
        ("/transition", json!([[], []])),
        ("/transition", json!([null, [], [["1"]]])),
        ("/input/vector", json!([null, [], ["1"]])),
        ("/observations", json!([])),
        ("/observations", json!([[], null, [null]])),
    ] {
        agree_on_case(&with(full(), pointer, value), true);
    }
}

#[test]
fn answers() {
    let answer = json!({"id": "a", "outcome": "answered", "numbers": "exact", "step": 0, "message": "", "steps": [{}]});
    agree_on_answer(&answer, true);
    for key in ["id", "outcome", "numbers", "step", "message", "steps"] {
        let mut less = answer.clone();
        less.as_object_mut().expect("an object").remove(key);
        agree_on_answer(&less, check(ANSWER, &less));
        for other in [json!(null), json!(-1), json!(true), json!({}), json!([1]), json!("?")] {
            let changed = with(answer.clone(), &format!("/{key}"), other);
            agree_on_answer(&changed, check(ANSWER, &changed));
        }
    }
    let keys = Quantity::ALL.map(Quantity::name);
    for key in keys.into_iter().chain(["ahead", "unknown"]) {
        for value in [
            json!(null),
            json!("1"),
            json!(1.5),
            json!(["1", 2]),
            json!([["1", 2]]),
            json!([[["1"]]]),
            json!([null]),
            json!([[null]]),
            json!([]),
            json!([[]]),
            json!({}),
            json!([{}]),
        ] {
            let changed = with(answer.clone(), &format!("/steps/0/{key}"), value);
            agree_on_answer(&changed, check(ANSWER, &changed));
        }
    }
    let law = json!({"mean": ["1", 2], "covariance": [["1", 2], ["3", "4"]]});
    agree_on_answer(&with(answer.clone(), "/steps/0/ahead", json!([null, law])), true);
    for (pointer, value) in [
        ("", json!([])),
        ("/mean", json!("1")),
        ("/mean", json!(null)),
        ("/covariance", json!(["1"])),
        ("/gain", json!([])),
    ] {
        let changed = if pointer.is_empty() { value } else { with(law.clone(), pointer, value) };
        agree_on_answer(&with(answer.clone(), "/steps/0/ahead", json!([changed])), false);
    }
}
