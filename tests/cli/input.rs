//! What files may hold, and what is said of those that do not.

use std::fs;
use std::os::unix::fs::symlink;

use crate::program::{Directory, feed, run, walk};

/// The message with which a text is refused as a file of cases.
fn refusal(text: impl AsRef<[u8]>) -> String {
    let directory = Directory::new();
    let file = directory.file("case.json", text);
    let message = run(&["cases", "--cases", &file]).trouble();
    assert!(message.contains("case.json"), "{message}");
    message
}

#[test]
fn one_case_or_one_on_each_line() {
    let pretty = fs::read_to_string("examples/cases/walk.json").expect("a readable file");
    for (text, count) in [
        (walk("a", &["1"]), 1),
        (format!("\n\n{}\n\n{}\r\n\n", walk("a", &["1"]), walk("b", &["1"])), 2),
        (pretty.clone(), 1),
        (format!("\u{feff}{pretty}"), 1),
        (format!("\u{feff}{}\n{}", walk("a", &["1"]), walk("b", &["1"])), 2),
    ] {
        assert_eq!(feed(&["cases", "--cases", "-"], &text).quietly(0).lines().count(), count);
    }
}

#[test]
fn nothing() {
    for text in ["", "\n", "  \n\n"] {
        assert!(refusal(text).contains("there is no case in it"));
    }
    let directory = Directory::new();
    directory.file("notes.txt", "no case");
    assert!(run(&["cases", "--cases", directory.name()]).trouble().contains("there is no case in it"));
    let message = run(&["cases", "--cases", "no/such/file.json"]).trouble();
    assert!(message.contains("no/such/file.json") && message.contains("No such file"), "{message}");
    assert!(feed(&["cases", "--cases", "-"], "").trouble().contains("there is no case in it"));
}

#[test]
fn mistakes_are_located() {
    let good = walk("a", &["1"]);
    let message = refusal(good.replace("\"transition\"", "\"transitions\""));
    assert!(message.contains("unknown field `transitions`"), "{message}");
    let message = refusal(&good[..good.len() / 2]);
    assert!(message.contains("EOF"), "{message}");
    let message = refusal(format!("{good}\n{{\"format\":"));
    assert!(message.contains("case.json, line 2: format: the text ends too early"), "{message}");
    let message = refusal(good.replace("\"id\":\"a\"", "\"id\":\"\""));
    assert!(message.contains("id: is empty"), "{message}");
    // The first line counts as well, if it is a document at all.
    let message = refusal(format!("{}\n{good}", good.replace("\"timing\"", "\"time\"")));
    assert!(message.contains("case.json, line 1: time: unknown field `time`"), "{message}");
    assert!(refusal([0xff, 0xfe]).contains("UTF-8"));
    assert!(refusal("[1, 2]").contains("case"), "a list is no case");
}

#[test]
fn ids_are_used_once() {
    let good = walk("a", &["1"]);
    let message = refusal(format!("{good}\n{good}"));
    assert!(message.contains("\"a\" is used twice"), "{message}");
    let directory = Directory::new();
    directory.file("one.json", &good);
    directory.file("deep/two.jsonl", &good);
    assert!(run(&["cases", "--cases", directory.name()]).trouble().contains("one.json"));
}

#[test]
fn directories_are_read_in_order_and_links_do_not_lead_in_circles() {
    let directory = Directory::new();
    for name in ["b.json", "a/z.json", "a/y.jsonl", "c.txt"] {
        directory.file(name, walk(name, &["1"]));
    }
    // One link only: were it followed, the system would end it after forty rounds.
    symlink(directory.path(), directory.path().join("a/loop.json")).expect("a writable directory");
    let out = run(&["cases", "--cases", directory.name()]).quietly(0);
    let ids: Vec<&str> = out.lines().map(str::trim_end).collect();
    assert_eq!(ids, ["a/y.jsonl", "a/z.json", "b.json"]);
}

#[test]
fn what_is_too_long_is_not_read() {
    let directory = Directory::new();
    let file = directory.file("long.json", "");
    fs::OpenOptions::new().write(true).open(&file).expect("a new file").set_len(65 << 20).expect("room on the disk");
    for arguments in [["solve", &file].as_slice(), &["check", "--cases", &file], &["judge", &file]] {
        let message = run(arguments).trouble();
        assert!(message.contains("long.json holds more than 67108864 bytes"), "{message}");
    }
    // A file without an end as well.
    assert!(run(&["solve", "/dev/zero"]).trouble().contains("more than"));
}

#[test]
fn usage() {
    for arguments in [
        &[][..],
        &["no-such-verb"],
        &["solve"],
        &["check", "python3"],
        &["check", "--format", "xml"],
        &["judge"],
        &["cases", "--no-such-option"],
    ] {
        let ran = run(arguments);
        assert_eq!((ran.code, ran.stdout.as_str()), (2, ""), "{arguments:?}");
        assert!(ran.stderr.contains("--help") || ran.stderr.contains("Usage:"), "{}", ran.stderr);
    }
}
