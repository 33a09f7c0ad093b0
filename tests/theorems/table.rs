//! README.md beside this file: every theorem of SPEC.md has a row, and every test it names exists.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Entries under these headings are conditions and data, though their identifiers look like those of theorems.
fn is_theorem(identifier: &str) -> bool {
    let Some((chapter, rest)) = identifier.split_once('-') else { return false };
    let mut letters = rest.chars();
    let kind = letters.next().unwrap_or(' ');
    // T for theorems, L for lemmas, C for AK's corollaries, P for SM's proposition. Parts are lower-case letters or figures.
    let is_kind = matches!((chapter, kind), (_, 'T' | 'L') | ("AK", 'C') | ("SM", 'P'));
    let number = letters.as_str();
    let is_number =
        number.chars().all(|letter| letter.is_ascii_digit() || matches!(letter, '.' | 'a' | 'b' | 'i' | 'v'));
    let begins = number.starts_with(|letter: char| letter.is_ascii_digit()) || (chapter == "CKS" && number.is_empty());
    rest == "Kron" || (is_kind && is_number && begins)
}

fn theorems() -> BTreeSet<String> {
    let text = fs::read_to_string(root().join("SPEC.md")).expect("SPEC.md");
    let headings = text.lines().filter_map(|line| line.strip_prefix("### ")?.split(' ').next());
    headings.filter(|identifier| is_theorem(identifier)).map(str::to_owned).collect()
}

/// Rows of the table: identifier, and the other two cells.
fn rows() -> BTreeMap<String, [String; 2]> {
    let text = fs::read_to_string(root().join("tests/theorems/README.md")).expect("README.md");
    let mut rows = BTreeMap::new();
    for line in text.lines().filter(|line| line.starts_with("| ")) {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [identifiers, holds, dropped] = cells[..] else { panic!("three cells in {line}") };
        for identifier in identifiers.split(", ") {
            let before = rows.insert(identifier.to_owned(), [holds.to_owned(), dropped.to_owned()]);
            assert!(before.is_none(), "{identifier} has two rows");
        }
    }
    rows
}

/// The texts in backquotes.
fn quoted(cell: &str) -> impl Iterator<Item = &str> {
    cell.split('`').skip(1).step_by(2)
}

/// Whether `crate::module::test` is a test.
fn exists(name: &str) -> bool {
    let mut parts: Vec<&str> = name.split("::").collect();
    let Some(test) = parts.pop() else { return false };
    let path: PathBuf = parts.iter().collect();
    let files =
        [root().join("tests").join(&path).with_extension("rs"), root().join("tests").join(&path).join("mod.rs")];
    files.iter().filter_map(|file| fs::read_to_string(file).ok()).any(|source| source.contains(&format!("fn {test}(")))
}

#[test]
fn every_theorem_has_a_row() {
    let (theorems, rows) = (theorems(), rows());
    assert!(theorems.len() > 50, "only {} theorems were seen", theorems.len());
    let missing: Vec<_> = theorems.iter().filter(|identifier| !rows.contains_key(*identifier)).collect();
    assert!(missing.is_empty(), "without a row: {missing:?}");
}

#[test]
fn rows_name_tests_that_exist() {
    let text = fs::read_to_string(root().join("SPEC.md")).expect("SPEC.md");
    for (identifier, [holds, dropped]) in
        rows().iter().filter(|(identifier, _)| !matches!(identifier.as_str(), "theorem" | "---"))
    {
        assert!(text.contains(&format!("### {identifier} ")), "{identifier} is no entry");
        for name in quoted(holds).chain(quoted(dropped)) {
            assert!(exists(name), "{identifier}: there is no test {name}");
        }
        assert!(quoted(holds).count() > 0, "{identifier}: no test that it holds");
        assert!(!dropped.is_empty(), "{identifier}: nothing is said of its hypotheses");
    }
}

/// What is seen as a theorem, and what not.
#[test]
fn theorems_are_told_from_conditions() {
    for identifier in ["CKS-T", "CKS-L3ii", "AK-C2.1", "SM-P1", "EK-T7a", "AK-Kron", "WG-L2.3", "HV-L2i"] {
        assert!(is_theorem(identifier), "{identifier}");
    }
    for identifier in ["HV-C1", "WG-C1i", "SM-T1-remark", "CKS-1a", "HV-P1.SKP", "HV-Tab1"] {
        assert!(!is_theorem(identifier), "{identifier}");
    }
    assert!(!exists("agree::squares::there_is_no_such_test") && exists("agree::squares::squares_are_completed"));
}
