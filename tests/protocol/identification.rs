//! The documents of `identify`: schema and reader agree about them.

use exact_kalman::protocol::Identification;
use serde_json::{Value, json};

use crate::samples::with;
use crate::schema::valid;

const SCHEMA: &str = include_str!("../../schema/identification.schema.json");

fn agree(value: &Value, expected: bool) {
    let schema: Value = serde_json::from_str(SCHEMA).expect("JSON");
    assert_eq!(valid(&schema, &schema, value), expected, "schema: {value}");
    assert_eq!(Identification::parse(&value.to_string()).is_ok(), expected, "reader: {value}");
}

fn moments() -> Value {
    json!({"format": "exact-kalman/identification/1", "numbers": "exact", "moments": {
        "readings": [["1/2"], [2], [0.25]], "residuals": "predictive",
        "adaptive_filter": {"mean": ["1"], "covariance": [[1e3]], "repair": "last semidefinite"}}})
}

fn least_squares() -> Value {
    json!({"format": "exact-kalman/identification/1", "least_squares": {
        "output_lags": 1, "input_lags": 1, "mean": [0, "0"], "covariance": [[1, 0], [0, 1]], "noise": 1.5,
        "outputs": [1, 2], "inputs": [3], "earlier_outputs": [-1], "earlier_inputs": ["2"]}})
}

#[test]
fn schema_and_reader_agree() {
    for (document, pointers) in
        [(moments(), &["", "/moments", "/moments/adaptive_filter"][..]), (least_squares(), &["", "/least_squares"])]
    {
        agree(&document, true);
        for pointer in pointers {
            let object = document.pointer(pointer).and_then(Value::as_object).expect("an object");
            for key in object.keys() {
                let optional = ["numbers", "residuals", "repair", "adaptive_filter", "input_lags", "inputs"];
                let may_lack = optional.contains(&key.as_str()) || key.starts_with("earlier");
                let mut less = document.clone();
                less.pointer_mut(pointer).and_then(Value::as_object_mut).expect("an object").remove(key);
                agree(&less, may_lack);
                for other in [json!(null), json!(true), json!({"a": 1}), json!([[["1"]]]), json!("?"), json!(-1)] {
                    let text = other.is_string() || other.is_number();
                    agree(&with(document.clone(), &format!("{pointer}/{key}"), other), key == "noise" && text);
                }
            }
            agree(&with(document.clone(), &format!("{pointer}/unknown"), json!("x")), false);
        }
    }
}

/// A document has exactly one of the two methods.
#[test]
fn one_method_is_asked_for() {
    let both = with(moments(), "/least_squares", least_squares()["least_squares"].clone());
    agree(&both, false);
    agree(&json!({"format": "exact-kalman/identification/1"}), false);
}

/// A JSON number means its decimal text, with all its digits.
#[test]
fn numbers_keep_their_digits() {
    let text = moments().to_string().replace("0.25", "0.10000000000000000000000000000001");
    let document = Identification::parse(&text).expect("a document");
    let datum = &document.moments.as_ref().expect("moments").readings[2][0];
    let value = document.numbers.value("there", datum).expect("a number");
    assert_eq!(value.denom().to_string().len(), 33);
}
