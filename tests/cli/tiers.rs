//! `solve --tier`: the digits of the exact tier, by enclosures.

use std::fmt::Write as _;

use exact_kalman::protocol::Answer;
use serde_json::Value;

use crate::program::{feed, run, walk};

/// Two states with one sensor, read so many times; numbers of two decimals.
fn long(steps: usize, process: &str) -> String {
    let mut readings = String::new();
    for k in 0..steps {
        let (whole, part) = ((k * k + 1) % 7, k * 37 % 100);
        let _ = write!(readings, r#"{}["{whole}.{part:02}"]"#, if k == 0 { "" } else { "," });
    }
    format!(
        r#"{{"format":"exact-kalman/case/1","id":"long","timing":"departing","numbers":"exact","initial":{{"before":"observation","mean":["0","0"],"covariance":[["1","0"],["0","1"]]}},"transition":[["1","0.1"],["-0.2","0.9"]],"observation":[["1","0"]],"noise":{{"process":{process},"observation":[["0.5"]]}},"observations":[{readings}]}}"#
    )
}

const NOISE: &str = r#"[["0.02","0.01"],["0.01","0.03"]]"#;

fn tier(cases: &str, name: &str, more: &[&str]) -> crate::program::Ran {
    feed(&[&["solve", "-", "--tier", name], more].concat(), cases)
}

/// Of the suite all that exact numbers reach soon, letter by letter, what is said of contradictions included.
#[test]
fn auto_prints_what_exact_numbers_print() {
    let suite = run(&["cases", "--format", "json"]).quietly(0);
    let is_far = |line: &&str| line.len() > 1 << 13 || line.contains("\"id\":\"large/");
    let suite: String = suite.split_inclusive('\n').filter(|line| !is_far(line)).collect();
    assert!(suite.lines().count() > 340);
    for more in [&[][..], &["--digits", "60"], &["--digits", "2", "--format", "json"]] {
        let (exact, auto) = (tier(&suite, "exact", more), tier(&suite, "auto", more));
        assert_eq!(exact.code, auto.code);
        assert!(exact.stdout == auto.stdout, "they differ");
        // Where enclosures widen it is told besides.
        let told: Vec<&str> = auto.stderr.lines().filter(|line| !line.contains("enclosures lose accuracy")).collect();
        assert_eq!(exact.stderr.lines().collect::<Vec<_>>(), told);
    }
}

/// Where most steps are enclosed: as is seen by the limit on exact numbers, which nothing reaches.
#[test]
fn long_runs_have_the_digits_of_exact_numbers() {
    let case = long(400, NOISE);
    for more in [&["--digits", "1"][..], &["--digits", "17"], &["--digits", "100", "--format", "json"]] {
        let exact = tier(&case, "exact", more).quietly(0);
        let limited = [more, &["--max-bits", "3000"]].concat();
        assert!(tier(&case, "exact", &limited).code == 3, "exact numbers are longer");
        assert!(tier(&case, "auto", &limited).quietly(0) == exact, "they differ");
        assert!(tier(&case, "certified", more).quietly(0) == exact, "they differ");
        let default = feed(&[&["solve", "-"], &limited[..]].concat(), &case);
        assert!(default.quietly(0) == exact, "auto is the default");
    }
}

/// Everything that has a name, and predictions: the recursion's digits, and log likelihoods besides.
#[test]
fn enclosures_of_everything_have_the_digits_of_the_recursion() {
    let case = long(40, NOISE);
    for more in [&["--trace"][..], &["--ahead", "3"], &["--ahead", "2", "--trace"]] {
        let exact = tier(&case, "exact", more).quietly(0);
        let certified = tier(&case, "certified", more).quietly(0);
        let kept: Vec<&str> = certified.lines().filter(|line| !line.contains("log likelihood")).collect();
        assert_eq!(exact.lines().collect::<Vec<_>>(), kept);
        assert_eq!(more.contains(&"--trace"), kept.len() < certified.lines().count());
    }
    // ln p of the first reading, 1 with variance 3/2: −½ ln 3π − 1/3, worked out elsewhere.
    let out = tier(&case, "certified", &["--trace", "--digits", "24"]).quietly(0);
    let line = out.lines().find(|line| line.starts_with("  log likelihood ")).expect("it is there");
    assert_eq!(line.split_whitespace().last(), Some("-1.45500442059208826610267"));
    let json = tier(&case, "certified", &["--trace", "--format", "json", "--ahead", "1"]).quietly(0);
    let answer = Answer::parse(json.trim_end()).expect("an answer of the protocol");
    assert!(answer.steps.iter().all(|step| step.len() == 8) && answer.ahead.len() == 40);
}

#[test]
fn many_steps_take_seconds_and_little_memory() {
    let case = long(20_000, NOISE);
    let begun = std::time::Instant::now();
    let out = tier(&case, "auto", &["--last", "--digits", "30"]).quietly(0);
    assert!(out.starts_with("long · step 19999\n") && out.lines().count() == 7, "{out}");
    assert!(begun.elapsed().as_secs() < 120, "{:?}", begun.elapsed());
    // What holds the digits of the steady state is another route to them: both runs have long forgotten their starts.
    let other = tier(
        &case.replace(r#"[["1","0"],["0","1"]]},"tr"#, r#"[["7","3"],["3","5"]]},"tr"#),
        "certified",
        &["--last", "--digits", "30"],
    );
    assert_eq!(other.quietly(0), out);
}

/// A rank that enclosures cannot decide ends the answer, with the way out; nothing is guessed.
#[test]
fn what_is_not_decided_is_said() {
    // The second state repeats the first, whose sensor has no noise: from the second reading on nothing is unknown.
    let case = long(3, r#"[["0","0"],["0","0"]]"#)
        .replace(r#""0.5""#, r#""0""#)
        .replace(r#"[["1","0.1"],["-0.2","0.9"]]"#, r#"[["1","0"],["0","1"]]"#);
    let case = case.replace(r#"["2.37"]"#, r#"["1.00"]"#).replace(r#"["5.74"]"#, r#"["1.00"]"#);
    let ran = tier(&case, "certified", &["--most-bits", "512"]);
    assert_eq!(ran.code, 3, "{}", ran.stderr);
    assert_eq!(ran.stdout.matches(" · step ").count(), 1, "{}", ran.stdout);
    let begin = "long: at step 1 the start is diffuse, or the covariance of the innovation singular or too near to it: enclosures of 512 bits";
    assert!(ran.stderr.starts_with(begin) && ran.stderr.contains("--tier auto"), "{}", ran.stderr);
    let json = tier(&case, "certified", &["--most-bits", "512", "--format", "json"]);
    let answer: Value = serde_json::from_str(&json.stdout).expect("it is JSON");
    assert_eq!((&answer["outcome"], &answer["step"]), (&"error".into(), &1.into()));
    assert_eq!(tier(&case, "auto", &[]).quietly(0), tier(&case, "exact", &[]).quietly(0));
}

/// Two sensors that are one: what contradicts needs no exact number, and is told as exact numbers tell it.
#[test]
fn sensors_that_contradict_each_other_are_told() {
    let case = r#"{"format":"exact-kalman/case/1","id":"twins","timing":"departing","numbers":"exact","initial":{"before":"observation","mean":["0"],"covariance":[["1"]]},"transition":[["0.9"]],"observation":[["1"],["2"]],"noise":{"process":[["1"]],"observation":[["0.5","1"],["1","2"]]},"observations":[["1","2"],["3","6"],["2","5"],["1","2"]]}"#;
    let exact = tier(case, "exact", &[]);
    assert!(
        exact.code == 1 && exact.stderr.starts_with("twins: at step 2 the data have probability zero"),
        "{}",
        exact.stderr
    );
    for name in ["auto", "certified"] {
        let ran = tier(case, name, &[]);
        assert_eq!((ran.code, &ran.stdout, &ran.stderr), (1, &exact.stdout, &exact.stderr), "{name}");
    }
    let ran = feed(&["solve", "-", "--certificate", "-"], case);
    assert_eq!((ran.code, ran.stdout.as_str()), (1, ""), "{}", ran.stderr);
    let begin = "twins: no certificate is written: at step 2 the data have probability zero";
    assert!(ran.stderr.starts_with(begin), "{}", ran.stderr);
}

/// Zeros and ties are told with a bound, or, in JSON, left out; exact numbers decide them.
#[test]
fn zeros_have_bounds() {
    // By hand: the mean is 3/4, then 3/4 − 3/5 · 1/2 = 0.45, a tie of one digit; the third reading is what is expected.
    let case = walk("zero", &["1.25", "0.25", "0.45"]).replace(r#""mean":["0"]"#, r#""mean":["0.25"]"#);
    let case = case.replace(r#""timing""#, r#""numbers":"exact","timing""#);
    let exact = tier(&case, "exact", &["--digits", "1"]).quietly(0);
    assert!(exact.contains("step 1\n  filtered mean                        0.5\n"), "{exact}");
    assert_eq!(tier(&case, "auto", &["--digits", "1"]).quietly(0), exact);
    let out = tier(&case, "certified", &["--digits", "1"]).quietly(0);
    assert!(out.contains("step 1\n  filtered mean                        0.45±"), "{out}");
    assert!(out.lines().any(|line| line.starts_with("  innovation   ") && line.contains(" 0±")), "{out}");
    let json = tier(&case, "certified", &["--digits", "1", "--format", "json"]);
    assert!(json.code == 0 && json.stderr.contains("left out"), "{}", json.stderr);
    let answer = Answer::parse(json.stdout.trim_end()).expect("an answer of the protocol");
    assert!(answer.steps.iter().any(|step| step.len() < 6));
}

/// The sum of two states more than doubles with each step and is known without noise, their difference is not: no rounding
/// holds the zero in between.
#[test]
fn enclosures_that_widen_are_told() {
    let case = walk("known", &["0.1"; 30])
        .replace(r#""transition":[["1"]]"#, r#""transition":[["1.3","0.8"],["0.8","1.3"]]"#)
        .replace(r#""mean":["0"],"covariance":[["1"]]"#, r#""mean":["0","0"],"covariance":[["1","-1"],["-1","1"]]"#)
        .replace(r#""observation":[["1"]],"noise""#, r#""observation":[["1","0"]],"noise""#)
        .replace(r#""process":[["1"]]"#, r#""process":[["1","-1"],["-1","1"]]"#);
    let ran = tier(&case, "certified", &[]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    assert!(ran.stderr.starts_with("known: enclosures lose accuracy: "), "{}", ran.stderr);
    assert!(ran.stderr.contains("a mode that grows") && ran.stderr.lines().count() == 1, "{}", ran.stderr);
    assert_eq!(ran.stdout, tier(&case, "exact", &[]).quietly(0));
}

/// Two copies of one system side by side: what lies between them is zero, which no number close to zero says.
#[test]
fn independent_states_are_enclosed_all_the_same() {
    let case = long(300, r#"[["0.02","0"],["0","0.03"]]"#)
        .replace(r#"[["1","0.1"],["-0.2","0.9"]]"#, r#"[["0.7","0"],["0","0.9"]]"#);
    for more in [&[][..], &["--format", "json"]] {
        let exact = tier(&case, "exact", more).quietly(0);
        assert!(exact.contains("0]") || exact.contains(r#""0"]"#));
        assert!(tier(&case, "exact", &[more, &["--max-bits", "3000"]].concat()).code == 3, "exact numbers are longer");
        // The second state is seen by nothing, and expected at zero for ever.
        let ran = tier(&case, "certified", more);
        assert!(ran.stdout.contains('±') || ran.stderr.contains("left out"), "{}", ran.stderr);
        let seen = case.replace(r#""mean":["0","0"]"#, r#""mean":["0","1"]"#);
        assert!(
            tier(&seen, "auto", &[more, &["--max-bits", "3000"]].concat()).quietly(0)
                == tier(&seen, "exact", more).quietly(0)
        );
    }
}

#[test]
fn fractions_are_exact() {
    for name in ["auto", "certified"] {
        let ran = tier(&walk("walk", &["1"]), name, &["--exact"]);
        assert!(ran.code == 2 && ran.stderr.contains("--exact"), "{}", ran.stderr);
    }
    assert_eq!(tier(&walk("walk", &["1"]), "exact", &["--exact"]).code, 2);
}
