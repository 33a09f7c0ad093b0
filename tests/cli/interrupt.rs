//! Ctrl-C, and a reader that has seen enough.

use std::io::{BufRead as _, BufReader, Read as _};
use std::process::{Child, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use serde_json::Value;

use crate::program::{Directory, PROGRAM, Ran, walk};

/// More than any test waits for.
const PATIENCE: Duration = Duration::from_secs(120);

/// The program, with Ctrl-C as it is at a terminal: tests may themselves run in the background, where it is ignored.
fn started(arguments: &[&str]) -> Child {
    let mut command = Command::new("env");
    command.args(["--default-signal=INT", PROGRAM]).args(arguments).current_dir(env!("CARGO_MANIFEST_DIR"));
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts")
}

fn ctrl_c(child: &Child) {
    kill(Pid::from_raw(i32::try_from(child.id()).expect("it fits")), Signal::SIGINT).expect("it runs");
}

/// Waits until the program has a handler for Ctrl-C: the bit of signal 2 in what Linux tells of it.
fn listening(child: &Child) {
    let begun = Instant::now();
    let is_caught = || {
        let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).expect("it runs");
        let line = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).map(str::trim).expect("Linux tells it");
        u64::from_str_radix(line, 16).expect("a mask") & 2 != 0
    };
    while !is_caught() {
        assert!(begun.elapsed() < PATIENCE);
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// How the program ended whose output was read up to here already.
fn ended(mut child: Child, mut read: String, mut rest: BufReader<ChildStdout>) -> Ran {
    rest.read_to_string(&mut read).expect("it can be read");
    let mut stderr = Vec::new();
    child.stderr.take().expect("it is piped").read_to_end(&mut stderr).expect("it can be read");
    let status = child.wait().expect("the program ends");
    Ran::of(std::process::Output { status, stdout: read.into_bytes(), stderr })
}

/// A walk whose exact numbers take hours: 40 000 steps, each longer than the one before it.
fn endless(directory: &Directory, more: &[String]) -> String {
    let long = walk("long", &vec!["0.1"; 40_000]);
    directory.file("cases.jsonl", [&[long], more].concat().join("\n"))
}

/// The text is whole steps, the first of which are known, and the message names the first that is not.
#[test]
fn steps_that_are_known_are_printed() {
    let directory = Directory::new();
    let mut child =
        started(&["solve", &endless(&directory, &[walk("next", &["1"])]), "--digits", "3", "--tier", "exact"]);
    let (mut read, mut out) = (String::new(), BufReader::new(child.stdout.take().expect("it is piped")));
    // It is printed while the next ones are computed.
    out.read_line(&mut read).expect("it can be read");
    assert_eq!(read, "long · step 0\n");
    ctrl_c(&child);
    let ran = ended(child, read, out);
    let steps = ran.stdout.matches(" · step ").count();
    assert!((1..40_000).contains(&steps), "{steps}");
    assert_eq!(ran.stdout.lines().count(), 7 * steps, "every step is whole");
    assert!(ran.stdout.contains(&format!("long · step {}\n", steps - 1)));
    let message = format!("long: at step {steps} it was interrupted, {steps} of 40000 steps are known; ");
    assert!(ran.stderr.starts_with(&message), "{}", ran.stderr);
    assert!(ran.stderr.contains("for the rest run it again"), "{}", ran.stderr);
    assert!(ran.stderr.ends_with("interrupted: 1 more case was not begun\n"), "{}", ran.stderr);
    assert_eq!(ran.code, 130);
}

#[test]
fn an_interrupted_answer_is_an_answer() {
    let directory = Directory::new();
    let mut child = started(&["solve", &endless(&directory, &[]), "--format", "json", "--tier", "exact"]);
    let (mut read, mut out) = (vec![0; 9], BufReader::new(child.stdout.take().expect("it is piped")));
    out.read_exact(&mut read).expect("it can be read");
    ctrl_c(&child);
    let ran = ended(child, String::from_utf8(read).expect("it is text"), out);
    let answer: Value = serde_json::from_str(&ran.stdout).expect("it is JSON");
    let steps = answer["steps"].as_array().expect("as the schema has it").len();
    assert_eq!((&answer["id"], &answer["outcome"]), (&"long".into(), &"error".into()));
    assert_eq!(answer["step"], steps);
    assert!(
        answer["message"].as_str().expect("as the schema has it").starts_with("it was interrupted"),
        "{}",
        answer["message"]
    );
    assert!((1..40_000).contains(&steps) && ran.code == 130, "{steps} {}", ran.code);
    exact_kalman::protocol::Answer::parse(ran.stdout.trim_end()).expect("an answer of the protocol");
}

/// What is held back is printed, and nothing is waited for: by the readable recursion too.
#[test]
fn the_last_step_that_is_known() {
    let directory = Directory::new();
    let cases = endless(&directory, &[]);
    for more in [&[][..], &["--trace"], &["--ahead", "2"]] {
        let mut child = started(&[&["solve", &cases, "--last", "--tier", "exact"], more].concat());
        listening(&child);
        let out = BufReader::new(child.stdout.take().expect("it is piped"));
        ctrl_c(&child);
        let ran = ended(child, String::new(), out);
        assert!(ran.stdout.matches(" · step ").count() <= 1, "{}", ran.stdout);
        assert!(ran.stderr.contains("interrupted"), "{}", ran.stderr);
        assert_eq!(ran.code, 130, "{}", ran.stderr);
    }
}

#[test]
fn a_second_one_ends_at_once() {
    let directory = Directory::new();
    let cases = directory.file("cases.jsonl", walk("walk", &["1"]));
    // A program that never answers, and would be waited for.
    let mut child = started(&["check", "--time", "86400", "--cases", &cases, "--", "sh", "-c", "cat >/dev/null"]);
    listening(&child);
    let mut errors = BufReader::new(child.stderr.take().expect("it is piped"));
    ctrl_c(&child);
    let mut line = String::new();
    errors.read_line(&mut line).expect("it can be read");
    assert_eq!(line, "stopping after this case; Ctrl-C once more ends at once\n");
    ctrl_c(&child);
    assert_eq!(child.wait().expect("the program ends").code(), Some(130));
    let mut out = String::new();
    child.stdout.take().expect("it is piped").read_to_string(&mut out).expect("it can be read");
    assert_eq!(out, "");
}

/// The report is on the cases before the one that is not judged, and says that it is not on all of them.
#[test]
fn an_interrupted_report_is_incomplete() {
    let directory = Directory::new();
    let cases = directory.file("cases.jsonl", ["a", "b", "c"].map(|id| walk(id, &["1"])).join("\n"));
    // It says when it is asked the second case, and waits with all answers but the first until it may go on.
    let (asked, gate) = (directory.path().join("asked"), directory.path().join("gate"));
    let script = format!(
        r#"while read -r line; do id=${{line#*'"id":"'}}; id=${{id%%'"'*}}
[ "$id" = a ] || {{ touch '{}'; while [ ! -e '{}' ]; do sleep 0.05; done; }}
echo "{{\"id\":\"$id\",\"outcome\":\"answered\",\"steps\":[{{\"filtered_mean\":[\"0.5\"]}}]}}"; done"#,
        asked.display(),
        gate.display()
    );
    for format in ["text", "json"] {
        let mut child =
            started(&["check", "--time", "100", "--format", format, "--cases", &cases, "--", "sh", "-c", &script]);
        let begun = Instant::now();
        while !asked.exists() {
            assert!(begun.elapsed() < PATIENCE);
            std::thread::sleep(Duration::from_millis(5));
        }
        ctrl_c(&child);
        let mut line = String::new();
        BufReader::new(child.stderr.take().expect("it is piped")).read_line(&mut line).expect("it can be read");
        assert!(line.starts_with("stopping after this case"), "{line}");
        std::fs::write(&gate, "").expect("the temporary directory is ours");
        let output = child.wait_with_output().expect("the program ends");
        let out = String::from_utf8(output.stdout).expect("it is text");
        // Whether the second is judged depends on whether its truth is known by then; the third is not asked.
        let judged = if format == "json" {
            let report: Value = serde_json::from_str(&out).expect("it is JSON");
            assert_eq!(report["cases"][0]["id"], "a");
            3 - usize::try_from(report["unjudged"].as_u64().expect("as the schema has it")).expect("it fits")
        } else {
            3 - [1, 2].into_iter().find(|left| out.contains(&incomplete(*left))).unwrap_or_else(|| panic!("{out}"))
        };
        assert!([1, 2].contains(&judged), "{out}");
        assert_eq!(output.status.code(), Some(130));
        std::fs::remove_file(&gate).expect("the temporary directory is ours");
        std::fs::remove_file(&asked).expect("the temporary directory is ours");
    }
}

fn incomplete(left: usize) -> String {
    format!("incomplete: interrupted, and {left} more case{} not judged\n", if left == 1 { "" } else { "s" })
}

/// The saved answers are judged by threads; a truth that is not known by then is not waited for.
#[test]
fn judging_saved_answers_can_be_interrupted() {
    let directory = Directory::new();
    let many: Vec<String> = (0..3_000).map(|k| walk(&format!("walk-{k}"), &["1"; 40])).collect();
    let cases = directory.file("cases.jsonl", many.join("\n"));
    let answers: Vec<String> =
        (0..3_000).map(|k| format!(r#"{{"id":"walk-{k}","outcome":"answered","steps":[]}}"#)).collect();
    let answers = directory.file("answers.jsonl", answers.join("\n"));
    for jobs in ["1", "3"] {
        let mut child = started(&["judge", &answers, "--cases", &cases, "--jobs", jobs, "--format", "json"]);
        listening(&child);
        let out = BufReader::new(child.stdout.take().expect("it is piped"));
        ctrl_c(&child);
        let ran = ended(child, String::new(), out);
        let report: Value = serde_json::from_str(&ran.stdout).expect("it is JSON");
        let judged = report["cases"].as_array().expect("as the schema has it");
        assert_eq!(report["unjudged"], 3_000 - judged.len());
        assert!(judged.iter().enumerate().all(|(k, case)| case["id"] == format!("walk-{k}")));
        assert_eq!(ran.code, 130);
    }
}

#[test]
fn a_closed_pipe_ends_a_long_run_quietly() {
    let directory = Directory::new();
    let cases = endless(&directory, &[]);
    for more in [&[][..], &["--format", "json"], &["--trace"], &["--tier", "exact"]] {
        let mut child = started(&[&["solve", &cases], more].concat());
        let mut out = child.stdout.take().expect("it is piped");
        out.read_exact(&mut [0; 9]).expect("it can be read");
        drop(out);
        let ran = Ran::of(child.wait_with_output().expect("the program ends"));
        assert_eq!((ran.code, ran.stderr.as_str()), (0, ""));
    }
}
