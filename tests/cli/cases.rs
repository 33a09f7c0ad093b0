//! `cases`: the suite as a list, as a stream, as files.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::{Directory, feed, run, walk};

fn below(directory: &Path, files: &mut Vec<std::path::PathBuf>) {
    for entry in fs::read_dir(directory).expect("a directory that was written") {
        let path = entry.expect("a readable entry").path();
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
        .map(|line| serde_json::from_str::<Value>(line).expect("JSON on each line"))
        .map(|case| (case["id"].as_str().expect("an id").to_owned(), case))
        .collect();
    assert!(ran.stderr.starts_with(&format!("{} cases written below ", stream.len())), "{}", ran.stderr);
    let mut files = Vec::new();
    below(directory.path(), &mut files);
    assert_eq!(files.len(), stream.len());
    for file in files {
        let id =
            file.strip_prefix(directory.path()).expect("inside").with_extension("").to_str().expect("ASCII").to_owned();
        let case: Value = serde_json::from_str(&fs::read_to_string(&file).expect("a file")).expect("JSON");
        assert_eq!(case, stream[&id], "{id}");
    }
    // They can be read back as a directory.
    let again = run(&["cases", "--cases", directory.name(), "--format", "json"]).quietly(0);
    let ids: std::collections::BTreeSet<String> = again
        .lines()
        .map(|line| {
            serde_json::from_str::<Value>(line).expect("JSON on each line")["id"].as_str().expect("an id").to_owned()
        })
        .collect();
    assert!(ids.iter().eq(stream.keys()), "{ids:?}");
}

#[test]
fn the_list_names_every_case() {
    let list = run(&["cases"]).quietly(0);
    let stream = run(&["cases", "--format", "json"]).quietly(0);
    let ids = list.lines().filter_map(|line| line.strip_prefix("  ")).filter_map(|line| line.split(' ').next());
    let all = stream.lines().map(|line| serde_json::from_str::<Value>(line).expect("JSON")["id"].clone());
    assert!(ids.map(Value::from).eq(all), "{list}");
    // Each category has a heading that explains it.
    let headings: Vec<&str> = list.lines().filter(|line| !line.starts_with("  ") && !line.is_empty()).collect();
    let known = exact_kalman::judge::categories();
    let expected: Vec<String> = known.iter().map(|category| format!("{}: {}", category.name, category.about)).collect();
    assert_eq!(headings, expected);
    assert!(list.starts_with("basic: ") && list.contains("\n  basic/constant "), "{list}");
    assert_eq!(list, run(&["cases"]).stdout);
}

#[test]
fn ids_that_lead_elsewhere_are_not_written() {
    for id in ["../outside", "/etc/outside", "a//b", ".hidden", "a/..", "a\\\\b"] {
        let directory = Directory::new();
        let inner = directory.path().join("inner");
        let stream = [walk("fine", &["1"]), walk(id, &["1"])].join("\n");
        let message = feed(&["cases", "--cases", "-", "--out", inner.to_str().expect("ASCII")], &stream).trouble();
        assert!(message.contains("cannot be the name of a file"), "{message}");
        assert!(
            fs::read_dir(directory.path()).expect("the directory is there").next().is_none(),
            "{id}: something was written"
        );
    }
}

#[test]
fn the_example_of_the_nile_is_that_of_the_suite() {
    let ours: Value = serde_json::from_str(include_str!("../../examples/cases/nile.json")).expect("JSON");
    let suite = run(&["cases", "--only", "nile/diffuse", "--format", "json"]).quietly(0);
    assert_eq!(ours, serde_json::from_str::<Value>(&suite).expect("JSON"));
}

fn ids(arguments: &[&str]) -> Vec<String> {
    let stream = run(&[&["cases", "--format", "json"], arguments].concat()).quietly(0);
    let id =
        |line: &str| serde_json::from_str::<Value>(line).expect("JSON")["id"].as_str().expect("a string").to_owned();
    stream.lines().map(id).collect()
}

#[test]
fn categories_are_chosen_by_their_whole_name() {
    let units = ids(&["--category", "units"]);
    assert!(units.len() > 10 && units.iter().all(|id| id.starts_with("units/")), "{units:?}");
    // The text of --only is looked for in flags, too, and anywhere.
    assert!(ids(&["--only", "units"]).len() > units.len());
    let two = ids(&["--category", "units", "--category", "nile"]);
    assert_eq!(two.len(), units.len() + ids(&["--category", "nile"]).len());
    // Both together choose what each of them chooses.
    assert_eq!(ids(&["--category", "nile", "--only", "diffuse"]), ["nile/diffuse", "nile/missing-years-diffuse"]);
    let message = run(&["cases", "--category", "unit"]).trouble();
    assert!(message.contains("no category \"unit\"") && message.contains(" units,"), "{message}");
    let message = run(&["cases", "--category", "nile", "--only", "nothing"]).trouble();
    assert!(message.contains("\"nothing\""), "{message}");
}

#[test]
fn a_seed_draws_other_readings_of_the_same_cases() {
    let published = run(&["cases", "--format", "json"]).quietly(0);
    assert_eq!(run(&["cases", "--format", "json", "--seed", "0"]).quietly(0), published);
    let drawn = run(&["cases", "--format", "json", "--seed", "7"]).quietly(0);
    assert_ne!(drawn, published);
    assert_eq!(ids(&["--seed", "7"]), ids(&[]));
    assert_eq!(run(&["cases", "--seed", "7"]).quietly(0), run(&["cases"]).quietly(0));
    let world = ["cases", "--format", "json", "--category", "real"];
    assert_eq!(run(&[&world[..], &["--seed", "7"]].concat()).quietly(0), run(&world).quietly(0));
    let refused = run(&["cases", "--cases", "examples/cases", "--seed", "7"]);
    assert!(refused.code == 2 && refused.stderr.contains("--seed"), "{}", refused.stderr);
}

/// What is written with references is what is shipped, byte by byte.
#[test]
fn a_release_is_what_is_shipped() {
    let directory = Directory::new();
    let ran = run(&["cases", "--category", "conventions", "--references", "--out", directory.name()]);
    assert_eq!((ran.code, ran.stdout.as_str()), (0, ""), "{}", ran.stderr);
    let count = ids(&["--category", "conventions"]).len();
    assert!(ran.stderr.starts_with(&format!("{count} cases and {count} references written")), "{}", ran.stderr);
    let mut files = Vec::new();
    below(directory.path(), &mut files);
    assert_eq!(files.len(), 2 * count + 1);
    let manifest = fs::read_to_string(directory.path().join("MANIFEST.json")).expect("a manifest");
    let manifest: Value = serde_json::from_str(&manifest).expect("JSON");
    assert_eq!((&manifest["cases"], &manifest["seed"], &manifest["suite"]), (&count.into(), &0.into(), &1.into()));
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("suite");
    let listed: Option<Value> =
        fs::read_to_string(shipped.join("MANIFEST.json")).ok().map(|text| serde_json::from_str(&text).expect("JSON"));
    for file in files.iter().filter(|file| !file.ends_with("MANIFEST.json")) {
        let name = file.strip_prefix(directory.path()).expect("below").to_str().expect("text");
        // A package from a registry has no suite/.
        if let Some(listed) = &listed {
            assert_eq!(manifest["files"][name], listed["files"][name], "{name}");
            assert_eq!(fs::read(file).expect("a file"), fs::read(shipped.join(name)).expect("a file"), "{name}");
        }
    }
    // The cases can be read back, and the references judged as saved answers are.
    let cases = directory.path().join("cases");
    let again = run(&["cases", "--cases", cases.to_str().expect("text"), "--format", "json"]).quietly(0);
    assert_eq!(again.lines().count(), count);
}

#[test]
fn references_of_cases_of_ones_own_have_no_seed() {
    let directory = Directory::new();
    let out = directory.path().join("out");
    let out = out.to_str().expect("text");
    let ran = feed(&["cases", "--cases", "-", "--references", "--out", out], &walk("mine", &["1", "2"]));
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    let text = fs::read_to_string(Path::new(out).join("MANIFEST.json")).expect("a manifest");
    let manifest: Value = serde_json::from_str(&text).expect("JSON");
    assert!(manifest.get("seed").is_none() && manifest.get("suite").is_none(), "{text}");
    assert_eq!(manifest["files"].as_object().map(serde_json::Map::len), Some(2));
    assert_eq!(run(&["cases", "--references"]).code, 2);
}
