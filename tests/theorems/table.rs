//! README.md beside this file: every theorem of SPEC.md has a row, and every test it names exists and says that it is about it.

use std::collections::BTreeSet;
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

/// Rows of the table below its head: the identifiers, and the other two cells.
fn rows() -> Vec<(Vec<String>, [String; 2])> {
    let text = fs::read_to_string(root().join("tests/theorems/README.md")).expect("README.md");
    let row = |line: &str| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [identifiers, holds, dropped] = cells[..] else { panic!("three cells in {line}") };
        (identifiers.split(", ").map(str::to_owned).collect(), [holds.to_owned(), dropped.to_owned()])
    };
    text.lines().filter(|line| line.starts_with("| ")).skip(1).map(row).collect()
}

/// The texts in backquotes.
fn quoted(cell: &str) -> impl Iterator<Item = &str> {
    cell.split('`').skip(1).step_by(2)
}

/// What is written above `crate::module::test`, if there is such a test.
fn documentation(name: &str) -> Option<String> {
    let (module, test) = name.rsplit_once("::")?;
    let path: PathBuf = module.split("::").collect();
    let files =
        [root().join("tests").join(&path).with_extension("rs"), root().join("tests").join(&path).join("mod.rs")];
    let header = format!("fn {test}(");
    files.iter().filter_map(|file| fs::read_to_string(file).ok()).find_map(|source| {
        let lines: Vec<&str> = source.lines().map(str::trim_start).collect();
        let place = lines.iter().position(|line| line.starts_with(&header))?;
        let above: Vec<&str> = lines[..place]
            .iter()
            .rev()
            .copied()
            .take_while(|line| line.starts_with("///") || line.starts_with("#["))
            .collect();
        above.contains(&"#[test]").then(|| above.into_iter().rev().collect::<Vec<_>>().join(" "))
    })
}

/// Whether a text names an identifier, and not only a longer one.
fn names(text: &str, identifier: &str) -> bool {
    text.split(|letter: char| !letter.is_alphanumeric() && !"-._".contains(letter))
        .any(|word| word.trim_end_matches('.') == identifier)
}

#[test]
fn every_theorem_has_a_row() {
    let theorems = theorems();
    assert!(theorems.len() > 50, "only {} theorems were seen", theorems.len());
    let mut seen = BTreeSet::new();
    for identifier in rows().into_iter().flat_map(|(identifiers, _)| identifiers) {
        assert!(seen.insert(identifier.clone()), "{identifier} has two rows");
    }
    let missing: Vec<_> = theorems.difference(&seen).collect();
    assert!(missing.is_empty(), "without a row: {missing:?}");
}

/// Every row names entries of SPEC.md, a test that they hold, and says something of the hypotheses; its tests exist, and the
/// documentation of each names an entry of the row.
#[test]
fn rows_name_tests_of_their_theorems() {
    let text = fs::read_to_string(root().join("SPEC.md")).expect("SPEC.md");
    for (identifiers, [holds, dropped]) in rows() {
        for identifier in &identifiers {
            assert!(text.contains(&format!("### {identifier} ")), "{identifier} is no entry");
        }
        for name in quoted(&holds).chain(quoted(&dropped)) {
            let Some(documentation) = documentation(name) else { panic!("{identifiers:?}: there is no test {name}") };
            let is_named = identifiers.iter().any(|identifier| names(&documentation, identifier));
            assert!(is_named, "{identifiers:?}: {name} says nothing of it");
        }
        assert!(quoted(&holds).count() > 0, "{identifiers:?}: no test that it holds");
        assert!(!dropped.is_empty(), "{identifiers:?}: nothing is said of its hypotheses");
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
    assert_eq!(documentation("agree::squares::there_is_no_such_test"), None);
    let found = documentation("agree::squares::squares_are_completed").expect("a test");
    assert!(
        names(&found, "EK-L1")
            && names(&found, "EK-L3")
            && !names(&found, "EK-L1".trim_end_matches('1'))
            && !names(&found, "EK-L5")
    );
}
