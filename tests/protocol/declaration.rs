//! What a subject says of itself, and what is passed over.

use exact_kalman::protocol::{Case, Declaration, Declared, MAXIMAL_DECLARATION_BYTES};
use serde_json::{Value, json};

use crate::samples::{walk, with};
use crate::schema::valid;

pub(crate) const SCHEMA: &str = include_str!("../../schema/subject.schema.json");
const FORMAT: &str = "exact-kalman/subject/1";

fn line(name: &str) -> String {
    json!({"format": FORMAT, "name": name, "unsupported": ["diffuse"]}).to_string()
}

/// The first name that counts, and how many lines were passed over.
fn kept(declared: &Declared) -> (Option<&str>, usize) {
    (declared.declaration().and_then(|it| it.name.as_deref()), declared.remarks().len())
}

#[test]
fn the_schema_and_the_reader_agree() {
    let schema: Value = serde_json::from_str(SCHEMA).expect("JSON");
    let whole = json!({"format": FORMAT, "name": "a", "unsupported": ["diffuse", "correlated"]});
    for (document, expected) in [
        (whole.clone(), true),
        (json!({"format": FORMAT}), true),
        (json!({"format": FORMAT, "unsupported": []}), true),
        (json!({"name": "a"}), false),
        (with(whole.clone(), "/format", json!("exact-kalman/subject/2")), false),
        (with(whole.clone(), "/format", json!(null)), false),
        (with(whole.clone(), "/name", json!(null)), false),
        (with(whole.clone(), "/name", json!(1)), false),
        (with(whole.clone(), "/unsupported", json!("diffuse")), false),
        (with(whole.clone(), "/unsupported", json!(null)), false),
        (with(whole.clone(), "/unsupported", json!([1])), false),
        (with(whole.clone(), "/supported", json!([])), false),
        (json!([FORMAT]), false),
    ] {
        assert_eq!(valid(&schema, &schema, &document), expected, "schema: {document}");
        assert_eq!(Declaration::parse(&document.to_string()).is_ok(), expected, "reader: {document}");
    }
}

#[test]
fn another_version_is_meant_as_one_and_an_answer_is_not() {
    assert!(Declaration::is_meant_by(r#"{"unsupported":[],"format":"exact-kalman/subject/2"}"#));
    for other in [r#"{"id":"a","outcome":"answered"}"#, r#"{"format":"exact-kalman/case/1"}"#, "{", "", "[]", "{}"] {
        assert!(!Declaration::is_meant_by(other), "{other}");
    }
}

#[test]
fn its_length_is_bounded() {
    let rest = line("").len();
    assert!(Declaration::parse(&line(&"x".repeat(MAXIMAL_DECLARATION_BYTES - rest))).is_ok());
    let error = Declaration::parse(&line(&"x".repeat(MAXIMAL_DECLARATION_BYTES - rest + 1))).expect_err("one too many");
    assert!(error.to_string().contains("at most 65536"), "{error}");
}

#[test]
fn a_flag_is_unsupported_as_a_whole() {
    let case = |flags: Value| Case::parse(&with(walk(), "/flags", flags).to_string()).expect("a case");
    let declaration = Declaration::parse(&line("a")).expect("a declaration");
    assert_eq!(declaration.unsupported_flag(&case(json!(["basic", "diffuse"]))), Some("diffuse"));
    assert_eq!(declaration.unsupported_flag(&case(json!(["diffuse-trend", "Diffuse", "diff"]))), None);
    assert_eq!(declaration.unsupported_flag(&case(json!([]))), None);
}

#[test]
fn the_first_one_counts_if_no_answer_came_before_it() {
    let mut declared = Declared::default();
    declared.start();
    assert_eq!(kept(&declared), (None, 0));
    declared.line(&line("first"));
    assert_eq!(kept(&declared), (Some("first"), 0));
    declared.line(&line("first"));
    assert_eq!(kept(&declared), (Some("first"), 1), "twice, even if it is the same");
    declared.answer();
    declared.line(&line("late"));
    assert_eq!(kept(&declared), (Some("first"), 2));
    let mut late = Declared::default();
    late.answer();
    late.line(&line("late"));
    assert_eq!(kept(&late), (None, 1));
    assert!(late.remarks()[0].contains("after an answer"), "{:?}", late.remarks());
    late.start();
    late.line(&line("late"));
    assert_eq!(kept(&late), (None, 2), "what was asked before cannot be unasked");
}

#[test]
fn a_program_that_is_started_again_may_repeat_it() {
    let mut declared = Declared::default();
    for _ in 0..3 {
        declared.start();
        declared.line(&line("same"));
        declared.answer();
    }
    assert_eq!(kept(&declared), (Some("same"), 0));
    declared.start();
    declared.line(&line("other"));
    assert_eq!(kept(&declared), (Some("same"), 1));
    assert!(declared.remarks()[0].contains("something else"), "{:?}", declared.remarks());
}

#[test]
fn each_reason_is_told_once_and_few_are_kept() {
    let mut declared = Declared::default();
    for k in 0..100 {
        declared.line(&json!({"format": FORMAT, (format!("key {}", k / 2)): 1}).to_string());
    }
    let remarks = declared.remarks();
    assert_eq!(remarks.len(), 5);
    assert!(remarks[0].contains("key 0") && remarks[1].contains("key 1"), "{remarks:?}");
    declared.line(&line("good"));
    assert_eq!(kept(&declared).0, Some("good"), "a bad one does not spoil the next");
}
