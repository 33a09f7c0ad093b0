//! The parts of SPEC.md that follow from the rest: the lines of evidence and of tests of each entry, and the chapter of errata.

use std::borrow::Borrow;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use exact_kalman::spec::{Paper, Status, parse};

use crate::backing::Backings;

/// The tests that name each identifier.
type Tests = BTreeMap<String, BTreeSet<String>>;

/// How the chapter begins.
const CHAPTER: &str = "\n## Errata\n";

const INTRODUCTION: &str = "
Slips of the papers that exact arithmetic or a second reading found. Each is complete in itself: what is printed, what is right in its
place, a witness that anyone can recompute (and that a test runs both ways), and what goes wrong for somebody who takes the print for
true. None of them touches a main theorem unless it says so. This chapter is put together from the entries above.
";

/// The page with its generated parts as they should be.
pub fn updated(page: &str, evidence: &Backings, tests: &Tests) -> String {
    let body = page.split_once(CHAPTER).map_or(page, |(body, _)| body);
    let body = with_lines(body, evidence, tests);
    let chapter = chapter(&body);
    format!("{}\n{chapter}", body.trim_end())
}

fn with_lines(body: &str, evidence: &Backings, tests: &Tests) -> String {
    let mut out = String::new();
    let mut sections = body.split("\n### ");
    out += sections.next().unwrap_or_default();
    for section in sections {
        // What follows the entry: the heading of the next chapter.
        let (entry, rest) = section.split_once("\n## ").map_or((section, None), |(entry, rest)| (entry, Some(rest)));
        let cut =
            |entry: &str, line: &str| entry.split_once(line).map_or(entry, |(entry, _)| entry).trim_end().to_owned();
        let entry = cut(&cut(entry, "\nTests: "), "\nBacking: ");
        let id = entry.split_whitespace().next().unwrap_or_default();
        let _ = write!(out, "\n### {entry}\n");
        let is_open = entry.contains("\n*open*");
        if let Some(evidence) = evidence.get(id).filter(|_| !is_open) {
            let _ =
                write!(out, "\nBacking: {}.\n", evidence.iter().map(Borrow::borrow).collect::<Vec<&str>>().join("; "));
        }
        if let Some(tests) = tests.get(id).filter(|_| !is_open) {
            let names: Vec<String> = tests.iter().map(|test| format!("`{test}`")).collect();
            let _ = write!(out, "\nTests: {}.\n", names.join(", "));
        }
        if let Some(rest) = rest {
            let _ = write!(out, "\n## {rest}");
        }
    }
    out
}

fn chapter(body: &str) -> String {
    let entries = parse(body).unwrap_or_else(|error| panic!("{error}"));
    let mut out = format!("{CHAPTER}{INTRODUCTION}");
    for paper in Paper::ALL {
        let of_paper = entries.iter().filter(|entry| entry.paper == paper && entry.status != Status::Open);
        let mut is_first = true;
        for entry in of_paper {
            for erratum in &entry.errata {
                if std::mem::take(&mut is_first) {
                    let _ = write!(out, "\n**{}**\n", paper.name());
                }
                let _ = write!(
                    out,
                    "\n* **{}** {}\n  * printed: {}\n  * right: {}\n  * witness: {}\n  * consequence: {}\n",
                    entry.id, entry.title, erratum.printed, erratum.right, erratum.witness, erratum.consequence
                );
            }
        }
    }
    out
}
