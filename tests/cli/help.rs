//! Help is read aloud, and its examples are run.

use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::{PermissionsExt as _, symlink};
use std::path::Path;
use std::process::{Command, Stdio};

use crate::program::{Directory, PROGRAM, Ran, run};

const VERBS: [&str; 15] = [
    "solve",
    "check",
    "judge",
    "cases",
    "estimate",
    "identify",
    "stability",
    "reproduce",
    "reproduce AK-Tab1",
    "reproduce HV-Tab1",
    "reproduce HV-Fig1",
    "reproduce HV-Fig2",
    "prove",
    "spec",
    "verify",
];

fn help(verb: Option<&str>) -> String {
    let words = verb.into_iter().flat_map(str::split_whitespace);
    let arguments: Vec<&str> = words.chain(["--help"]).collect();
    run(&arguments).quietly(0)
}

/// The commands under «Examples:», without what is said about them.
fn examples(help: &str) -> Vec<String> {
    let lines = help.lines().skip_while(|line| *line != "Examples:").skip(1);
    lines
        .take_while(|line| line.starts_with("  "))
        .map(|line| line.trim_start().split("  ").next().unwrap_or_default().to_owned())
        .collect()
}

/// A place like the root of the project, with the two programs that the examples speak of.
fn place() -> Directory {
    let directory = Directory::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    symlink(root.join("examples"), directory.path().join("examples")).expect("a writable directory");
    fs::copy(root.join("examples/subjects/textbook.py"), directory.path().join("my_filter.py"))
        .expect("a writable directory");
    let script = directory.file("my_filter", "#!/bin/sh\nexec python3 my_filter.py\n");
    fs::set_permissions(script, fs::Permissions::from_mode(0o755)).expect("a writable directory");
    directory
}

fn shell(line: &str, directory: &Path) -> Ran {
    let programs = Path::new(PROGRAM).parent().expect("a directory");
    let path = format!("{}:{}", programs.display(), std::env::var("PATH").unwrap_or_default());
    let mut command = Command::new("sh");
    command.args(["-c", line]).current_dir(directory).env("PATH", path).stdin(Stdio::null());
    Ran::of(command.output().expect("the program starts"))
}

/// Examples that judge the whole suite again.
const AGAIN: [&str; 2] =
    ["exact-kalman check --report judged.xml -- ./my_filter", "exact-kalman judge cases.jsonl answers.jsonl"];

/// The whole suite is judged once by each verb; examples that show something else of it are content with a part.
fn shortened(line: &str) -> String {
    if AGAIN.contains(&line) {
        let few = |line: String, verb: &str| line.replacen(verb, &format!("{verb} --only nile"), 1);
        return few(few(line.to_owned(), "exact-kalman check"), "exact-kalman judge");
    }
    line.to_owned()
}

#[test]
fn every_example_runs() {
    let python = Command::new("python3").arg("--version").output().is_ok();
    let (mut count, mut seen) = (0, BTreeSet::new());
    for verb in [None].into_iter().chain(VERBS.map(Some)) {
        let directory = place();
        let lines = examples(&help(verb));
        assert!(lines.len() >= 3, "{verb:?}");
        for line in lines {
            if !python && (line.contains("python3") || line.contains("my_filter") || line.contains("answers.jsonl")) {
                continue;
            }
            // Some stand on two pages.
            if line.starts_with("exact-kalman check") && !seen.insert(line.clone()) {
                continue;
            }
            let ran = shell(&shortened(&line), directory.path());
            // Findings on the textbook filter, a mean that grows, and nothing else that is not clean.
            let findings = line.contains("exact-kalman check ") && line.contains("--") && !line.contains("--cases")
                || line.contains("exact-kalman judge ")
                || line.contains("bursts.json");
            assert_eq!(ran.code, i32::from(findings), "{line}: {}{}", ran.stdout, ran.stderr);
            let quiet = line.contains('>') || line.contains("--out") || line.contains("--certificate");
            assert_eq!(ran.stdout.is_empty(), quiet, "{line}: {}", ran.stdout);
            count += 1;
        }
    }
    assert!(!python || count >= 18, "{count}");
    for line in AGAIN {
        let pages = ["check", "judge"].map(|verb| examples(&help(Some(verb))));
        assert!(pages.iter().flatten().any(|example| example == line), "{line} is no example any more");
    }
}

#[test]
fn help_fits_and_is_finished() {
    for verb in [None].into_iter().chain(VERBS.map(Some)) {
        let text = help(verb);
        for line in text.lines() {
            assert!(line.chars().count() <= 100, "{line}");
            assert!(!line.contains("TODO") && !line.contains("[env:"), "{line}");
        }
        // Every option is explained: something follows its name.
        let lines: Vec<&str> = text.lines().collect();
        for (place, line) in lines.iter().enumerate().filter(|(_, line)| line.trim_start().starts_with("--")) {
            assert!(lines.get(place + 1).is_some_and(|next| next.len() > 12) || line.contains("   "), "{line}");
        }
        assert!(!text.contains("Options:") || text.contains("Examples:"), "{text}");
    }
}

#[test]
fn exit_codes_are_told() {
    for verb in [None, Some("check"), Some("solve")] {
        let text = help(verb);
        let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains("Exit codes: 0 all"), "{text}");
    }
}

#[test]
fn defaults_are_told() {
    let check = help(Some("check"));
    assert!(check.contains("[default: 10]") && check.contains("[default: text]"), "{check}");
    assert!(check.contains("built-in suite]") && check.contains("built-in f64 filters]"), "{check}");
    assert!(help(Some("solve")).contains("[default: 17]"));
}

#[test]
fn the_version_is_that_of_the_package() {
    assert_eq!(run(&["--version"]).quietly(0), format!("exact-kalman {}\n", env!("CARGO_PKG_VERSION")));
}
