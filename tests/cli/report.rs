//! What a stranger reads.

use crate::program::{Directory, run, walk};

/// The report on answers that a script prints to a case, whatever it reads.
fn report(case: &str, answer: &str) -> String {
    let directory = Directory::new();
    let (cases, answers) = (directory.file("cases.jsonl", case), directory.file("answers.jsonl", answer));
    run(&["judge", &answers, "--cases", &cases]).quietly(1)
}

#[test]
fn a_finding_says_where_how_much_and_what_is_right() {
    let out = report(
        &walk("walk", &["1", "3"]),
        r#"{"id":"walk","outcome":"answered","steps":[{"filtered_mean":["0.5"],"filtered_covariance":[["0.5"]]},{"filtered_mean":["2"],"filtered_covariance":[["0.60006"]]}]}"#,
    );
    // The variance 3/5 is off by 10⁻⁴ of itself, and a hair more: the double is above 0.60006. (By hand in
    // docs/PROTOCOL.md.)
    let line =
        "filtered covariance at step 1, entry [0, 0]: 3 digits where 15 are attainable: 0.60006 answered, 0.6 exact";
    assert!(out.contains(line), "{out}");
    assert!(out.contains("Attainable is "), "{out}");
}

#[test]
fn a_singular_innovation_says_why_fifteen_digits_count() {
    let directory = Directory::new();
    run(&["cases", "--only", "singular/settled-after-one", "--out", directory.name()]);
    let case =
        std::fs::read_to_string(directory.path().join("singular/settled-after-one.json")).expect("a readable file");
    // The constant 0.75 is read without noise: the second answer is a little off.
    let step = |mean: &str| format!(r#"{{"filtered_mean":["{mean}"]}}"#);
    let steps = [step("0.75"), step("0.7500001"), step("0.75")].join(",");
    let out =
        report(&case, &format!(r#"{{"id":"singular/settled-after-one","outcome":"answered","steps":[{steps}]}}"#));
    // 10⁻⁷ in units of the largest variance, 1.
    assert!(out.contains("filtered mean at step 1, entry [0]: 7 digits where 15 are attainable"), "{out}");
    assert!(out.contains("15 digits count as attainable: an innovation covariance is singular"), "{out}");
    assert!(out.contains("loses 8 digits"), "{out}");
}

#[test]
fn the_worst_comes_first_and_a_witness_is_shown() {
    let cases = [walk("first", &["1"]), walk("second", &["1"])].join("\n");
    // Below zero by more than rounding, but right to five digits of the scale: no such variance.
    let out = report(
        &cases,
        r#"{"id":"first","outcome":"answered","steps":[{"filtered_mean":["0.5001"]}]}
{"id":"second","outcome":"answered","steps":[{"filtered_covariance":[["-0.25"]]}]}"#,
    );
    let place = |text: &str| out.find(text).unwrap_or_else(|| panic!("{text} in {out}"));
    assert!(place("1. second: wrong") < place("2. first: wrong"), "{out}");
    assert!(
        out.contains("filtered covariance at step 0 is not positive semidefinite: v = [[1]] has vᵀPv = -0.25"),
        "{out}"
    );
}

#[test]
fn lines_fit_on_a_screen() {
    // A wide one: nine filters stand side by side.
    let out = run(&["check", "--only", "basic", "--only", "exact-sensor"]).quietly(0);
    assert!(out.lines().all(|line| line.chars().count() <= 150), "{out}");
}

#[test]
fn what_a_case_says_is_no_command_to_the_terminal() {
    let case = walk("walk", &["1"]).replace("\"id\":\"walk\"", r#""id":"walk\u001b[2J","about":"\u001b[31mred\u0007""#);
    let out = report(&case, "");
    assert!(!out.contains(|c: char| c.is_control() && c != '\n'), "{out:?}");
}
