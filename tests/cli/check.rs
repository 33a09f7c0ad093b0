//! `check`: exit codes, selections, formats.

use std::process::Stdio;

use serde_json::Value;

use crate::program::{Directory, program, run, walk};

/// A program that answers the walks of these tests, if their id is known to it.
const SOLVED: &str = r#"while read -r line; do case "$line" in
  *'"id":"good"'*) echo '{"id":"good","outcome":"answered","steps":[{"filtered_mean":["0.5"],"filtered_covariance":[["0.5"]]}]}';;
  *'"id":"bad"'*) echo '{"id":"bad","outcome":"answered","steps":[{"filtered_mean":["0.6"],"filtered_covariance":[["0.5"]]}]}';;
  *'"id":"foreign"'*) echo '{"id":"foreign","outcome":"unsupported"}';;
  *'"id":"wordless"'*) echo '{"id":"wordless","outcome":"answered"}';;
esac; done"#;

fn check(cases: &str, more: &[&str]) -> crate::program::Ran {
    let directory = Directory::new();
    let file = directory.file("cases.jsonl", cases);
    run(&[&["check", "--cases", &file], more, &["--", "sh", "-c", SOLVED]].concat())
}

#[test]
fn exit_codes() {
    let good = walk("good", &["1"]);
    let out = check(&good, &[]).quietly(0);
    assert!(out.contains("good  agrees"), "{out}");
    assert!(out.ends_with("1 case: 1 agrees\n"), "{out}");
    let out = check(&format!("{good}\n{}", walk("bad", &["1"])), &[]).quietly(1);
    assert!(out.contains("1. bad: wrong\n") && out.ends_with("2 cases: 1 agrees, 1 wrong\n"), "{out}");
    assert_eq!(check("nonsense", &[]).code, 2);
    // Something that cannot be decided: a case that is no problem, but does not say so.
    let undecided = check(&format!("{good}\n{}", walk("wordless", &["NaN"])), &[]).quietly(3);
    assert!(undecided.ends_with("2 cases: 1 agrees, 1 undecided\n"), "{undecided}");
    // Something that is not known to the program is no finding, but where that is all, nothing was judged.
    let foreign = walk("foreign", &["1"]);
    assert_eq!(check(&format!("{good}\n{foreign}"), &[]).code, 0);
    assert_eq!(check(&foreign, &[]).code, 3);
}

#[test]
fn json_is_valid_and_stable() {
    let cases = [walk("good", &["1"]), walk("bad", &["1"])].join("\n");
    // The name of the file is not in it.
    let first = check(&cases, &["--format", "json"]);
    assert_eq!(first.stdout, check(&cases, &["--format", "json"]).stdout);
    let report: Value = serde_json::from_str(&first.stdout).expect("a JSON report");
    let keys = |value: &Value| value.as_object().expect("an object").keys().cloned().collect::<Vec<_>>();
    assert_eq!(
        keys(&report),
        [
            "at_first_finding",
            "cases",
            "counts",
            "declaration",
            "diagnosis",
            "examinee",
            "format",
            "remarks",
            "unjudged"
        ]
    );
    let bad = &report["cases"][1];
    assert_eq!(keys(bad), ["asymmetric", "flags", "id", "not_psd", "remarks", "scores", "structural", "verdict"]);
    let score = &bad["scores"][0];
    assert_eq!(
        keys(score),
        [
            "answered",
            "attainable",
            "column",
            "digits",
            "exact",
            "fewest_attainable",
            "fewest_digits",
            "quantity",
            "row",
            "step",
            "verdict"
        ]
    );
    // 0.6 for 1/2, in units of √(1/2): −log₁₀(0.1 / 0.7071) = 0.849….
    assert_eq!((score["quantity"].as_str(), score["digits"].as_f64()), (Some("filtered_mean"), Some(0.8)));
    assert_eq!((score["exact"].as_str(), score["verdict"].as_str()), (Some("0.5"), Some("wrong")));
    assert_eq!(score["answered"].as_str(), Some("0.6"));
    assert_eq!(report["counts"], serde_json::json!({"agrees": 1, "wrong": 1}));
}

#[test]
fn only_some_cases() {
    let out = run(&["check", "--all", "--only", "basic/constant", "--only", "nile/missing"]).quietly(0);
    let rows: Vec<&str> =
        out.lines().filter_map(|line| line.split_whitespace().next()).filter(|word| word.contains('/')).collect();
    assert_eq!(
        rows,
        [
            "basic/constant",
            "basic/constant-velocity",
            "basic/constant-acceleration",
            "nile/missing-years",
            "nile/missing-years-diffuse"
        ]
    );
    let message = run(&["check", "--only", "no-such-thing"]).trouble();
    assert!(message.contains("no-such-thing") && message.contains("exact-kalman cases"), "{message}");
}

#[test]
fn without_a_program_it_demonstrates() {
    let arguments = ["check", "--only", "singular", "--format", "json"];
    let out = run(&arguments).quietly(0);
    let names: Vec<Value> = out
        .lines()
        .map(|line| serde_json::from_str::<Value>(line).expect("JSON on each line")["examinee"].clone())
        .collect();
    assert_eq!(
        names,
        [
            "textbook",
            "joseph",
            "pseudo-inverse",
            "symmetrised",
            "sequential",
            "square-root",
            "ud",
            "svd",
            "information"
        ]
    );
    assert_eq!(run(&arguments).stdout, out, "the same bytes twice");
    let out = run(&["check", "--only", "singular"]).quietly(0);
    assert!(out.contains("2 accepted bad input"), "{out}");
    // Forms differ on each of these; on the others all agree, and --all shows them too.
    assert!(out.contains("singular/equal-sensors") && !out.contains("singular/prior-of-rank-one"), "{out}");
    let all = run(&["check", "--only", "singular", "--all"]).quietly(0);
    assert!(all.contains("singular/prior-of-rank-one") && all.contains("15/15"), "{all}");
    assert!(out.contains("exact-kalman check -- "), "{out}");
}

#[test]
fn at_most_twenty_findings_unless_all_are_asked_for() {
    let cases: Vec<String> = (0..23).map(|k| walk(&format!("case-{k}"), &["1"])).collect();
    let directory = Directory::new();
    let file = directory.file("cases.jsonl", cases.join("\n"));
    let unsure = r#"while read -r line; do id=${line#*'"id":"'}; id=${id%%'"'*}; echo "{\"id\":\"$id\",\"outcome\":\"error\"}"; done"#;
    let arguments = ["check", "--cases", &file, "--", "sh", "-c", unsure];
    let out = run(&arguments).quietly(1);
    assert!(out.contains("23 findings, worst first") && out.contains("20. case-19: error"), "{out}");
    assert!(!out.contains("21. ") && out.contains("and 3 more findings; --all shows them"), "{out}");
    assert!(out.ends_with("23 cases: 23 error\n"), "{out}");
    let out = run(&[&["check", "--all"], &arguments[1..]].concat()).quietly(1);
    assert!(out.contains("23. case-22: error") && !out.contains("--all"), "{out}");
}

#[test]
fn a_closed_pipe_ends_quietly() {
    let mut child = program(&["check", "--only", "basic/constant"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    let ran = crate::program::Ran::of(child.wait_with_output().expect("the program ends"));
    assert_eq!((ran.code, ran.stderr.as_str()), (0, ""));
}

#[test]
fn a_full_disk_is_trouble() {
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("a full device");
    let ran = crate::program::Ran::of(
        program(&["cases"]).stdout(full).stderr(Stdio::piped()).output().expect("the program runs"),
    );
    assert!(ran.trouble().contains("cannot write"));
}

#[test]
fn a_program_that_cannot_be_started_is_trouble() {
    let message = run(&["check", "--only", "basic", "--", "no-such-program-here"]).trouble();
    assert!(message.contains("no-such-program-here") && message.contains("PATH"), "{message}");
}

#[test]
fn times_are_bounded() {
    for time in ["0", "-1", "nan", "inf", "1e9", "soon"] {
        let ran = run(&["check", "--time", time, "--only", "basic/constant"]);
        assert_eq!((ran.code, ran.stdout.as_str()), (2, ""), "{time}");
    }
}
