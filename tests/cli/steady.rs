//! `steady`: digits, refusals and certificates of the examples.

use serde_json::{Value, json};

use crate::program::{Directory, feed, run};

fn found(file: &str, more: &[&str], code: i32) -> Value {
    let words: Vec<&str> = ["steady", file, "--format", "json"].iter().chain(more).copied().collect();
    serde_json::from_str(&run(&words).quietly(code)).expect("one object")
}

fn entry(found: &Value, pointer: &str) -> String {
    found.pointer(pointer).and_then(Value::as_str).unwrap_or_else(|| panic!("{pointer} in {found}")).to_owned()
}

/// s² = q s + q, so s = (q + √(q² + 4q))/2 for q = 1e-30 is 1e-15 + 5e-31 + 1.25e-46 + …, by its series.
#[test]
fn a_walk_that_hardly_moves_by_hand() {
    let found = found("examples/steady/walk.json", &["--digits", "32"], 0);
    assert_eq!(entry(&found, "/matrices/predicted_covariance/value/0/0"), "1.0000000000000005000000000000001e-15");
    assert_eq!(found["verdict"], "stabilising");
    assert_eq!(found["matrices"]["predicted_covariance"]["within"], json!([[null]]));
}

/// The feedback of a cart: X = [[5, 1], [1, 9/20]] and F = [8, 4] solve the equation, by hand.
#[test]
fn a_regulator_by_hand() {
    let out = run(&["steady", "examples/steady/regulator.json"]).quietly(0);
    for line in ["solution X               [[5, 1], [1, 0.45]]", "feedback F               [[8, 4]]"] {
        assert!(out.contains(line), "{out}");
    }
}

#[test]
fn a_level_that_nothing_moves_has_no_steady_state() {
    let out = run(&["steady", "examples/steady/level.json"]).quietly(1);
    assert!(out.contains("There is no stabilising solution: no noise reaches the eigenvalue 1"), "{out}");
    assert_eq!(found("examples/steady/level.json", &[], 1)["verdict"], "absent");
}

#[test]
fn the_other_examples_are_proved_and_cases_are_read() {
    for file in ["radar", "triple", "hidden"] {
        let found = found(&format!("examples/steady/{file}.json"), &["--digits", "30"], 0);
        assert!(found["digits"].as_u64().is_some_and(|digits| digits >= 30), "{found}");
    }
    assert_eq!(found("examples/cases/nile.json", &[], 0)["verdict"], "stabilising");
}

#[test]
fn certificates_are_written_where_something_is_proved() {
    let directory = Directory::new();
    let file = directory.file("certificate.json", "");
    let path = file.as_str();
    for (model, code, verdict) in [("radar", 0, "stabilising"), ("level", 1, "unreachable")] {
        let _ = run(&["steady", &format!("examples/steady/{model}.json"), "--certificate", path]).quietly(code);
        let text = std::fs::read_to_string(&file).expect("a certificate");
        let document = exact_kalman::verify::SteadyDocument::parse(&text).expect("with a digest");
        assert!(text.contains(&format!("\"verdict\":\"{verdict}\"")), "{text}");
        assert_eq!(document.model["id"], model);
    }
}

#[test]
fn bad_documents_are_refused_with_their_place() {
    let model = |change: &dyn Fn(&mut Value)| {
        let text = std::fs::read_to_string("examples/steady/radar.json").expect("an example");
        let mut value: Value = serde_json::from_str(&text).expect("JSON");
        change(&mut value);
        value.to_string()
    };
    let refused = |text: &str, place: &str| {
        let talk = feed(&["steady", "-"], text).trouble();
        assert!(talk.contains(place), "{talk}");
    };
    refused(&model(&|value| value["noise"]["process"][0][1] = json!("7")), "noise.process: not symmetric");
    refused(&model(&|value| value["transition"][1] = json!(["1"])), "transition[1]");
    refused(&model(&|value| value["format"] = json!("x")), "format");
    refused(&model(&|value| value["control"] = json!({"a": [], "b": [], "q": [], "r": []})), "give either");
    refused("[]", "an object is expected");
}
