//! What is wrong between a specification, code and tests.

use std::collections::{BTreeMap, BTreeSet};

use exact_kalman::spec::{Entry, Status, parse};

use crate::sources::{Source, Sources, named, quoted};

/// What is wrong, in plain words.
pub fn complaints(specification: &str, sources: &Sources) -> Vec<String> {
    let entries = match parse(specification) {
        Ok(entries) => entries,
        Err(error) => return vec![error.to_string()],
    };
    let entries: BTreeMap<&str, &Entry<'_>> = entries.iter().map(|entry| (entry.id, entry)).collect();
    let mut complaints = misnamed(&entries, sources);
    let in_code: BTreeSet<String> = sources.code.iter().flat_map(|source| named(&source.text)).collect();
    let tests = sources.tests_by_identifier();
    let docs: String = sources.tests.iter().flat_map(Source::tests).map(|(_, docs)| docs).collect();
    for (id, entry) in entries {
        let is_done = matches!(entry.status, Status::Implemented | Status::Checked);
        if entry.status == Status::Implemented && !in_code.contains(id) {
            complaints.push(format!("{id} is cited nowhere in the code"));
        }
        if is_done && !tests.contains_key(id) {
            complaints.push(format!("{id} is named by no test"));
        }
        let is_run = docs.lines().any(|line| line.contains("Errat") && named(line).contains(id));
        if !entry.errata.is_empty() && !is_run {
            let wanted = format!("“Erratum {id}” in its documentation");
            complaints.push(format!("{id}: no test runs the witness of its erratum ({wanted})"));
        }
    }
    complaints
}

/// Identifiers that are unknown or misquoted.
fn misnamed(entries: &BTreeMap<&str, &Entry<'_>>, sources: &Sources) -> Vec<String> {
    let mut complaints = Vec::new();
    let proofs = sources.theorems.iter().chain(&sources.statements);
    for Source { path, text } in sources.code.iter().chain(&sources.tests).chain(proofs) {
        for (id, equation) in quoted(text) {
            if entries.get(id.as_str()).is_some_and(|entry| entry.equation != equation) {
                complaints.push(format!("{}: {id} is misquoted", path.display()));
            }
        }
        for id in named(text).into_iter().filter(|id| !entries.contains_key(id.as_str())) {
            complaints.push(format!("{}: {id} is unknown", path.display()));
        }
    }
    complaints
}
