//! What entries rest on, read from where it stands: theorems, statements for solvers, identities, exhaustive tests, tests.

use std::collections::{BTreeMap, BTreeSet};

use exact_kalman::spec::Backing;

use crate::sources::{Source, Sources, named};

/// What stands in the line of each identifier, part by part: the strongest first, then by name.
pub type Backings = BTreeMap<String, BTreeSet<Part>>;

/// One part of a line, in its order.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Part(Backing, String);

impl std::borrow::Borrow<str> for Part {
    fn borrow(&self) -> &str {
        &self.1
    }
}

/// Everything that backs an entry.
pub fn backings(sources: &Sources) -> Result<Backings, String> {
    let mut found = Backings::new();
    let mut add = |ids: &BTreeSet<String>, backing: Backing, name: &str, extent: &str| {
        for id in ids {
            let words = match (name, extent) {
                ("", _) => backing.name().to_owned(),
                (_, "") => format!("{backing} `{name}`"),
                _ => format!("{backing} `{name}` ({extent})"),
            };
            // A semicolon ends a part, and brackets would be links.
            let words = words.replace("; ", ", ").replace('[', "(").replace(']', ")");
            found.entry(id.clone()).or_default().insert(Part(backing, words));
        }
    };
    for theorem in sources.theorems.iter().flat_map(theorems) {
        let (name, ids, sentence) = theorem?;
        add(&ids, Backing::AllSizes, &name, &sentence);
    }
    for statement in &sources.statements {
        if let Some((name, ids, size)) = statement_of(statement)? {
            add(&ids, Backing::Solver, &name, &size);
        }
    }
    for (test, docs) in sources.tests.iter().flat_map(Source::tests) {
        let ids = named(&docs);
        let domain = docs.lines().find_map(|line| line.trim().strip_prefix("Domain: "));
        if let Some(domain) = domain {
            let domain =
                domain.strip_suffix('.').ok_or_else(|| format!("{test}: its domain does not end with a full stop"))?;
            add(&ids, Backing::Exhaustive, &test, domain);
        }
        add(&ids, Backing::Tested, "", "");
    }
    for identity in exact_kalman::prove::catalogue() {
        let ids = identity.identifiers.iter().map(ToString::to_string).collect();
        let sizes: Vec<String> = identity.symbolic.iter().map(ToString::to_string).collect();
        let (name, hypothesis) = (identity.name, identity.hypothesis);
        add(&ids, Backing::Symbolic, name, &format!("where {hypothesis}: {}", sizes.join(" · ")));
        if let Some(largest) = identity.random.last() {
            add(&ids, Backing::RandomPoints, name, &format!("where {hypothesis}: up to {largest}"));
        }
    }
    Ok(found)
}

/// The name of a theorem, the entries that it says, and in which words.
type Theorem = (String, BTreeSet<String>, String);

/// Theorems with the identifiers that begin the comment before them: `(** AK-L4.2: a sentence. *)`.
fn theorems(source: &Source) -> Vec<Result<Theorem, String>> {
    let file = source.path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let mut found = Vec::new();
    for rest in source.text.split("(** ").skip(1) {
        let Some((comment, after)) = rest.split_once("*)") else { continue };
        // Identifiers stand before the first colon, and nothing else does.
        let Some((before, sentence)) = comment.split_once(": ") else { continue };
        let ids = named(before);
        if ids.is_empty() || ids.len() != before.split(", ").count() {
            continue;
        }
        let mut words = after.split_whitespace();
        let name = match (words.next(), words.next()) {
            (Some("Theorem" | "Lemma" | "Corollary" | "Proposition" | "Fact"), Some(name)) => {
                let sentence = sentence.split_whitespace().collect::<Vec<_>>().join(" ");
                Ok((format!("{file}.{}", name.trim_end_matches(':')), ids, sentence.trim_end_matches('.').to_owned()))
            }
            _ => Err(format!("{}: no theorem follows «{}»", source.path.display(), before)),
        };
        found.push(name);
    }
    found
}

/// A statement for a solver: its name, what it is a statement of, and for which size. Controls back nothing.
fn statement_of(source: &Source) -> Result<Option<(String, BTreeSet<String>, String)>, String> {
    let path = source.path.with_extension("");
    let name = path.strip_prefix("proofs/smt").unwrap_or(&path).display().to_string();
    let header =
        |key: &str| source.text.lines().find_map(|line| line.strip_prefix("; ")?.strip_prefix(key)).map(str::trim);
    match header("Expect:") {
        _ if header("Control:").is_some() => Ok(None),
        Some("unsat") => {
            let ids = named(header("Identifiers:").unwrap_or_default());
            let size = header("Size:").ok_or_else(|| format!("{name} states no size"))?;
            let statement = header("Statement:").ok_or_else(|| format!("{name} states nothing"))?;
            Ok(Some((name, ids, format!("{size}: {}", statement.trim_end_matches('.')))))
        }
        _ => Err(format!("{name} is neither a control nor expected to be unsat")),
    }
}

#[test]
fn evidence_is_read_where_it_stands() {
    let theorem = "(** AK-1, AK-2: a\n sentence: this. *)\nTheorem first n : n = n.\n(** A note: no identifier. *)\nLemma x : y.\n";
    let statement = "; Identifiers: AK-1\n; Statement: s\n; Size: 2×2\n; Expect: unsat\n";
    let control = "; Control: c\n; Identifiers: AK-1\n; Size: 1\n; Expect: unsat\n";
    let test = "/// AK-2: all.\n/// Domain: all of it.\n#[test]\nfn holds() {}\n/// AK-3\n#[test]\nfn other() {}\n";
    let sources = Sources {
        code: vec![],
        tests: vec![Source::new("tests/exhaustive/a.rs", test)],
        theorems: vec![Source::new("proofs/rocq/Stein.v", theorem)],
        statements: vec![Source::new("proofs/smt/a/b.smt2", statement), Source::new("proofs/smt/c.smt2", control)],
    };
    let found = backings(&sources).expect("well written");
    // Identities stand beside what the sources say.
    let from_sources = |part: &&Part| !matches!(part.0, Backing::Symbolic | Backing::RandomPoints);
    let line =
        |id: &str| found[id].iter().filter(from_sources).map(|part| part.1.clone()).collect::<Vec<_>>().join("; ");
    assert_eq!(line("AK-1"), "proved for all sizes `Stein.first` (a sentence: this); proved by SMT `a/b` (2×2: s)");
    assert_eq!(
        line("AK-2"),
        "proved for all sizes `Stein.first` (a sentence: this); exhaustive `exhaustive::a::holds` (all of it); tested"
    );
    assert_eq!(line("AK-3"), "tested");
    let page = format!("\n### AK-2 Title\n\n> `a`\n\n*checked*: so.\n\nBacking: {}.\n\nTests: `a::b`.\n", line("AK-2"));
    let entries = exact_kalman::spec::parse(&page).expect("a page");
    assert_eq!(entries[0].backing(), Some(Backing::AllSizes));
    assert_eq!(entries[0].evidence[1].extent, "all of it");
    assert_eq!((entries[0].evidence.len(), entries[0].text.as_str()), (3, "so."));
    let lost = Source::new("proofs/rocq/Stein.v", "(** AK-1: a sentence. *)\nDefinition x := y.\n");
    assert!(theorems(&lost)[0].is_err());
}
