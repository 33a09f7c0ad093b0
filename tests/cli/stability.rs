//! `stability`: verdicts with certificates that are checked here again, and refusals with their place.

use exact_kalman::scalar::{Rational, ratio};
use serde_json::{Value, json};

use crate::program::{feed, run};

const LINK: &str = "examples/stability/link.json";
const BURSTS: &str = "examples/stability/bursts.json";
const SENSORS: &str = "examples/stability/sensors.json";
const PLANE: &str = "examples/stability/plane.json";

fn document(path: &str) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).expect("an example")).expect("JSON")
}

fn found(arguments: &[&str], code: i32) -> Value {
    let words: Vec<&str> = ["stability"].iter().chain(arguments).chain(&["--format", "json"]).copied().collect();
    serde_json::from_str(&run(&words).quietly(code)).expect("one object")
}

fn number(text: &Value) -> Rational {
    text.as_str().and_then(|text| text.parse().ok()).unwrap_or_else(|| panic!("{text} is no fraction"))
}

/// By hand: P(1) is 9/4 + 1 or 9/4·1/2 + 1, with probabilities 1/4 and 3/4; λ_c = 1 − 4/9.
#[test]
fn a_lossy_link_by_hand() {
    let out = run(&["stability", LINK, "--steps", "1", "--moments", "2", "--exact"]).quietly(0);
    let lines: Vec<&str> = out.lines().map(str::trim).collect();
    for line in [
        "link · 2 modes, 1 state",
        "fails with windows of any length",
        "for ever lost never sees v = 1",
        "Readings that arrive with probability 3/4",
        "the mean stays bounded above the critical probability 5/9",
        "k = 1, 2 values",
        "mean   77/32",
        "worst  13/4  after lost",
    ] {
        assert!(lines.contains(&line), "{line} is not in\n{out}");
    }
    assert!(lines.iter().any(|line| line.starts_with("order 1  bounded: E (tr P(k)) ≤ ")), "{out}");
    assert!(lines.iter().any(|line| line.starts_with("order 2  unbounded: ")), "{out}");
}

/// The mean stays below the bound that the gains prove: the proof is evaluated here, with p ← a²p + n for each mode.
#[test]
fn the_gains_prove_the_bound() {
    let found = found(&[LINK, "--moments", "1", "--steps", "9", "--exact"], 0);
    let proof = &found["moments"][0]["proof"];
    let gain = |mode: usize| number(&proof["gains"][mode][0][0]);
    // A(i) = f(1 − k h), N(i) = f²k² r + q, with f = 3/2, q = r = 1, h = 0, 1.
    let f = ratio(3, 2);
    let growth = [&f * &f, &f * &f * (ratio(1, 1) - gain(1)) * (ratio(1, 1) - gain(1))];
    let noise = [0, 1].map(|mode| &f * &f * gain(mode) * gain(mode) + ratio(1, 1));
    let weights = [ratio(1, 4), ratio(3, 4)];
    let mean = |of: &[Rational; 2]| &weights[0] * &of[0] + &weights[1] * &of[1];
    let (a, n) = (mean(&growth), mean(&noise));
    assert!(a < ratio(1, 1), "{a}");
    let fixed = &n / (ratio(1, 1) - &a);
    assert!(fixed <= number(&proof["bound"]), "{fixed}");
    for step in found["steps"].as_array().expect("steps") {
        assert!(number(&step["mean"][0][0]) <= fixed, "{step}");
    }
}

/// Half of the readings arrive in both, and the moment that a fair draw keeps bounded grows when losses come in bursts.
#[test]
fn bursts_are_worse_than_fair_draws() {
    let out = run(&["stability", BURSTS]).quietly(1);
    assert!(out.contains("order 1  unbounded: at least 1.17"), "{out}");
    let mut fair = document(BURSTS);
    fair.as_object_mut().expect("an object").remove("chain");
    fair["probabilities"] = json!(["1/2", "1/2"]);
    let out = feed(&["stability", "-"], &fair.to_string()).quietly(0);
    assert!(out.contains("order 1  bounded"), "{out}");
    assert!(out.contains("critical probability 0.36\n"), "{out}");
}

/// Twenty modes have too many different Gramians to compare; all else is told.
#[test]
fn many_modes_are_told_without_a_margin() {
    let mode = |i: i64| json!({"name": format!("{i}"), "transition": [[1, 1], [0, format!("{}/{}", i + 3, i + 2)]], "observation": [[1, i]]});
    let model = json!({"format": "exact-kalman/stability/1", "id": "many", "process_noise": [[1, 0], [0, 1]], "observation_noise": [[1]],
        "modes": (0..20).map(mode).collect::<Vec<_>>(), "probabilities": vec!["1/20"; 20]});
    let out =
        feed(&["stability", "-", "--steps", "0", "--moments", "1", "--most", "5000"], &model.to_string()).quietly(0);
    assert!(out.contains("holds with windows of 3 readings") && !out.contains("Gramians"), "{out}");
}

/// No path from a large start exceeds the bound once the window is full.
#[test]
fn sensors_drawn_at_random_are_bounded_on_every_path() {
    let found = found(&[SENSORS, "--steps", "6", "--exact"], 0);
    let bound = &found["uniform_bound"];
    assert_eq!((&found["observability"]["verdict"], &bound["length"]), (&json!("holds"), &json!(2)));
    let trace = |matrix: &Value| number(&matrix[0][0]) + number(&matrix[1][1]);
    assert_eq!(number(&bound["trace"]), trace(&bound["covariance"]));
    for step in found["steps"].as_array().expect("steps").iter().skip(1) {
        assert!(trace(&step["worst"]) <= number(&bound["trace"]), "{step}");
    }
    // The direction that a path of one reading does not see: first shows only the first state.
    let shorter = &found["observability"]["shorter"];
    assert_eq!((&shorter["modes"], &shorter["vector"]), (&json!(["first"]), &json!(["0", "1"])));
}

/// Below 1 − 1/ρ² = 1 − 16/25 the mean grows (Sinopoli and others 2004).
#[test]
fn two_states_have_a_bracket() {
    let found = found(&[PLANE, "--moments", "1", "--steps", "0"], 0);
    let critical = &found["arrivals"]["critical"];
    let (lower, upper) = (number(&critical["unbounded"]["at"]), number(&critical["bounded"]["at"]));
    assert!(ratio(9, 25) - ratio(1, 500) < lower && lower <= ratio(9, 25), "{lower}");
    assert!(lower < upper && upper < ratio(1, 2), "{upper}");
    let mut rarer = document(PLANE);
    rarer["probabilities"] = json!(["2/3", "1/3"]);
    assert!(feed(&["stability", "-", "--steps", "0"], &rarer.to_string()).quietly(1).contains("order 1  unbounded"));
}

/// A walk that is never read: P(k) = k, so the mean grows, though nothing is multiplied.
#[test]
fn what_is_added_may_grow_without_bound() {
    let model = json!({"format": "exact-kalman/stability/1", "id": "walk", "transition": [[1]], "observation": [[0]], "process_noise": [[1]],
        "observation_noise": [[1]], "modes": [{"name": "blind"}], "probabilities": [1]});
    let out = feed(&["stability", "-", "--moments", "1", "--steps", "3"], &model.to_string()).quietly(1);
    assert!(out.contains("order 1  unbounded: paths that stay in blind keep what each step adds\n"), "{out}");
    assert!(out.contains("  k = 3, 1 value\n    mean   3\n"), "{out}");
}

#[test]
fn bounds_are_printed_outward() {
    let exact = found(&[LINK, "--moments", "1", "--steps", "0"], 0);
    let bound = number(&exact["moments"][0]["proof"]["bound"]);
    let out = run(&["stability", LINK, "--moments", "1", "--steps", "0", "--digits", "3"]).quietly(0);
    let printed = out.lines().find_map(|line| line.split_once("E (tr P(k)) ≤ ")).expect("a bound").1;
    let (whole, decimals) = printed.split_once('.').expect("a decimal");
    let printed: Rational = format!("{whole}{decimals}/1{}", "0".repeat(decimals.len())).parse().expect("a fraction");
    assert!(bound <= printed && printed < bound + ratio(1, 100), "{printed}");
}

#[test]
fn limits_are_told() {
    let out = run(&["stability", LINK, "--most", "3"]).quietly(0);
    assert!(
        out.contains("stopped: P(2) takes more than 3 values; the law is that of P(1) still (--most allows more)"),
        "{out}"
    );
    let out = run(&["stability", SENSORS, "--most", "3", "--moments", "1"]).quietly(0);
    assert!(out.contains("undecided after 3 subspaces"), "{out}");
}

/// Twelve states that drift unobserved would need a linear system of order 158.
#[test]
fn what_is_too_large_is_undecided() {
    let unit = |scale: &str| -> Value {
        (0..12).map(|i| (0..12).map(|j| if i == j { scale } else { "0" }).collect::<Value>()).collect()
    };
    let model = json!({"format": "exact-kalman/stability/1", "id": "large", "transition": unit("5/4"), "process_noise": unit("1"),
        "observation_noise": unit("1"), "modes": [{"name": "lost", "observation": unit("0")}, {"name": "seen", "observation": unit("1")}],
        "probabilities": ["1/2", "1/2"]});
    let out = feed(&["stability", "-", "--steps", "1"], &model.to_string()).quietly(3);
    assert!(out.contains("order 1  undecided: a linear system of order 158 would be needed"), "{out}");
    assert!(out.contains("the critical probability is sought for at most four states"), "{out}");
}

#[test]
fn refusals_name_the_place() {
    let long = format!("1/{}", "3".repeat(900));
    for (pointer, value, message) in [
        (
            "/probabilities",
            json!(["1/4", "1/4"]),
            "probabilities: the probabilities of the first mode do not add up to one",
        ),
        ("/probabilities", json!(["5/4", "-1/4"]), "probabilities: a probability of the first mode is negative"),
        ("/modes/1/name", json!("lost"), "modes[1].name: \"lost\" is the name of another mode"),
        ("/transition", json!([[long]]), "modes[0].transition: a number of 2989 bits; at most 2048 are worked with"),
        ("/process_noise", json!([["-1"]]), "process_noise: not positive semidefinite: v = [1] has vᵀPv = -1"),
        ("/modes", json!([]), "modes: is empty"),
        ("/modes/0/name", json!(""), "modes[0].name: is empty"),
        ("/modes/0/name", json!("a\u{1b}[2J"), "modes[0].name: holds the control character '\\u{1b}'"),
        ("/id", json!("two\nlines"), "id: holds the control character '\\n'"),
    ] {
        let mut model = document(LINK);
        *model.pointer_mut(pointer).expect("there") = value;
        let trouble = feed(&["stability", "-"], &model.to_string()).trouble();
        assert!(trouble.contains(message), "{trouble}");
    }
}
