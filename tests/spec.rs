//! SPEC.md ⇄ code ⇄ tests: every entry is quoted to the letter, implemented, and named by a test.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The papers whose identifiers are looked for.
const PAPERS: [&str; 5] = ["CKS", "HV", "SM", "WG", "AK"];

#[derive(Debug, PartialEq)]
struct Entry {
    equation: String,
    status: String,
}

/// The entries of a specification by identifier.
fn entries(specification: &str) -> Result<BTreeMap<String, Entry>, String> {
    let mut entries = BTreeMap::new();
    for section in specification.split("\n### ").skip(1) {
        let id = section.split_whitespace().next().unwrap_or_default().to_owned();
        let quoted = section.lines().find_map(|line| line.strip_prefix("> `")?.strip_suffix('`'));
        let status = section.lines().find_map(|line| line.strip_prefix('*')?.split('*').next());
        let (Some(equation), Some(status)) = (quoted, status) else {
            return Err(format!("{id} lacks its quoted line or its status"));
        };
        let entry = Entry { equation: equation.to_owned(), status: status.to_owned() };
        if entries.insert(id.clone(), entry).is_some() {
            return Err(format!("{id} stands twice"));
        }
    }
    Ok(entries)
}

/// The identifiers that a text names.
fn named(text: &str) -> BTreeSet<String> {
    let belongs = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '.';
    let words = text.split(|c| !belongs(c)).map(|word| word.trim_end_matches(['-', '.']));
    let is_id =
        |word: &&str| word.split_once('-').is_some_and(|(paper, rest)| PAPERS.contains(&paper) && !rest.is_empty());
    words.filter(is_id).map(str::to_owned).collect()
}

/// The equations that a text quotes: lines `ID: `equation`` of a doc comment.
fn quoted(text: &str) -> Vec<(String, String)> {
    let of_line = |line: &str| {
        let doc = line.trim_start().strip_prefix("//")?.trim_start_matches(['/', '!', ' ']);
        let (id, rest) = doc.split_once(": `")?;
        let equation = rest.strip_suffix('`')?;
        (named(id).contains(id)).then(|| (id.to_owned(), equation.to_owned()))
    };
    text.lines().filter_map(of_line).collect()
}

fn sources(directory: &str) -> Vec<(PathBuf, String)> {
    let mut pending = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join(directory)];
    let mut sources = Vec::new();
    while let Some(path) = pending.pop() {
        if path.is_dir() {
            let entries = fs::read_dir(&path).into_iter().flatten().flatten().map(|entry| entry.path());
            pending.extend(entries);
        } else if path.extension().is_some_and(|extension| extension == "rs") && !path.ends_with("spec.rs") {
            let text = fs::read_to_string(&path).unwrap_or_default();
            sources.push((path, text));
        }
    }
    sources
}

/// What is wrong between a specification, code and tests.
fn complaints(specification: &str, code: &[(PathBuf, String)], tests: &[(PathBuf, String)]) -> Vec<String> {
    let entries = match entries(specification) {
        Ok(entries) => entries,
        Err(complaint) => return vec![complaint],
    };
    let mut complaints = Vec::new();
    for (path, text) in code.iter().chain(tests) {
        for (id, equation) in quoted(text) {
            if entries.get(&id).is_some_and(|entry| entry.equation != equation) {
                complaints.push(format!("{}: {id} is misquoted", path.display()));
            }
        }
        for id in named(text).into_iter().filter(|id| !entries.contains_key(id)) {
            complaints.push(format!("{}: {id} is unknown", path.display()));
        }
    }
    let all = |sources: &[(PathBuf, String)]| -> BTreeSet<String> {
        sources.iter().flat_map(|(_, text)| named(text)).collect()
    };
    let (in_code, in_tests) = (all(code), all(tests));
    for (id, Entry { status, .. }) in &entries {
        let known = ["implemented", "checked", "prose", "open"].contains(&status.as_str());
        if !known {
            complaints.push(format!("{id} has the unknown status {status:?}"));
        }
        if status == "implemented" && !in_code.contains(id) {
            complaints.push(format!("{id} is cited nowhere in the code"));
        }
        if (status == "implemented" || status == "checked") && !in_tests.contains(id) {
            complaints.push(format!("{id} is named by no test"));
        }
    }
    complaints
}

#[test]
fn specification_code_and_tests_agree() {
    let complaints = complaints(include_str!("../SPEC.md"), &sources("src"), &sources("tests"));
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

/// The checker finds what it is there for.
#[test]
fn disagreements_are_found() {
    let specification =
        "\n### CKS-4 Covariance\n\n> `P = R − K`\n\n*implemented*: there.\n\n### CKS-L0 Open\n\n> `a`\n\n*open*.\n";
    let source = |text: &str| [(PathBuf::from("a.rs"), text.to_owned())];
    let cited = source("/// CKS-4: `P = R − K`");
    let test = source("/// CKS-4");
    assert_eq!(complaints(specification, &cited, &test), Vec::<String>::new());
    assert_eq!(complaints(specification, &source("/// CKS-4: `P = R + K`"), &test), ["a.rs: CKS-4 is misquoted"]);
    assert_eq!(complaints(specification, &source(""), &test), ["CKS-4 is cited nowhere in the code"]);
    assert_eq!(complaints(specification, &cited, &source("")), ["CKS-4 is named by no test"]);
    assert_eq!(complaints(specification, &cited, &source("/// CKS-4, CKS-44")), ["a.rs: CKS-44 is unknown"]);
    assert_eq!(complaints("\n### CKS-4 Covariance\n", &cited, &test), ["CKS-4 lacks its quoted line or its status"]);
}
