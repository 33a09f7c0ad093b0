//! Subjects that misbehave are findings, in bounded time, and never the program's own failure.

use std::time::{Duration, Instant};

use crate::program::{Directory, run, walk};

/// The report on a shell script that is asked two walks, half a second each.
fn on(script: &str) -> String {
    let directory = Directory::new();
    let file = directory.file("cases.jsonl", [walk("first", &["1"]), walk("second", &["1"])].join("\n"));
    let start = Instant::now();
    let ran = run(&["check", "--time", "0.5", "--cases", &file, "--", "sh", "-c", script]);
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
    ran.quietly(1)
}

/// An answer to the case that was read, right but for what a script makes of it.
const ANSWER: &str = r#"right() { echo "{\"id\":\"$1\",\"outcome\":\"answered\",\"steps\":[{\"filtered_mean\":[\"0.5\"]}]}"; }
id_of() { id=${line#*'"id":"'}; id=${id%%'"'*}; }
"#;

#[test]
fn it_hangs() {
    let out = on("sleep 1000");
    assert!(out.ends_with("2 cases: 2 timed out\n") && out.contains("no answer within 500ms"), "{out}");
}

#[test]
fn it_dies() {
    let out = on("read -r line; echo 'last words' >&2; exit 7");
    assert!(out.ends_with("2 cases: 2 died\n") && out.contains("exit status: 7"), "{out}");
    assert!(out.contains("   died before it answered") && out.contains("last words\n"), "{out}");
}

#[test]
fn its_last_words_are_cut_and_harmless() {
    let out = on(r"read -r line; for k in $(seq 1 100); do printf 'frame %s \033[31m\a\n' $k >&2; done; exit 1");
    assert!(out.contains("frame 100 ") && !out.contains("frame 50 ") && out.contains(" lines …"), "{out}");
    assert!(!out.contains('\u{7}'), "{out:?}");
}

#[test]
fn it_floods() {
    let out = on("cat /dev/zero");
    assert!(out.contains("timed out") || out.contains("printed more than"), "{out}");
}

#[test]
fn it_prints_stray_lines() {
    let directory = Directory::new();
    let file = directory.file("cases.jsonl", walk("first", &["1"]));
    let script = format!("{ANSWER} echo banner; while read -r line; do id_of; echo debug; right \"$id\"; done");
    let out = run(&["check", "--cases", &file, "--", "sh", "-c", &script]).quietly(0);
    assert!(out.contains(r#"note: 2 stray lines on standard output passed over: "banner", "debug""#), "{out}");
}

#[test]
fn it_answers_out_of_order() {
    let out = on(&format!("{ANSWER} while read -r line; do right second; done"));
    assert!(out.contains(r#"asked "first", answered "second""#), "{out}");
    // It is started again, and then happens to be in step.
    assert!(out.ends_with("2 cases: 1 agrees, 1 malformed\n"), "{out}");
}

#[test]
fn it_answers_not_a_number() {
    let quoted = r#"while read -r line; do id_of; echo "{\"id\":\"$id\",\"outcome\":\"answered\",\"steps\":[{\"filtered_mean\":[\"NaN\"]}]}"; done"#;
    let out = on(&format!("{ANSWER} {quoted}"));
    assert!(out.ends_with("2 cases: 2 wrong\n") && out.contains("filtered mean at step 0 has an entry NaN"), "{out}");
    let bare = quoted.replace(r#"\"NaN\""#, "NaN");
    let out = on(&format!("{ANSWER} {bare}"));
    assert!(out.ends_with("2 cases: 2 malformed\n") && out.contains("in quotes"), "{out}");
}

#[test]
fn it_answers_garbage_that_begins_well() {
    let out = on("while read -r line; do echo '{garbage'; done");
    assert!(out.ends_with("2 cases: 2 malformed\n") && out.contains("{garbage"), "{out}");
    let out = on("while read -r line; do printf '{\"id\":\"\\377\"}\\n'; done");
    assert!(out.ends_with("2 cases: 2 malformed\n") && out.contains("UTF-8"), "{out}");
}

#[test]
fn it_closes_its_output() {
    let out = on("exec 1>&-; sleep 1000");
    assert!(out.ends_with("2 cases: 2 died\n") || out.ends_with("2 cases: 2 timed out\n"), "{out}");
}
