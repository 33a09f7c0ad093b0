//! The example of the protocol page is a case and its answer, and the page says what the code says.

use std::io::Write as _;
use std::process::{Command, Stdio};

use exact_kalman::protocol::{
    Answer, Case, Declaration, Limits, MAXIMAL_DECLARATION_BYTES, MAXIMAL_DOCUMENT_BYTES, MAXIMAL_EXACT_EXPONENT,
    MAXIMAL_LITERAL_CHARACTERS, Number, Numbers, Outcome,
};
use exact_kalman::scalar::{exact_value, ratio};
use exact_kalman::trace::Quantity;
use serde_json::Value;

use crate::declaration::SCHEMA as SUBJECT;
use crate::schema::{ANSWER, CASE, valid};

const PAGE: &str = include_str!("../../docs/PROTOCOL.md");

fn example(kind: &str) -> &'static str {
    block(&format!("json {kind}"))
}

fn block(kind: &str) -> &'static str {
    let fence = format!("```{kind}\n");
    PAGE.split(&fence).nth(1).and_then(|rest| rest.split("```").next()).expect("the example")
}

#[test]
fn the_example_agrees_with_the_schemas() {
    for (kind, schema) in [("case", CASE), ("answer", ANSWER), ("subject", SUBJECT)] {
        let schema: Value = serde_json::from_str(schema).expect("JSON");
        assert!(valid(&schema, &schema, &serde_json::from_str(example(kind)).expect("JSON")), "{kind}");
    }
}

#[test]
fn the_answer_is_the_one_worked_by_hand() {
    let case = Case::parse(example("case")).expect("a sound case");
    let path = case.problem().expect("a sound case").realised().expect("a sound system");
    let answer = Answer::parse(example("answer")).expect("a sound answer");
    assert_eq!((&answer.id, answer.outcome), (&case.id, Outcome::Answered));
    // The scalar recursion in exact fractions, written out.
    let (mut mean, mut variance) = (ratio(0, 1), ratio(1, 1));
    for (k, (values, step)) in answer.steps.iter().zip(path.steps()).enumerate() {
        if k > 0 {
            variance += ratio(1, 1);
        }
        let spread = &variance + ratio(1, 1);
        let gain = &variance / &spread;
        let innovation = step.reading.entries()[0].as_ref().expect("present") - &mean;
        let filtered = (&mean + &gain * &innovation, &variance - &gain * &variance);
        for (quantity, exact) in [
            (Quantity::PredictedMean, &mean),
            (Quantity::PredictedCovariance, &variance),
            (Quantity::Innovation, &innovation),
            (Quantity::InnovationCovariance, &spread),
            (Quantity::Gain, &gain),
            (Quantity::FilteredMean, &filtered.0),
            (Quantity::FilteredCovariance, &filtered.1),
        ] {
            // The small fractions of the example are quotients of small integers: one correctly rounded division.
            let small = |n: &num_bigint::BigInt| n.to_string().parse::<f64>().expect("a number");
            let double = exact_value(small(exact.numer()) / small(exact.denom())).expect("finite");
            assert_eq!(values[&quantity][(0, 0)], Number::Finite(double), "{quantity} at step {k}");
        }
        (mean, variance) = filtered;
    }
    assert_eq!(answer.steps.len(), 2);
}

/// The lines of the exchange in one direction.
fn wire(direction: &str) -> Vec<&'static str> {
    block("text wire").lines().filter_map(|line| line.strip_prefix(direction)).collect()
}

#[test]
fn the_exchange_is_the_example_on_the_wire() {
    let case = Case::parse(example("case")).expect("the case");
    assert_eq!(wire("< "), [case.to_line()]);
    let [declaration, answer] = wire("> ")[..] else { panic!("two lines") };
    let declaration = Declaration::parse(declaration).expect("a declaration");
    assert_eq!(declaration.unsupported_flag(&case), None);
    let answer = Answer::parse(answer).expect("an answer");
    let right = Answer::parse(example("answer")).expect("the answer");
    let last = |answer: &Answer| answer.steps[1][&Quantity::FilteredMean][(0, 0)].clone();
    assert_eq!((answer.id.as_str(), last(&answer)), (right.id.as_str(), last(&right)));
}

/// What is shown as printed by the subject is what it prints, byte for byte.
#[test]
fn the_subject_prints_what_the_exchange_shows() {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/subjects/textbook.py");
    let mut command = Command::new("python3");
    command.arg(script).stdin(Stdio::piped()).stdout(Stdio::piped());
    let Ok(mut child) = command.spawn() else { return eprintln!("not run: there is no python3 here") };
    let sent: String = wire("< ").join("\n") + "\n";
    child.stdin.take().expect("it is piped").write_all(sent.as_bytes()).expect("it is read");
    let output = child.wait_with_output().expect("it ends");
    let shown: String = wire("> ").join("\n") + "\n";
    assert_eq!(String::from_utf8(output.stdout).expect("UTF-8"), shown);
}

#[test]
fn the_page_names_every_subject() {
    let directory = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/subjects");
    let mut count = 0;
    for entry in std::fs::read_dir(directory).expect("it is there") {
        let name = entry.expect("it can be read").file_name().into_string().expect("UTF-8");
        if name.contains('.') {
            assert!(PAGE.contains(&format!("(../examples/subjects/{name})")), "{name}");
            count += 1;
        }
    }
    assert!(count >= 9, "{count}");
}

#[test]
fn the_page_names_every_name_and_limit() {
    let names = Quantity::ALL.map(Quantity::name);
    let numbers = [Numbers::Binary64, Numbers::Binary32, Numbers::Exact].map(Numbers::name);
    let outcomes = ["answered", "refused", "flagged", "error", "unsupported"];
    for name in names.iter().chain(&numbers).chain(&outcomes).chain(&["ahead"]) {
        assert!(PAGE.contains(&format!("`{name}`")), "{name}");
    }
    assert!(PAGE.contains(&format!("at most {MAXIMAL_LITERAL_CHARACTERS} characters")));
    assert!(PAGE.contains(&format!("of at most {MAXIMAL_EXACT_EXPONENT}.")));
    assert!(PAGE.contains(&format!("more than {MAXIMAL_DECLARATION_BYTES} bytes")));
    let limits = Limits::default();
    assert!(PAGE.contains(&format!("{} seconds a case", limits.case_time.as_secs())));
    assert!(PAGE.contains(&format!("{} MiB", limits.output_bytes >> 20)));
    assert_eq!(limits.output_bytes, MAXIMAL_DOCUMENT_BYTES);
}
