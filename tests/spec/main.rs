//! SPEC.md ⇄ code ⇄ tests: every entry is quoted to the letter, implemented, and named by a test; every erratum has
//! its witness run; the lines of evidence and of tests and the chapter of errata are those that follow from the rest.

mod backing;
mod complaints;
mod generated;
mod sources;

use std::fs;
use std::path::Path;

use complaints::complaints;
use exact_kalman::spec::{Status, entries};
use sources::{Source, Sources};

/// How many items the list of all items had when it was committed, by paper. It is never shortened.
const LISTED: [(&str, usize); 6] = [("CKS", 30), ("HV", 60), ("AK", 118), ("SM", 131), ("WG", 129), ("EK", 16)];

#[test]
fn specification_code_and_tests_agree() {
    let complaints = complaints(include_str!("../../SPEC.md"), &Sources::of_the_project());
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

#[test]
fn the_list_is_not_shortened() {
    let entries = entries().unwrap_or_else(|error| panic!("{error}"));
    for (prefix, least) in LISTED {
        let found = entries.iter().filter(|entry| entry.paper.prefix() == prefix).count();
        assert!(found >= least, "{prefix}: {found} of {least} items");
    }
}

/// An entry that is not open says more than its equation, and an open one what is missing or to be checked.
#[test]
fn what_is_implemented_is_linked() {
    for entry in entries().unwrap_or_else(|error| panic!("{error}")) {
        assert!(entry.status != Status::Implemented || !entry.code.is_empty(), "{} links no code", entry.id);
        assert!(entry.status != Status::Prose || !entry.text.is_empty(), "{} gives no reason", entry.id);
        assert!(!entry.text.contains("to check") || entry.status == Status::Open, "{} is not checked", entry.id);
    }
}

/// `UPDATE_SPEC=1 cargo test --test spec` writes what is generated.
#[test]
fn generated_parts_are_up_to_date() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("SPEC.md");
    let page = fs::read_to_string(&path).unwrap_or_else(|error| panic!("SPEC.md: {error}"));
    let sources = Sources::of_the_project();
    let tests = sources.tests_by_identifier();
    let backings = backing::backings(&sources).unwrap_or_else(|problem| panic!("{problem}"));
    let expected = generated::updated(&page, &backings, &tests);
    if std::env::var_os("UPDATE_SPEC").is_some() {
        fs::write(&path, expected).unwrap_or_else(|error| panic!("SPEC.md: {error}"));
    } else {
        let differs = page.lines().zip(expected.lines()).find(|(found, expected)| found != expected);
        let command = "UPDATE_SPEC=1 cargo test --test spec writes it";
        assert!(page == expected, "SPEC.md is out of date ({command}); the first line that differs: {differs:?}");
    }
}

/// The checker finds what it is there for.
#[test]
fn disagreements_are_found() {
    let specification =
        "\n### CKS-4 Covariance\n\n> `P = R − K`\n\n*implemented*: there.\n\n### CKS-L0 Open\n\n> `a`\n\n*open*.\n";
    let code = |text: &str| vec![Source::new("a.rs", text)];
    let test = |docs: &str| vec![Source::new("tests/a.rs", &format!("{docs}\n#[test]\nfn holds() {{}}\n"))];
    let found =
        |specification: &str, code, tests| complaints(specification, &Sources { code, tests, ..Sources::default() });
    let none: [&str; 0] = [];
    assert_eq!(found(specification, code("/// CKS-4: `P = R − K`"), test("/// CKS-4")), none);
    assert_eq!(found(specification, code("/// CKS-4: `P = R + K`"), test("/// CKS-4")), ["a.rs: CKS-4 is misquoted"]);
    assert_eq!(found(specification, code(""), test("/// CKS-4")), ["CKS-4 is cited nowhere in the code"]);
    assert_eq!(found(specification, code("/// CKS-4"), test("")), ["CKS-4 is named by no test"]);
    // A remark inside a test names nothing, and neither does one on a helper.
    assert_eq!(found(specification, code("/// CKS-4"), test("// CKS-4")), ["CKS-4 is named by no test"]);
    let helper = vec![Source::new("tests/a.rs", "/// CKS-4\nfn helper() {}\n")];
    assert_eq!(found(specification, code("/// CKS-4"), helper), ["CKS-4 is named by no test"]);
    assert_eq!(found(specification, code("/// CKS-4, CKS-44"), test("/// CKS-4")), ["a.rs: CKS-44 is unknown"]);
    let damaged = "\n### CKS-4 Covariance\n";
    assert_eq!(found(damaged, code(""), test("")), ["CKS-4: lacks its quoted line"]);
    let sentence = "Erratum: printed a; right: b; witness: 1 and 1.5 are two; consequence: c. More.";
    let erring = format!("\n### CKS-4 Covariance\n\n> `P = R − K`\n\n*implemented*: there. {sentence}\n");
    let unproved = ["CKS-4: no test runs the witness of its erratum (“Erratum CKS-4” in its documentation)"];
    assert_eq!(found(&erring, code("/// CKS-4"), test("/// CKS-4")), unproved);
    assert_eq!(found(&erring, code("/// CKS-4"), test("/// Erratum CKS-4: a")), none);
    let half = erring.replace("; witness: 1 and 1.5 are two", "");
    assert_eq!(found(&half, code(""), test("")), ["CKS-4: an erratum lacks “; witness:”"]);
}
