//! The document of `estimate` against its schema and its page.

use exact_kalman::protocol::EstimateCase;
use serde_json::{Value, json};

use crate::samples::with;
use crate::schema::valid;

const SCHEMA: &str = include_str!("../../schema/estimate.schema.json");
const PAGE: &str = include_str!("../../docs/ESTIMATE.md");
const EXAMPLES: [&str; 2] =
    [include_str!("../../examples/estimate/coin.json"), include_str!("../../examples/estimate/slab.json")];

fn agree(value: &Value, expected: bool) {
    let schema: Value = serde_json::from_str(SCHEMA).expect("JSON");
    assert_eq!(valid(&schema, &schema, value), expected, "schema: {value}");
    let read = EstimateCase::parse(&value.to_string());
    assert_eq!(read.is_ok(), expected, "reader: {value}: {read:?}");
}

#[test]
fn schema_and_reader_agree() {
    for example in EXAMPLES {
        let value: Value = serde_json::from_str(example).expect("JSON");
        agree(&value, true);
        let object = value.as_object().expect("an object");
        for key in object.keys() {
            let mut less = value.clone();
            less.as_object_mut().expect("an object").remove(key);
            agree(&less, ["about", "numbers"].contains(&key.as_str()));
            for other in [json!(null), json!(1), json!({"x": "1"})] {
                agree(&with(value.clone(), &format!("/{key}"), other), false);
            }
        }
        for (pointer, other, expected) in [
            ("/initial_law/0/weight", json!(0.5), false),
            ("/initial_law/0/weight", json!("not a number"), true),
            ("/initial_law", json!([]), false),
            ("/initial_law/0/mean", json!("1"), false),
            ("/initial_law/0", json!({"weight": "1"}), false),
            ("/initial_law/0", json!({"weight": "1", "mean": ["1"], "covariance": null}), false),
            ("/initial_law/0", json!({"weight": "1", "mean": ["1"], "variance": "1"}), false),
            ("/format", json!("exact-kalman/case/1"), false),
            ("/observations", json!([null, [null]]), true),
        ] {
            agree(&with(value.clone(), pointer, other), expected);
        }
    }
}

#[test]
fn the_page_shows_the_example() {
    let block = PAGE.split("```json\n").nth(1).and_then(|rest| rest.split("```").next()).expect("a block");
    assert_eq!(block, EXAMPLES[0]);
}
