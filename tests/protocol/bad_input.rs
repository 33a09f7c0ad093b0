//! Bad cases: each is refused with its place, what is wrong, and where it helps the way out.

use exact_kalman::matrix::Matrix;
use exact_kalman::model::ModelError;
use exact_kalman::protocol::{Case, CaseError, short_witness};
use exact_kalman::scalar::{Rational, ratio};
use serde_json::{Value, json};

use crate::samples::{full, walk, with};

/// The message with which a text is refused, at whichever stage.
fn refusal(text: &str) -> String {
    let result = Case::parse(text).and_then(|case| case.problem()).and_then(|problem| problem.realised());
    result.map(drop).expect_err(text).to_string()
}

/// The sample with one value replaced is refused at that path with these words.
fn refused(sample: Value, pointer: &str, value: Value, path: &str, words: &[&str]) {
    let message = refusal(&with(sample, pointer, value).to_string());
    assert!(message.starts_with(&format!("{path}: ")), "{message}\nexpected at {path}");
    for word in words {
        assert!(message.contains(word), "{message}\nexpected «{word}»");
    }
}

#[test]
fn literals() {
    let place = "noise.process[3][1][0]";
    let process = json!([null, null, null, [["1", "0"], ["X", "1"]]]);
    for (literal, words) in [
        ("abc", vec!["\"abc\"", "not a number", "0.1"]),
        ("NaN", vec!["not a finite number", "null"]),
        ("Infinity", vec!["not a finite number"]),
        ("-Infinity", vec!["not a finite number"]),
        ("1e999", vec!["not a finite number", "overflows binary64"]),
        ("1e999999999", vec!["not a finite number"]),
        ("1/3", vec!["fraction", "\"exact\""]),
        ("", vec!["not a number"]),
    ] {
        let process = with(process.clone(), "/3/1/0", literal.into());
        refused(full(), "/noise/process", process, place, &words);
    }
    refused(full(), "/observations/2/0", "NaN".into(), "observations[2][0]", &["not a finite number"]);
    refused(full(), "/input/vector/1/0", "x".into(), "input.vector[1][0]", &["not a number"]);
    refused(full(), "/observation_input/vector/0", "x".into(), "observation_input.vector[0]", &["not a number"]);
    refused(full(), "/initial/diffuse/1/0", "x".into(), "initial.diffuse[1][0]", &["not a number"]);
    let exact = with(walk(), "/numbers", "exact".into());
    refused(exact.clone(), "/transition/0/0", "1e999999999".into(), "transition[0][0]", &["exponent", "4096"]);
    refused(exact, "/transition/0/0", "1/0".into(), "transition[0][0]", &["denominator 0"]);
    let single = with(walk(), "/numbers", "binary32".into());
    refused(single, "/transition/0/0", "1e39".into(), "transition[0][0]", &["overflows binary32"]);
}

#[test]
fn a_literal_of_ten_million_digits_is_refused_at_once() {
    let start = std::time::Instant::now();
    let long: Value = "1".repeat(10_000_000).into();
    let words = ["10000000 characters", "4096"];
    refused(walk(), "/transition/0/0", long.clone(), "transition[0][0]", &words);
    refused(with(walk(), "/numbers", "exact".into()), "/transition/0/0", long, "transition[0][0]", &words);
    assert!(start.elapsed().as_secs() < 3);
}

#[test]
fn numbers_travel_as_strings() {
    let words = ["numbers travel as strings", "write \"0.1\"", "JSON number 0.1"];
    refused(walk(), "/transition/0/0", json!(0.1), "transition[0][0]", &words);
    refused(walk(), "/initial/mean/0", json!(0.1), "initial.mean[0]", &words);
    refused(walk(), "/observations/1/0", json!(0.1), "observations[1][0]", &words);
    refused(full(), "/input/vector/1/0", json!(0.1), "input.vector[1][0]", &words);
    refused(full(), "/transition/1/0/1", json!(0.1), "transition[1][0][1]", &words);
    let minus = &["numbers travel as strings", "write \"-3\""];
    refused(walk(), "/observations/1/0", json!(-3), "observations[1][0]", minus);
}

#[test]
fn wrong_types() {
    refused(walk(), "/transition", json!("1"), "transition", &["matrix"]);
    refused(walk(), "/transition", json!(["1"]), "transition[0]", &["a string", "row"]);
    refused(walk(), "/transition", json!([["1"], "1"]), "transition[1]", &["a string", "row"]);
    refused(walk(), "/transition", json!([["1"], [["1"]]]), "transition[1][0]", &["a list", "number"]);
    refused(walk(), "/transition", json!([["1"], null]), "transition[1]", &["null"]);
    refused(walk(), "/transition", json!([null, ["1"]]), "transition[1][0]", &["a string"]);
    refused(walk(), "/transition", json!([[["1", null]]]), "transition[0][0][1]", &["null"]);
    refused(walk(), "/transition", json!([[[["1"]]]]), "transition[0][0][0]", &["a list"]);
    refused(walk(), "/transition", json!([[{"1": 2}]]), "transition[0][0].1", &["map"]);
    refused(walk(), "/transition", json!([[true]]), "transition[0][0]", &["boolean"]);
    refused(full(), "/input/vector", json!(["1", ["1"]]), "input.vector[1]", &["a list"]);
    refused(walk(), "/initial/mean", json!([["0"]]), "initial.mean[0]", &["sequence"]);
    refused(walk(), "/initial/mean", json!([null]), "initial.mean[0]", &["null", "number as a string"]);
    refused(walk(), "/timing", json!("sideways"), "timing", &["sideways", "arriving", "departing"]);
    refused(walk(), "/numbers", json!("float"), "numbers", &["float", "binary64", "exact"]);
    refused(walk(), "/format", json!("exact-kalman/case/2"), "format", &["exact-kalman/case/1"]);
    refused(walk(), "/id", json!(7), "id", &["string"]);
    refused(walk(), "/flags", json!([1]), "flags[0]", &["string"]);
    refused(walk(), "/input", Value::Null, "input", &["null"]);
    refused(walk(), "/noise", json!({"process": [["1"]]}), "noise", &["`process` and `observation`"]);
    let mixed = json!({"process": [["1"]], "observation_factor": [["1"]]});
    refused(walk(), "/noise", mixed, "noise", &["`process_factor` and `observation_factor`"]);
}

#[test]
fn unknown_and_duplicate_keys() {
    refused(walk(), "/initial/men", json!(["0"]), "initial.men", &["unknown field `men`", "`mean`"]);
    refused(walk(), "/noise/Q", json!([["1"]]), "noise.Q", &["unknown field `Q`"]);
    refused(walk(), "/comment", json!("x"), "comment", &["unknown field `comment`"]);
    let line = walk().to_string();
    let twice = line.replacen("\"id\":\"walk\"", "\"id\":\"walk\",\"id\":\"other\"", 1);
    assert!(refusal(&twice).contains("duplicate field `id`"));
    let inner = line.replacen("\"mean\":", "\"mean\":[\"5\"],\"mean\":", 1);
    assert!(refusal(&inner).starts_with("initial") && refusal(&inner).contains("duplicate field `mean`"));
    let rules = with(walk(), "/rules", json!({"RULE": "x"})).to_string();
    let rules = rules.replace("\"RULE\":\"x\"", "\"a\":\"x\",\"a\":\"y\"");
    assert!(
        refusal(&rules).starts_with("rules") && refusal(&rules).contains("duplicate key `a`"),
        "{}",
        refusal(&rules)
    );
    let mut missing = walk();
    missing.as_object_mut().expect("an object").remove("timing");
    assert!(refusal(&missing.to_string()).contains("missing field `timing`"));
}

#[test]
fn not_one_document() {
    let line = full().to_string();
    for end in [0, 1, 20, line.len() / 2, line.len() - 1] {
        assert!(refusal(&line[..end]).contains("EOF"), "{end}");
    }
    assert!(refusal(&format!("{line}{line}")).contains("trailing characters"));
    assert!(refusal("[]").contains("Case"), "{}", refusal("[]"));
    let deep = format!("{{\"format\":{}", "[".repeat(1_000_000));
    assert!(!refusal(&deep).is_empty());
    let deep = line.replacen("\"vector\":[\"0.25\"]", &format!("\"vector\":{}", "[".repeat(1_000_000)), 1);
    assert!(refusal(&deep).contains("a list") || refusal(&deep).contains("recursion"), "{}", refusal(&deep));
    let huge = " ".repeat((64 << 20) + 1);
    assert!(matches!(Case::parse(&huge), Err(CaseError::TooLong { bytes }) if bytes == huge.len()));
    assert!(refusal(&huge).contains("67108864"));
}

#[test]
fn shapes() {
    refused(
        walk(),
        "/transition",
        json!([["1"], ["1", "2"]]),
        "transition",
        &["row 1 has 2 entries where row 0 has 1"],
    );
    let ragged = json!([[["1"]], [["1"], []]]);
    refused(walk(), "/transition", ragged, "transition[1]", &["row 1 has 0 entries"]);
    refused(walk(), "/initial/covariance", json!([["1"], []]), "initial.covariance", &["row 1"]);
    let wide = json!([["1", "0"]]);
    refused(walk(), "/transition", wide.clone(), "transition", &["1×2", "1×1", "states: 1, sensors: 1"]);
    refused(walk(), "/observation", wide.clone(), "observation", &["1×2", "1×1"]);
    refused(walk(), "/noise/process", wide.clone(), "noise.process", &["1×2", "1×1"]);
    refused(walk(), "/noise/observation", wide.clone(), "noise.observation", &["1×2", "1×1"]);
    refused(walk(), "/initial/covariance", wide, "initial.covariance", &["1×2", "1×1"]);
    refused(walk(), "/observations", json!([["1"], ["1", "2"]]), "observations", &["2×1", "step 1"]);
    refused(walk(), "/transition", json!([[["1"]]]), "transition", &["1 steps", "2 observations"]);
    refused(walk(), "/observation", json!([[["1"]], null]), "observation", &["null", "step 1"]);
    refused(walk(), "/initial/mean", json!([]), "initial.mean", &["empty"]);
    refused(walk(), "/observations", json!([]), "observations", &["empty"]);
    refused(walk(), "/observations", json!([[], []]), "observations", &["empty"]);
    refused(walk(), "/initial/before", json!("transition"), "initial.before", &["departing"]);
}

#[test]
fn an_asymmetric_covariance_names_both_entries() {
    let skew = json!([["2", "0.5"], ["0.25", "1"]]);
    refused(full(), "/initial/covariance", skew.clone(), "initial.covariance", &["(0, 1)", "(1, 0)", "symmetrise"]);
    refused(full(), "/noise/process", skew, "noise.process", &["not symmetric", "step 0"]);
}

/// The vector printed in a message, read without the code under test.
fn printed_vector(message: &str) -> Vec<Rational> {
    let list = message.split("v = [").nth(1).and_then(|rest| rest.split(']').next()).expect(message);
    list.split(", ").map(decimal).collect()
}

/// A decimal, by the definition.
fn decimal(text: &str) -> Rational {
    let (digits, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let integer: i64 = format!("{whole}{fraction}").parse().expect(text);
    let places = exponent.parse::<i32>().expect(text) - i32::try_from(fraction.len()).expect("few");
    ratio(integer, 1) * ratio(10, 1).pow(places)
}

/// vᵀPv, by the double sum.
fn form(matrix: &[Vec<Rational>], v: &[Rational]) -> Rational {
    let mut sum = ratio(0, 1);
    for (i, row) in matrix.iter().enumerate() {
        for (j, entry) in row.iter().enumerate() {
            sum += entry * &v[i] * &v[j];
        }
    }
    sum
}

#[test]
fn an_indefinite_covariance_comes_with_a_short_vector() {
    // The second is (1, 1.2345)(1, 1.2345)ᵀ less 1e−9 in a corner: a vector of few digits proves nothing.
    for rows in [[["80", "500"], ["500", "80"]], [["1", "1.2345"], ["1.2345", "1.523990249"]]] {
        let sample = with(with(full(), "/numbers", "exact".into()), "/initial/covariance", json!(rows));
        let message = refusal(&sample.to_string());
        assert!(
            message.starts_with("initial.covariance: ") && message.contains("not positive semidefinite"),
            "{message}"
        );
        let matrix: Vec<Vec<Rational>> =
            rows.iter().map(|row| row.iter().map(|text| decimal(text)).collect()).collect();
        let vector = printed_vector(&message);
        let value = form(&matrix, &vector);
        assert!(value < ratio(0, 1), "{message}");
        // The printed value is right to its three digits.
        let printed =
            decimal(message.split("vᵀPv = ").nth(1).expect("it is printed").split(' ').next().expect("at least one"));
        let error = (&printed - &value) / &value;
        assert!(&error * &error <= ratio(1, 10_000), "{message}");
        assert!(message.len() < 200, "{message}");
    }
}

#[test]
fn a_joint_noise_that_is_impossible_is_refused() {
    let words = ["joint noise", "not positive semidefinite", "v = ["];
    refused(full(), "/noise/cross", json!([["1"], ["0.5"]]), "noise", &words);
    let message = refusal(&with(full(), "/noise/cross", json!([["1"], ["0.5"]])).to_string());
    let rational = |value: i64| ratio(value, 2);
    let joint: Vec<Vec<Rational>> =
        [[2, 0, 2], [0, 2, 1], [2, 1, 2]].iter().map(|row| row.iter().copied().map(rational).collect()).collect();
    assert!(form(&joint, &printed_vector(&message)) < ratio(0, 1), "{message}");
}

#[test]
fn the_override_lets_an_indefinite_start_pass() {
    let sample = with(full(), "/initial/covariance", json!([["80", "500"], ["500", "80"]]));
    let sample = with(sample, "/initial/allow_indefinite", json!(true));
    // Not beside a diffuse part, whose limit needs a semidefinite covariance.
    assert!(refusal(&sample.to_string()).contains("has a diffuse part"));
    let mut sample = sample;
    sample["initial"].as_object_mut().expect("an object").remove("diffuse");
    assert!(
        Case::parse(&sample.to_string()).expect("a sound case").problem().expect("a sound case").realised().is_ok()
    );
}

#[test]
fn short_witnesses_prove_what_long_ones_prove() {
    let mut state = 12345_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ratio(i64::try_from(state >> 40).expect("small") - (1 << 23), 1 << 20)
    };
    let mut found = 0;
    for _ in 0..200 {
        let lower: Vec<Rational> = (0..6).map(|_| random()).collect();
        let index = |i: usize, j: usize| i.max(j) * (i.max(j) + 1) / 2 + i.min(j);
        let matrix = Matrix::from_fn(3, 3, |i, j| lower[index(i, j)].clone());
        let rows: Vec<Vec<Rational>> = (0..3).map(|i| matrix.row(i).to_vec()).collect();
        if let Err(exact_kalman::matrix::LdlError::Indefinite(proof)) = matrix.ldl() {
            let short = short_witness(&matrix, &proof);
            assert_eq!(form(&rows, short.witness.entries()), short.value);
            assert!(short.value < ratio(0, 1));
            found += 1;
        }
    }
    assert!(found > 50);
}

#[test]
fn model_errors_are_values() {
    let sample = with(full(), "/initial/covariance", json!([["80", "500"], ["500", "80"]]));
    let problem = Case::parse(&sample.to_string()).expect("a sound case").problem().expect("a sound case");
    let Err(CaseError::Model(error)) = problem.realised() else { panic!("indefinite") };
    assert!(matches!(*error, ModelError::Indefinite { .. }));
}
