//! `cases`: the suite as a list, as a stream, as files.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::{Directory, feed, run, walk};

fn below(directory: &Path, files: &mut Vec<std::path::PathBuf>) {
    for entry in fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() { below(&path, files) } else { files.push(path) }
    }
}

#[test]
fn files_say_what_the_stream_says() {
    let directory = Directory::new();
    let ran = run(&["cases", "--out", directory.name()]);
    assert_eq!((ran.code, ran.stdout.as_str()), (0, ""));
    let stream = run(&["cases", "--format", "json"]).quietly(0);
    let stream: BTreeMap<String, Value> = stream
        .lines()
        .map(|line| serde_json::from_str::<Value>(line).unwrap())
        .map(|case| (case["id"].as_str().unwrap().to_owned(), case))
        .collect();
    assert!(ran.stderr.starts_with(&format!("{} cases written below ", stream.len())), "{}", ran.stderr);
    let mut files = Vec::new();
    below(directory.path(), &mut files);
    assert_eq!(files.len(), stream.len());
    for file in files {
        let id = file.strip_prefix(directory.path()).unwrap().with_extension("").to_str().unwrap().to_owned();
        let case: Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
        assert_eq!(case, stream[&id], "{id}");
    }
    // They can be read back as a directory.
    let again = run(&["cases", "--cases", directory.name(), "--format", "json"]).quietly(0);
    let ids: std::collections::BTreeSet<String> = again
        .lines()
        .map(|line| serde_json::from_str::<Value>(line).unwrap()["id"].as_str().unwrap().to_owned())
        .collect();
    assert!(ids.iter().eq(stream.keys()), "{ids:?}");
}

#[test]
fn the_list_names_every_case() {
    let list = run(&["cases"]).quietly(0);
    let stream = run(&["cases", "--format", "json"]).quietly(0);
    assert_eq!(list.lines().count(), stream.lines().count());
    assert!(list.starts_with("basic/constant "), "{list}");
    assert_eq!(list, run(&["cases"]).stdout);
}

#[test]
fn ids_that_lead_elsewhere_are_not_written() {
    for id in ["../outside", "/etc/outside", "a//b", ".hidden", "a/..", "a\\\\b"] {
        let directory = Directory::new();
        let inner = directory.path().join("inner");
        let stream = [walk("fine", &["1"]), walk(id, &["1"])].join("\n");
        let message = feed(&["cases", "--cases", "-", "--out", inner.to_str().unwrap()], &stream).trouble();
        assert!(message.contains("cannot be the name of a file"), "{message}");
        assert!(fs::read_dir(directory.path()).unwrap().next().is_none(), "{id}: something was written");
    }
}

#[test]
fn the_example_of_the_nile_is_that_of_the_suite() {
    let ours: Value = serde_json::from_str(include_str!("../../examples/cases/nile.json")).unwrap();
    let suite = run(&["cases", "--only", "nile/diffuse", "--format", "json"]).quietly(0);
    assert_eq!(ours, serde_json::from_str::<Value>(&suite).unwrap());
}
