//! The texts of the project, and what they name.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use exact_kalman::spec::Paper;

/// A file: its path from the root of the project, and what stands in it.
pub struct Source {
    pub path: PathBuf,
    pub text: String,
}

impl Source {
    pub fn new(path: &str, text: &str) -> Self {
        Self { path: PathBuf::from(path), text: text.to_owned() }
    }

    /// The tests of the file: how `cargo test` calls each, and its documentation.
    pub fn tests(&self) -> Vec<(String, String)> {
        let module = module(&self.path);
        let (mut found, mut docs, mut is_test) = (Vec::new(), String::new(), false);
        for line in self.text.lines().map(str::trim_start) {
            if let Some(doc) = line.strip_prefix("///") {
                docs += doc;
                docs.push('\n');
            } else if line.starts_with("#[") {
                is_test |= line == "#[test]";
            } else if let Some((name, _)) = line.split_once(", unwind ") {
                // `harness! { /// docs` and then the name.
                found.push((format!("{module}::{name}"), std::mem::take(&mut docs)));
            } else if let (Some(name), true) = (function(line), is_test) {
                found.push((format!("{module}::{name}"), std::mem::take(&mut docs)));
                is_test = false;
            } else {
                docs.clear();
                is_test = false;
            }
        }
        found
    }
}

/// The name of the function that a line begins.
fn function(line: &str) -> Option<&str> {
    line.strip_prefix("pub ").unwrap_or(line).strip_prefix("fn ")?.split(['(', '<']).next()
}

/// `papers::anderson::stein` for `tests/papers/anderson/stein.rs`.
fn module(path: &Path) -> String {
    let parts =
        path.with_extension("").components().map(|part| part.as_os_str().to_string_lossy().into_owned()).collect();
    let mut parts: Vec<String> = parts;
    if parts.first().is_some_and(|root| root == "tests") {
        parts.remove(0);
    }
    if parts.last().is_some_and(|last| last == "mod" || last == "main") {
        parts.pop();
    }
    parts.join("::")
}

/// Code, tests and proofs of the project.
#[derive(Default)]
pub struct Sources {
    pub code: Vec<Source>,
    pub tests: Vec<Source>,
    /// Theorems for Rocq.
    pub theorems: Vec<Source>,
    /// Statements for solvers.
    pub statements: Vec<Source>,
}

impl Sources {
    pub fn of_the_project() -> Self {
        let tests = ["tests", "proofs"]
            .into_iter()
            .flat_map(|room| read(room, "rs"))
            .filter(|source| !source.path.starts_with("tests/spec"));
        Self {
            code: read("src", "rs"),
            tests: tests.collect(),
            theorems: read("proofs/rocq", "v"),
            statements: read("proofs/smt", "smt2"),
        }
    }

    /// The tests that name each identifier.
    pub fn tests_by_identifier(&self) -> BTreeMap<String, BTreeSet<String>> {
        let mut tests: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for (test, docs) in self.tests.iter().flat_map(Source::tests) {
            for id in named(&docs) {
                tests.entry(id).or_default().insert(test.clone());
            }
        }
        tests
    }
}

fn read(directory: &str, wanted: &str) -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut pending = vec![root.join(directory)];
    let mut sources = Vec::new();
    while let Some(path) = pending.pop() {
        if path.is_dir() {
            pending.extend(fs::read_dir(&path).into_iter().flatten().flatten().map(|entry| entry.path()));
        } else if path.extension().is_some_and(|extension| extension == wanted) {
            let text = fs::read_to_string(&path).unwrap_or_default();
            let path = path.strip_prefix(root).unwrap_or(&path).to_owned();
            sources.push(Source { path, text });
        }
    }
    sources
}

/// The identifiers that a text names.
pub fn named(text: &str) -> BTreeSet<String> {
    let belongs = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '.';
    let words = text.split(|c| !belongs(c)).map(|word| word.trim_end_matches(['-', '.']));
    words.filter(|word| Paper::of(word).is_some()).map(str::to_owned).collect()
}

/// The equations that a text quotes: lines `ID: `equation`` of a doc comment.
pub fn quoted(text: &str) -> Vec<(String, String)> {
    let of_line = |line: &str| {
        let doc = line.trim_start().strip_prefix("//")?.trim_start_matches(['/', '!', ' ']);
        let (id, rest) = doc.split_once(": `")?;
        let equation = rest.strip_suffix('`')?;
        named(id).contains(id).then(|| (id.to_owned(), equation.to_owned()))
    };
    text.lines().filter_map(of_line).collect()
}
