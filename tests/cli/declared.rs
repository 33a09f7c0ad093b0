//! What a subject declares: which cases are asked, and what the report says.

use std::fs;

use serde_json::Value;

use crate::program::{Directory, run, walk};

/// A walk with flags.
fn flagged(id: &str, flags: &str) -> String {
    walk(id, &["1"]).replace("\"timing\"", &format!("\"flags\":[{flags}],\"timing\""))
}

/// Three walks; what the second needs is declared unsupported.
fn cases(directory: &Directory) -> String {
    let cases = [flagged("a", "\"basic\""), flagged("b", "\"basic\",\"diffuse\""), flagged("c", "")];
    directory.file("cases.jsonl", cases.join("\n"))
}

/// Answers each walk, and writes down what it was asked.
fn serving(directory: &Directory, declaration: &str) -> String {
    let asked = directory.path().join("asked");
    format!(
        r#"{declaration}; while read -r line; do id=${{line#*'"id":"'}}; id=${{id%%'"'*}}; echo "$id" >> {};
        echo "{{\"id\":\"$id\",\"outcome\":\"answered\",\"steps\":[{{\"filtered_mean\":[\"0.5\"]}}]}}"; done"#,
        asked.display()
    )
}

fn asked(directory: &Directory) -> String {
    fs::read_to_string(directory.path().join("asked")).expect("it was asked").replace('\n', " ")
}

const DECLARE: &str = r#"echo '{"format":"exact-kalman/subject/1","name":"walker 1.0","unsupported":["diffuse"]}'"#;

#[test]
fn what_is_unsupported_is_not_asked() {
    let directory = Directory::new();
    let cases = cases(&directory);
    let script = serving(&directory, DECLARE);
    let out = run(&["check", "--cases", &cases, "--", "sh", "-c", &script]).quietly(0);
    assert_eq!(asked(&directory), "a c ");
    assert!(out.contains("\ndeclares: walker 1.0; unsupported: diffuse\n"), "{out}");
    assert!(out.ends_with("3 cases: 2 agrees, 1 unsupported\n") && !out.contains("note:"), "{out}");
    let out = run(&["check", "--cases", &cases, "--format", "json", "--", "sh", "-c", &script]).quietly(0);
    let report: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!(report["declaration"]["name"], "walker 1.0");
    assert_eq!(report["declaration"]["unsupported"], serde_json::json!(["diffuse"]));
    assert_eq!(report["cases"][1]["verdict"], "unsupported");
    let remark = report["cases"][1]["remarks"][0].as_str().expect("why");
    assert!(remark.contains("declares") && remark.contains("«diffuse»"), "{remark}");
}

#[test]
fn the_first_case_is_asked_before_it_is_known() {
    let directory = Directory::new();
    let cases = directory.file("cases.jsonl", [flagged("b", "\"diffuse\""), flagged("a", "")].join("\n"));
    // Whatever comes back for it, a death included.
    for script in [serving(&directory, DECLARE), format!("{DECLARE}; read -r line; exit 1")] {
        let out = run(&["check", "--cases", &cases, "--format", "json", "--", "sh", "-c", &script]);
        let report: Value = serde_json::from_str(&out.stdout).expect("JSON");
        assert_eq!(report["cases"][0]["verdict"], "unsupported", "{script}");
    }
    assert_eq!(asked(&directory), "b a ");
}

#[test]
fn all_unsupported_is_nothing_judged() {
    let directory = Directory::new();
    let cases = directory.file("cases.jsonl", flagged("b", "\"diffuse\""));
    run(&["check", "--cases", &cases, "--", "sh", "-c", &serving(&directory, DECLARE)]).quietly(3);
}

#[test]
fn a_flag_that_no_case_has_is_told() {
    let directory = Directory::new();
    let cases = cases(&directory);
    let declare = DECLARE.replace("\"diffuse\"", r#""difuse","\u001b[2J","singular","own""#);
    let own = directory.file("own.jsonl", flagged("a", "\"own\"") + "\n" + &flagged("d", ""));
    let out = run(&["check", "--cases", &own, "--", "sh", "-c", &serving(&directory, &declare)]).quietly(0);
    // What the suite has is known, and so is what cases of one's own have.
    assert!(out.contains(r#"so without effect: "difuse", "\u{1b}[2J""#), "{out}");
    let note = out.lines().find(|line| line.starts_with("note: ")).expect("a note");
    assert!(!note.contains("singular") && !note.contains("own\""), "{note}");
    let bad = DECLARE.replace("\"name\"", "\"nam\"");
    let out = run(&["check", "--cases", &cases, "--", "sh", "-c", &serving(&directory, &bad)]).quietly(0);
    assert!(out.contains("note: a declaration was passed over: nam: unknown field `nam`"), "{out}");
    assert!(out.ends_with("3 cases: 3 agrees\n") && !out.contains("declares:"), "{out}");
}

#[test]
fn saved_answers_may_begin_with_it() {
    let directory = Directory::new();
    let cases = cases(&directory);
    let answer = |id: &str, mean: &str| {
        format!(r#"{{"id":"{id}","outcome":"answered","steps":[{{"filtered_mean":["{mean}"]}}]}}"#)
    };
    let declaration = r#"{"format":"exact-kalman/subject/1","name":"walker 1.0","unsupported":["diffuse"]}"#;
    let judged = |lines: &[&str], code| {
        let answers = directory.file("answers.jsonl", lines.join("\n"));
        run(&["judge", &cases, &answers]).quietly(code)
    };
    let (a, b, c) = (answer("a", "0.5"), answer("b", "7"), answer("c", "0.5"));
    // With or without an answer to what is declared unsupported: as if it had not been asked.
    for lines in [&[declaration, &a, &c][..], &[declaration, &a, &b, &c]] {
        let out = judged(lines, 0);
        assert!(out.contains("declares: walker 1.0") && out.ends_with("3 cases: 2 agrees, 1 unsupported\n"), "{out}");
    }
    let out = judged(&[&a, declaration, &b, &c], 1);
    assert!(out.contains("note: a declaration was passed over: it came after an answer"), "{out}");
    assert!(out.contains("1. b: wrong"), "{out}");
}

#[test]
fn a_declaration_of_64_megabytes_is_passed_over() {
    let directory = Directory::new();
    let cases = cases(&directory);
    let huge =
        r#"printf '{"format":"exact-kalman/subject/1","name":"'; head -c 64000000 /dev/zero | tr '\0' x; echo '"}'"#;
    let out = run(&["check", "--cases", &cases, "--", "sh", "-c", &serving(&directory, huge)]).quietly(0);
    assert!(out.contains("at most 65536") && out.ends_with("3 cases: 3 agrees\n") && out.len() < 4000, "{out:.4000}");
}

#[test]
fn cases_are_named_once() {
    let directory = Directory::new();
    let cases = cases(&directory);
    assert!(run(&["judge", &cases, &cases, "--cases", &cases]).trouble().contains("named twice"));
    assert!(run(&["judge", "-", "-"]).trouble().contains("standard input"));
    assert!(run(&["judge"]).trouble().contains("Usage: exact-kalman judge [OPTIONS] [CASES] <ANSWERS>"));
}
