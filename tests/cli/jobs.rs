//! The report does not depend on how many threads compute.

use crate::program::{Directory, run, walk};

/// Every kind of case, and one that is no problem.
fn cases(directory: &Directory) -> String {
    let selection = ["cases", "--only", "basic", "--only", "singular", "--only", "refuse", "--format", "json"];
    let suite = run(&selection).quietly(0);
    directory.file("cases.jsonl", suite + &walk("wordless", &["NaN"]))
}

fn same_with_all(arguments: &[&str]) -> String {
    let [one, four, default] = [&["--jobs", "1"][..], &["--jobs", "4"], &[]]
        .map(|jobs| run(&[&arguments[..1], jobs, &arguments[1..]].concat()));
    assert_eq!((one.code, &one.stdout, &one.stderr), (four.code, &four.stdout, &four.stderr));
    assert_eq!((one.code, &one.stdout, &one.stderr), (default.code, &default.stdout, &default.stderr));
    one.stdout
}

#[test]
fn judging_gives_the_same_bytes_with_one_thread_and_with_four() {
    let directory = Directory::new();
    let cases = cases(&directory);
    // Rounded to four digits, so that there are findings of many kinds.
    let answers = run(&["solve", &cases, "--digits", "4", "--format", "json"]).stdout;
    let answers = directory.file("answers.jsonl", answers);
    for format in ["text", "json"] {
        let out = same_with_all(&["judge", &answers, "--cases", &cases, "--all", "--format", format]);
        assert!(out.contains("loses") && out.contains("undecided") && out.contains("agrees"), "{out}");
    }
}

#[test]
fn checking_gives_the_same_bytes_with_one_thread_and_with_four() {
    let directory = Directory::new();
    let cases = cases(&directory);
    for format in ["text", "json"] {
        same_with_all(&["check", "--cases", &cases, "--format", format]);
    }
    let out = same_with_all(&["check", "--cases", &cases, "--", "sh", "-c", "echo banner; cat"]);
    assert!(out.contains("malformed") && out.contains("stray"), "{out}");
}

#[test]
fn jobs_are_bounded() {
    for jobs in ["0", "257", "-1", "all"] {
        assert_eq!(run(&["check", "--jobs", jobs, "--only", "basic/constant"]).code, 2, "{jobs}");
    }
}
