//! No generic function without a square: the sources are read, and what has neither a square nor a reason fails.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use super::commuting::names;
use super::{algebra, filters, gaussian, ordered};

/// Generic functions without a square, each with the reason.
const REASONS: &[(&str, &str)] = &[
    ("gaussian::Gaussian::mean", "hands out a field; every square of the room looks through it"),
    ("gaussian::Gaussian::covariance", "hands out a field; every square of the room looks through it"),
    ("gaussian::Gaussian::into_parts", "hands out fields"),
    ("gaussian::Gaussian::dimension", "counts"),
    ("gaussian::Inconsistent::simplified", "for the rationals only: it divides integers by their common divisor"),
    ("riccati::RiccatiMap::states", "counts"),
    ("riccati::RiccatiMap::transition", "hands out a field"),
    ("riccati::RiccatiMap::state_noise", "hands out a field"),
    ("riccati::RiccatiMap::observation_noise", "hands out a field"),
    ("riccati::RiccatiMap::system", "moves matrices into a description; no arithmetic"),
    (
        "model::System::realised",
        "evaluates closures, which have one scalar; its paths are what the squares of filters begin with",
    ),
    ("model::System::realised_ahead", "as System::realised"),
    ("model::System::steps", "the steps of System::realised"),
];

fn sources(directory: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(directory).unwrap_or_else(|error| panic!("{}: {error}", directory.display())) {
        let path = entry.expect("a readable directory").path();
        if path.is_dir() {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files
}

/// The type parameters of a line `…<…>` that stand for scalars.
fn is_generic(line: &str) -> bool {
    ["S: Scalar", "S: Field", "S: OrderedField"].iter().any(|bound| line.contains(bound))
}

/// The word at the start of a text.
fn word(text: &str) -> &str {
    text.split(|letter: char| !letter.is_alphanumeric() && letter != '_').next().unwrap_or("")
}

/// The public functions over any scalar in a source: inherent methods of generic blocks, and free functions. A bound may stand
/// in a line of its own after `where`; blocks of traits are left out.
fn functions(room: &str, source: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut block: Option<String> = None;
    let lines: Vec<&str> = source.lines().collect();
    for (number, line) in lines.iter().enumerate() {
        if line.starts_with("mod tests") {
            break;
        }
        let header = || lines[number..].iter().take_while(|line| !line.starts_with('}')).take(8).copied();
        let until_brace = |header: &mut dyn Iterator<Item = &str>| {
            let mut text = String::new();
            for line in header {
                text.push_str(line);
                text.push(' ');
                if line.trim_end().ends_with('{') {
                    break;
                }
            }
            text
        };
        if line.starts_with("impl") {
            let text = until_brace(&mut header());
            let kind = text.split_once("> ").map_or("", |(_, kind)| word(kind));
            block = (is_generic(&text) && !text.contains(" for ")).then(|| kind.to_owned());
        } else if *line == "}" {
            block = None;
        } else if let Some(rest) = line.trim_start().strip_prefix("pub fn ") {
            let text = until_brace(&mut header());
            match &block {
                Some(kind) => {
                    found.insert(format!("{room}::{kind}::{}", word(rest)));
                }
                None if line.starts_with("pub fn ") && is_generic(&text) => {
                    found.insert(format!("{room}::{}", word(rest)));
                }
                None => {}
            }
        }
    }
    found
}

fn all() -> BTreeSet<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let rooms = ["matrix", "gaussian", "filter", "riccati", "model"];
    let in_room = |room: &str| -> BTreeSet<String> {
        let texts = sources(&root.join(room)).into_iter().map(|path| fs::read_to_string(&path).expect("a text"));
        texts.flat_map(|source| functions(room, &source)).collect()
    };
    rooms.iter().flat_map(|room| in_room(room)).collect()
}

#[test]
fn every_generic_function_has_a_square_or_a_reason() {
    let all = all();
    assert!(all.len() > 60, "only {} functions were seen", all.len());
    let covered = names(&[algebra::COVERED, gaussian::COVERED, filters::COVERED, ordered::COVERED].concat());
    let reasons: BTreeMap<&str, &str> = REASONS.iter().copied().collect();
    let missing: Vec<&String> =
        all.iter().filter(|name| !covered.contains(name.as_str()) && !reasons.contains_key(name.as_str())).collect();
    assert!(missing.is_empty(), "neither a square nor a reason: {missing:?}");
    let gone: Vec<&&str> = covered.iter().chain(reasons.keys()).filter(|name| !all.contains(**name)).collect();
    assert!(gone.is_empty(), "no such public generic function: {gone:?}");
    let twice: Vec<_> = reasons.keys().filter(|name| covered.contains(*name)).collect();
    assert!(twice.is_empty(), "a square and a reason: {twice:?}");
}

/// What the scan takes for a generic function, and what not.
#[test]
fn generic_functions_are_seen() {
    let source = "impl<S: Field> Matrix<S> {\n    pub fn one(&self) {\n    }\n    fn hidden(&self) {\n    }\n}\n\
                  impl<S: Scalar> Neg for Matrix<S> {\n    pub fn not(&self) {\n    }\n}\n\
                  impl Matrix<Rational> {\n    pub fn plain(&self) {\n    }\n}\n\
                  pub fn two<S: Scalar>(x: S) {\n}\npub fn three<S>(\n    x: S,\n) where\n    S: OrderedField,\n{\n}\n";
    let found: Vec<String> = functions("room", source).into_iter().collect();
    assert_eq!(found, ["room::Matrix::one", "room::three", "room::two"]);
}
