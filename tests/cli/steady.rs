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

/// Noise of "variance" −2/3 is none, yet 2 = 4·2 − 16/3 − 2/3 is a solution with the closed loop 2/3: by hand. Nobody reads of weights there.
#[test]
fn noise_that_is_no_covariance_is_named() {
    let model = json!({
        "format": "exact-kalman/steady/1", "id": "negative", "about": "", "timing": "departing",
        "transition": [["2"]], "observation": [["1"]], "noise": {"process": [["-2/3"]], "observation": [["1"]]},
    });
    let out = feed(&["steady", "-"], &model.to_string()).quietly(0);
    assert!(out.contains("predicted covariance     2\n"), "{out}");
    assert!(out.contains("The noise is no covariance: its joint matrix is indefinite; that the predicted"), "{out}");
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

fn model(transition: &Value, observation: &Value, process: &Value, noise: &Value) -> String {
    json!({"format": "exact-kalman/steady/1", "id": "m", "timing": "departing", "transition": transition, "observation": observation,
        "noise": {"process": process, "observation": noise}})
    .to_string()
}

/// With A = H = R = 1 and Q = 10³⁰⁰ all but one part in 10³⁰⁰ of the variance goes: the filtered one is 1 − 10⁻³⁰⁰ and a little, and
/// its digits count. What a reading without noise tells is exactly zero.
#[test]
fn digits_of_the_filtered_covariance_count() {
    let huge = model(&json!([[1]]), &json!([[1]]), &json!([["1e300"]]), &json!([[1]]));
    let out = feed(&["steady", "-"], &huge).quietly(0);
    assert!(out.contains("filtered covariance      1\n"), "{out}");
    let ran = feed(&["steady", "-", "--most-bits", "256"], &huge);
    assert_eq!(ran.code, 3, "{}", ran.stdout);
    assert!(ran.stdout.contains("Not told from zero: the filtered variance of state 0"), "{}", ran.stdout);
    let told = model(&json!([[1, 1], [0, 1]]), &json!([[1, 0]]), &json!([[1, 0], [0, 1]]), &json!([[0]]));
    let out = feed(&["steady", "-"], &told).quietly(0);
    // By hand: with R = 0 the variance left is p = (1 + √5)/2 of the other state, p² = p + 1.
    assert!(out.contains("filtered covariance      [[0, 0], [0, 1.6180339887498948]]"), "{out}");
    assert!(!out.contains("Not told"), "{out}");
}

/// Numbers that lie far apart are given bits of that order before the search is given up: s = A² + Q and a little, A = 10⁴⁰⁰⁰.
#[test]
fn more_bits_help_where_numbers_lie_far_apart() {
    let far = model(&json!([["1e4000"]]), &json!([[1]]), &json!([["1e-300"]]), &json!([[1]]));
    assert_eq!(feed(&["steady", "-"], &far).code, 3);
    let out = feed(&["steady", "-", "--most-bits", "65536"], &far).quietly(0);
    assert!(out.contains("predicted covariance     1e8000\n"), "{out}");
}

/// A sensor that repeats another is left out, and the certificate says so; one that says something may not be.
#[test]
fn certificates_know_of_repeated_sensors() {
    let directory = Directory::new();
    let file = directory.file("twice.json", "");
    let twice = model(&json!([[1]]), &json!([[1], [2]]), &json!([[1]]), &json!([[1, 2], [2, 4]]));
    let out = feed(&["steady", "-", "--certificate", &file], &twice).quietly(0);
    assert!(out.ends_with("Used is sensor 0; what is left out repeats that, noise included\n"), "{out}");
    let _ = run(&["verify", &file]).quietly(0);
    let text = std::fs::read_to_string(&file).expect("a certificate");
    let mut document = exact_kalman::verify::SteadyDocument::parse(&text).expect("with a digest");
    for noise in ["5", "3"] {
        document.model["noise"]["observation"][1][1] = json!(noise);
        std::fs::write(&file, document.to_line()).expect("a writable directory");
        let ran = run(&["verify", &file]);
        assert_eq!(ran.code, 1, "{}", ran.stderr);
        assert!(format!("{}{}", ran.stdout, ran.stderr).contains("say something that the others do not"), "{ran:?}");
    }
}

/// The text would say one thing to those who read the first member, and another to those who read the last.
#[test]
fn a_certificate_whose_model_says_two_things_is_refused() {
    let directory = Directory::new();
    let file = directory.file("walk.json", "");
    let walk = model(&json!([[1]]), &json!([[1]]), &json!([[1]]), &json!([[1]]));
    let _ = feed(&["steady", "-", "--certificate", &file], &walk).quietly(0);
    let text = std::fs::read_to_string(&file).expect("a certificate");
    let twice = text.replacen("\"transition\":", "\"transition\":[[\"7\"]],\"transition\":", 1);
    assert_ne!(twice, text);
    std::fs::write(&file, twice).expect("a writable directory");
    let ran = run(&["verify", &file]);
    assert!(ran.code == 1 && ran.stdout.contains("`transition` stands twice"), "{ran:?}");
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
