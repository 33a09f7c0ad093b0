//! `solve`: exact numbers, correctly rounded.

use serde_json::Value;

use crate::program::{Directory, feed, run, walk};

const NILE: &str = "examples/cases/nile.json";
const WALK: &str = "examples/cases/walk.json";

/// The value printed for a quantity.
fn value<'a>(text: &'a str, quantity: &str) -> &'a str {
    let line = text.lines().find_map(|line| line.trim_start().strip_prefix(quantity)).expect(quantity);
    line.trim()
}

#[test]
fn the_level_of_the_nile_in_1970() {
    // Known to 26 digits from an independent exact computation, for the double nearest to 1469.1 …
    let out = run(&["solve", NILE, "--last", "--digits", "26"]).quietly(0);
    assert!(out.starts_with("nile/diffuse · step 99\n"), "{out}");
    assert_eq!(value(&out, "filtered mean"), "798.37029260836422212280568");
    assert!(value(&out, "filtered covariance").starts_with("4032.15794180847616502029"), "{out}");
    // … and for 1469.1 itself.
    let exact = std::fs::read_to_string(NILE).expect("a readable file").replace("binary64", "exact");
    let out = feed(&["solve", "-", "--last", "--digits", "26"], &exact).quietly(0);
    assert_eq!(value(&out, "filtered mean"), "798.37029260836421990910956");
    assert!(value(&out, "filtered covariance").starts_with("4032.15794180847627059876"), "{out}");
}

#[test]
fn seventeen_digits_unless_asked_otherwise() {
    let out = run(&["solve", NILE, "--last"]).quietly(0);
    assert_eq!(value(&out, "filtered mean"), "798.37029260836422");
    let out = run(&["solve", NILE, "--last", "--digits", "3"]).quietly(0);
    assert_eq!(value(&out, "filtered mean"), "798");
    for digits in ["0", "10001", "-1", "many"] {
        assert_eq!(run(&["solve", NILE, "--digits", digits]).code, 2);
    }
}

#[test]
fn fractions() {
    // Worked by hand in docs/PROTOCOL.md.
    let out = run(&["solve", WALK, "--exact"]).quietly(0);
    assert_eq!(
        out,
        "walk/two-readings · step 0
  filtered mean                        1/2
  filtered covariance                  1/2
  predicted mean                       0
  predicted covariance                 1
  innovation                           1
  innovation covariance                2
walk/two-readings · step 1
  filtered mean                        2
  filtered covariance                  3/5
  predicted mean                       1/2
  predicted covariance                 3/2
  innovation                           5/2
  innovation covariance                5/2
"
    );
    assert_eq!(run(&["solve", WALK, "--exact", "--digits", "5"]).code, 2);
}

#[test]
fn the_trace_has_every_quantity() {
    let out = run(&["solve", WALK, "--trace", "--last"]).quietly(0);
    // By hand: gain 3/5, cross covariance 3/2, ν²/S = 5/2, S = 5/2.
    for (quantity, expected) in [
        ("gain", "0.6"),
        ("cross covariance", "1.5"),
        ("predicted observation", "0.5"),
        ("rank of the innovation covariance", "1"),
        ("likelihood: quadratic form", "2.5"),
        ("likelihood: pseudo-determinant", "2.5"),
    ] {
        assert_eq!(value(&out, quantity), expected);
    }
    // Before its first reading the level has no finite moments.
    let out = run(&["solve", NILE, "--trace", "--digits", "6"]).quietly(0);
    assert!(out.contains("covariance of order kappa  1\n"), "{out}");
}

/// Two routes, step by step: what the fast one prints is what the recursion prints of it, up to the same contradictions.
#[test]
fn the_trace_says_what_is_said_without_it() {
    let selection = ["cases", "--only", "basic", "--only", "singular", "--only", "diffuse", "--format", "json"];
    let cases: String =
        run(&selection).quietly(0).lines().filter(|case| case.len() < 4000).flat_map(|case| [case, "\n"]).collect();
    let (fast, trace) = (feed(&["solve", "-", "--exact"], &cases), feed(&["solve", "-", "--exact", "--trace"], &cases));
    let ahead = feed(&["solve", "-", "--exact", "--ahead", "1"], &cases);
    assert_eq!((fast.code, &fast.stderr), (trace.code, &trace.stderr));
    assert_eq!((fast.code, &fast.stderr), (ahead.code, &ahead.stderr));
    let lines: Vec<&str> = fast.stdout.lines().filter(|line| !line.contains("not yet resolved")).collect();
    for more in [&trace.stdout, &ahead.stdout] {
        let mut more = more.lines();
        for line in &lines {
            assert!(more.any(|other| other == *line), "{line}");
        }
    }
    assert!(lines.len() > 300, "{}", lines.len());
}

#[test]
fn predictions_ahead() {
    // By hand: filtered 1/2 and 1/2, then 2 and 3/5; a walk stays where it is, and its variance grows by one a step.
    let out = run(&["solve", WALK, "--exact", "--ahead", "2"]).quietly(0);
    let (first, last) = out.split_at(out.find("walk/two-readings · step 1").expect("it is printed"));
    for (step, mean, one, two) in [(first, "1/2", "3/2", "5/2"), (last, "2", "8/5", "13/5")] {
        assert_eq!((value(step, "mean 1 ahead"), value(step, "covariance 1 ahead")), (mean, one));
        assert_eq!((value(step, "mean 2 ahead"), value(step, "covariance 2 ahead")), (mean, two));
        assert!(!step.contains("3 ahead") && !step.contains("gain"), "{step}");
    }
    // What was shown before is still shown, first and unchanged.
    let without = run(&["solve", WALK, "--exact"]).quietly(0);
    let kept: Vec<&str> = out.lines().filter(|line| !line.contains(" ahead")).collect();
    assert_eq!(kept, without.lines().collect::<Vec<_>>());
    for steps in ["0", "1001", "-1", "two"] {
        let ran = run(&["solve", WALK, "--ahead", steps]);
        assert_eq!(ran.code, 2);
        assert!(ran.stderr.contains("from 1 to 100 steps") || steps == "-1", "{}", ran.stderr);
    }
}

#[test]
fn predictions_ahead_in_json() {
    let out = run(&["solve", WALK, "--exact", "--ahead", "2", "--format", "json"]).quietly(0);
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    let law = |mean: &str, variance: &str| serde_json::json!({"mean": [mean], "covariance": [[variance]]});
    assert_eq!(answer["steps"][1]["ahead"], Value::from(vec![law("2", "8/5"), law("2", "13/5")]));
    let out = run(&["solve", WALK, "--exact", "--format", "json"]).quietly(0);
    assert!(!out.contains("ahead"), "{out}");
}

#[test]
fn predictions_of_a_diffuse_state_are_absent() {
    // Two states that nothing moves; the first reading sees one of them, the second both.
    let case = r#"{"format":"exact-kalman/case/1","id":"two","timing":"departing","initial":{"before":"observation","mean":["0","0"],"covariance":[["0","0"],["0","0"]],"diffuse":[["1","0"],["0","1"]]},"transition":[["1","0"],["0","1"]],"observation":[[["1","0"]],[["1","1"]]],"noise":{"process":[["0","0"],["0","0"]],"observation":[["1"]]},"observations":[["3"],["5"]]}"#;
    let out = feed(&["solve", "-", "--ahead", "1"], case).quietly(0);
    let (first, last) = out.split_at(out.find("two · step 1").expect("it is printed"));
    assert!(first.contains("not yet resolved") && !first.contains("ahead"), "{first}");
    assert_eq!((value(last, "mean 1 ahead"), value(last, "covariance 1 ahead")), ("[3, 2]", "[[1, -1], [-1, 2]]"));
    let out = feed(&["solve", "-", "--ahead", "1", "--trace"], case).quietly(0);
    assert!(out.contains("covariance 1 ahead of order kappa    [[0, 0], [0, 1]]\n"), "{out}");
    let out = feed(&["solve", "-", "--ahead", "1", "--format", "json"], case).quietly(0);
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!(answer["steps"][0]["ahead"], serde_json::json!([null]));
}

/// A list of transitions may hold what is needed beyond the last reading, and prediction ends with it.
#[test]
fn lists_may_go_on_beyond_the_last_reading() {
    let case = |timing: &str, list: &str| {
        let case = walk("listed", &["1", "3"]).replace("departing", timing);
        case.replace(r#""transition":[["1"]]"#, &format!(r#""transition":{list}"#))
    };
    let last = |timing: &str, list: &str| {
        let out = feed(&["solve", "-", "--last", "--exact", "--ahead", "3"], &case(timing, list)).quietly(0);
        let means = (1..=3).filter(|i| out.contains(&format!("mean {i} ahead"))).count();
        (means, if means > 0 { value(&out, &format!("mean {means} ahead")).to_owned() } else { String::new() })
    };
    assert_eq!(last("departing", r#"[[["1"]],null]"#), (0, String::new()));
    assert_eq!(last("departing", r#"[[["1"]],[["5"]],[["7"]]]"#), (2, "70".to_owned()));
    assert_eq!(last("departing", r#"[[["1"]],[["5"]],[["7"]],[["0.5"]]]"#), (3, "35".to_owned()));
    assert_eq!(last("arriving", r#"[null,[["1"]]]"#), (0, String::new()));
    assert_eq!(last("arriving", r#"[null,[["1"]],[["5"]],[["7"]],[["0.5"]]]"#), (3, "35".to_owned()));
    // More than is needed may stand there, and changes nothing; less than the readings need may not.
    let four = case("departing", r#"[[["1"]],[["5"]],[["7"]],[["1"]]]"#);
    let three = case("departing", r#"[[["1"]],[["5"]],[["7"]]]"#);
    let two = case("departing", r#"[[["1"]],[["5"]]]"#);
    assert_eq!(feed(&["solve", "-"], &four).quietly(0), feed(&["solve", "-"], &two).quietly(0));
    let ahead = ["solve", "-", "--ahead", "2"];
    assert_eq!(feed(&ahead, &four).quietly(0), feed(&ahead, &three).quietly(0));
    let message = feed(&["solve", "-"], &case("departing", r#"[[["1"]]]"#)).trouble();
    assert!(message.contains("give one entry per observation, or more"), "{message}");
}

/// What was predicted before a contradiction is printed.
#[test]
fn predictions_before_a_contradiction() {
    let directory = Directory::new();
    assert_eq!(run(&["cases", "--only", "contradicted", "--out", directory.name()]).code, 0);
    let ran = run(&["solve", directory.name(), "--ahead", "1"]);
    assert_eq!(ran.code, 1);
    assert!(ran.stderr.starts_with("singular/known-state-contradicted: at step 2 "), "{}", ran.stderr);
    assert_eq!(ran.stdout.matches("mean 1 ahead").count(), 2, "{}", ran.stdout);
}

#[test]
fn answers_of_the_protocol() {
    for (options, mean) in [(&["--digits", "4"][..], "0.3333"), (&["--exact"][..], "1/3")] {
        let case = walk("third", &["1"]).replace(r#"observation":[["1"]]},"#, r#"observation":[["2"]]},"#);
        let out = feed(&[&["solve", "-", "--format", "json"], options].concat(), &case).quietly(0);
        let answer: Value = serde_json::from_str(&out).expect("JSON");
        assert_eq!((&answer["id"], &answer["outcome"]), (&"third".into(), &"answered".into()));
        assert_eq!((&answer["numbers"], &answer["steps"][0]["filtered_mean"][0]), (&"exact".into(), &mean.into()));
    }
}

/// Hilgert and Vila's P₁ = [[80, 500], [500, 80]] with the mean (10, 45); the second state is read as 30, without noise.
fn hilgert_vila(more: &str) -> String {
    format!(
        r#"{{"format":"exact-kalman/case/1","id":"hv","timing":"departing","initial":{{"before":"observation","mean":["10","45"],"covariance":[["80","500"],["500","80"]]{more}}},"transition":[["1","0"],["0","1"]],"observation":[["0","1"]],"noise":{{"process":[["0","0"],["0","0"]],"observation":[["0"]]}},"observations":[["30"]]}}"#
    )
}

#[test]
fn an_indefinite_prior_is_refused_with_a_witness() {
    let message = feed(&["solve", "-"], &hilgert_vila("")).trouble();
    assert!(message.contains("\"hv\"") && message.contains("initial.covariance"), "{message}");
    let vector = message.split("v = [").nth(1).expect("it is printed").split(']').next().expect("at least one");
    let v: Vec<f64> = vector.split(", ").map(|entry| entry.parse().expect("a number")).collect();
    let form = 80.0 * v[0] * v[0] + 1000.0 * v[0] * v[1] + 80.0 * v[1] * v[1];
    assert!(form < 0.0 && message.contains(&format!("vᵀPv = {form}")), "{message}");
}

#[test]
fn an_indefinite_prior_runs_if_asked_to() {
    // Gain of the first state 500/80 = 25/4, innovation −15: mean 10 − 375/4, variance 80 − 500²/80.
    let ran = feed(&["solve", "-"], &hilgert_vila(r#","allow_indefinite":true"#));
    assert!(ran.code == 0 && ran.stderr.contains("no conditional moments"), "{}", ran.stderr);
    let out = ran.stdout;
    assert_eq!(value(&out, "filtered mean"), "[-83.75, 30]");
    assert_eq!(value(&out, "filtered covariance"), "[[-3045, 0], [0, 0]]");
    assert_eq!(value(&out, "innovation covariance"), "80");
}

#[test]
fn a_contradiction_is_told_with_its_step() {
    let directory = Directory::new();
    assert_eq!(run(&["cases", "--only", "contradicted", "--out", directory.name()]).code, 0);
    let ran = run(&["solve", directory.name()]);
    assert_eq!(ran.code, 1);
    assert!(ran.stderr.starts_with("singular/known-state-contradicted: at step 2 "), "{}", ran.stderr);
    assert!(ran.stdout.contains("step 1\n") && !ran.stdout.contains("step 2\n"), "{}", ran.stdout);
    let ran = run(&["solve", directory.name(), "--format", "json"]);
    let answer: Value = serde_json::from_str(&ran.stdout).expect("JSON");
    assert_eq!((&answer["outcome"], &answer["step"]), (&"flagged".into(), &2.into()));
}

#[test]
fn one_bad_case_does_not_hide_the_others() {
    let bad = walk("bad", &["1", "NaN"]);
    let stream = [walk("first", &["1"]), bad, walk("last", &["3"])].join("\n");
    let ran = feed(&["solve", "-"], &stream);
    assert_eq!(ran.code, 2);
    assert!(ran.stdout.contains("first · step 0") && ran.stdout.contains("last · step 0"), "{}", ran.stdout);
    assert!(ran.stderr.starts_with("error: case \"bad\": observations[1][0]: "), "{}", ran.stderr);
    let ran = feed(&["solve", "-", "--format", "json"], &stream);
    let outcomes: Vec<Value> = ran.stdout.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let outcomes: Vec<&str> = outcomes.iter().map(|answer| answer["outcome"].as_str().expect("a string")).collect();
    assert_eq!((ran.code, outcomes), (2, vec!["answered", "refused", "answered"]));
}
