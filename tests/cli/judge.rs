//! `judge`: answers that were saved.

use crate::program::{Directory, feed, run, walk};

fn answer(id: &str, mean: &str) -> String {
    format!(r#"{{"id":"{id}","outcome":"answered","steps":[{{"filtered_mean":["{mean}"]}}]}}"#)
}

/// The report on these lines as answers to walks called a, b and c, each read as 1: the mean is 1/2.
fn judged(lines: &[String], code: i32) -> String {
    let directory = Directory::new();
    let cases = directory.file("cases.jsonl", ["a", "b", "c"].map(|id| walk(id, &["1"])).join("\n"));
    feed(&["judge", "-", "--cases", &cases], &lines.join("\n")).quietly(code)
}

#[test]
fn in_any_order() {
    let out = judged(&["c", "a", "b"].map(|id| answer(id, "0.5")), 0);
    assert!(out.ends_with("3 cases: 3 agrees\n") && !out.contains("note:"), "{out}");
}

#[test]
fn what_is_missing_is_a_finding() {
    let out = judged(&["a", "b"].map(|id| answer(id, "0.5")), 1);
    assert!(out.contains("1. c: malformed\n   there is no answer to this case\n"), "{out}");
    let out = judged(&[], 1);
    assert!(out.ends_with("3 cases: 3 malformed\n"), "{out}");
}

#[test]
fn what_is_too_much_is_told() {
    let out = judged(&["a", "b", "c", "d", "a"].map(|id| answer(id, "0.5")), 0);
    assert!(out.contains("note: \"d\" is answered, but it is no case that was asked\n"), "{out}");
    assert!(out.contains("note: \"a\" is answered more than once; the last answer counts\n"), "{out}");
    // It does count.
    let lines = [answer("a", "0.5"), answer("b", "0.5"), answer("c", "0.5"), answer("a", "7")];
    assert!(judged(&lines, 1).contains("1. a: wrong"));
}

#[test]
fn garbage_is_passed_over_or_told() {
    let good = ["a", "b"].map(|id| answer(id, "0.5"));
    let more =
        ["Loading…", "", r#"{"id":"c","outcome":"answered","steps":[{"mean":["0.5"]}]}"#, "{\"id\":\"c\"", "\u{7}"];
    let lines: Vec<String> = good.into_iter().chain(more.map(str::to_owned)).collect();
    let out = judged(&lines, 1);
    assert!(out.contains("1. c: malformed\n   line 5 is no answer: steps[0]"), "{out}");
    assert!(out.contains("note: line 6 is no answer: ") && out.contains("note: 2 stray lines passed over"), "{out}");
}

#[test]
fn what_solve_says_agrees() {
    let directory = Directory::new();
    for options in [&["--exact"][..], &["--digits", "20"][..]] {
        let cases =
            run(&["cases", "--only", "basic", "--only", "singular", "--only", "refuse", "--format", "json"]).quietly(0);
        let count = cases.lines().count();
        let answers = feed(&[&["solve", "-", "--format", "json"], options].concat(), &cases);
        let (cases, answers) = (directory.file("cases.jsonl", cases), directory.file("answers.jsonl", answers.stdout));
        let out = run(&["judge", &answers, "--cases", &cases]).quietly(0);
        assert!(out.contains(&format!("{count} cases: {count} agrees")), "{out}");
    }
}

#[test]
fn standard_input_is_read_once() {
    let message = run(&["judge", "-", "--cases", "-"]).trouble();
    assert!(message.contains("standard input"), "{message}");
}

#[test]
fn a_file_that_is_not_there() {
    assert!(run(&["judge", "no-such-file"]).trouble().contains("no-such-file"));
}
