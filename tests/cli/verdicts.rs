//! The page of verdicts: each example on it is judged as it says there, in the words that stand there.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::program::{Directory, run};

const PAGE: &str = include_str!("../../docs/VERDICTS.md");

const VERDICTS: [&str; 13] = [
    "agrees",
    "unsupported",
    "undecided",
    "loses digits",
    "asymmetric",
    "not psd",
    "refused valid input",
    "error",
    "accepted bad input",
    "wrong",
    "timed out",
    "died",
    "malformed",
];

/// The fenced blocks of a text, each with what stands after the fence.
fn blocks(text: &str) -> Vec<(&str, &str)> {
    let fenced = text.split("```").skip(1).step_by(2);
    fenced.map(|block| block.split_once('\n').expect("a block has lines")).collect()
}

/// A document of the page on one line.
fn on_one_line(document: &str) -> String {
    serde_json::from_str::<Value>(document).expect("JSON").to_string()
}

fn id_of(document: &str) -> String {
    let value: Value = serde_json::from_str(document).expect("JSON");
    value["id"].as_str().expect("an id").to_owned()
}

/// The report on an example, as text and as JSON.
fn reports(verdict: &str, kind: &str, example: &str, cases: &BTreeMap<String, &str>, code: i32) -> [String; 2] {
    let directory = Directory::new();
    let id = if kind == "json answer" { id_of(example) } else { "half".to_owned() };
    let file = directory.file("cases.jsonl", on_one_line(cases[&id]));
    ["text", "json"].map(|format| {
        let ran = if kind == "json answer" {
            run(&["judge", &file, &directory.file("answers.jsonl", on_one_line(example)), "--format", format])
        } else {
            // Short only where it shall run out: a shell may start late.
            let time: &[&str] = if verdict == "timed out" { &["--time", "0.5"] } else { &[] };
            let subject = ["--cases", &file, "--format", format, "--", "sh", "-c", example.trim_end()];
            run(&[&["check"], time, &subject].concat())
        };
        ran.quietly(code)
    })
}

#[test]
fn every_example_of_the_page_is_judged_as_it_says() {
    let cases: BTreeMap<String, &str> = blocks(PAGE)
        .into_iter()
        .filter(|(kind, _)| *kind == "json case")
        .map(|(_, case)| (id_of(case), case))
        .collect();
    let mut judged = Vec::new();
    for section in PAGE.split("\n## ").skip(1) {
        let (verdict, rest) = section.split_once('\n').expect("a heading has a line");
        let blocks = blocks(rest);
        for ((kind, example), (next, words)) in blocks.iter().zip(blocks.iter().skip(1)) {
            if !["json answer", "sh subject"].contains(kind) {
                continue;
            }
            assert_eq!(*next, "text", "{verdict}: the words follow the example");
            let code = match verdict {
                "agrees" => 0,
                "unsupported" | "undecided" => 3,
                _ => 1,
            };
            let [text, json] = reports(verdict, kind, example, &cases, code);
            assert!(text.contains(words), "{verdict}: {words} in {text}");
            let report: Value = serde_json::from_str(&json).expect("JSON");
            assert_eq!(report["cases"][0]["verdict"], verdict, "{text}");
            judged.push(verdict);
        }
    }
    assert_eq!(judged, VERDICTS, "one example each, in the order of the table");
}

/// The page's table says of each verdict whether it is a finding, and points to its section.
#[test]
fn the_table_names_them_all() {
    let table: Vec<&str> = PAGE.lines().filter(|line| line.starts_with("| [")).collect();
    for verdict in VERDICTS {
        let link = format!("[{verdict}](#{})", verdict.replace(' ', "-"));
        let row = table.iter().find(|row| row.contains(&link)).unwrap_or_else(|| panic!("{verdict} has no row"));
        let is_finding = !["agrees", "unsupported", "undecided"].contains(&verdict);
        assert!(row.contains(if is_finding { "| yes |" } else { "| no |" }), "{row}");
    }
}
