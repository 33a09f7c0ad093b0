//! The example of the protocol page is a case and its answer, and the page says what the code says.

use exact_kalman::protocol::{
    Answer, Case, Limits, MAXIMAL_DOCUMENT_BYTES, MAXIMAL_EXACT_EXPONENT, MAXIMAL_LITERAL_CHARACTERS, Number, Numbers,
    Outcome,
};
use exact_kalman::scalar::{exact_value, ratio};
use exact_kalman::trace::Quantity;
use serde_json::Value;

use crate::schema::{ANSWER, CASE, valid};

const PAGE: &str = include_str!("../../docs/PROTOCOL.md");

fn example(kind: &str) -> &'static str {
    let fence = format!("```json {kind}\n");
    PAGE.split(&fence).nth(1).and_then(|rest| rest.split("```").next()).expect("the example")
}

#[test]
fn the_example_agrees_with_the_schemas() {
    for (kind, schema) in [("case", CASE), ("answer", ANSWER)] {
        let schema: Value = serde_json::from_str(schema).unwrap();
        assert!(valid(&schema, &schema, &serde_json::from_str(example(kind)).unwrap()), "{kind}");
    }
}

#[test]
fn the_answer_is_the_one_worked_by_hand() {
    let case = Case::parse(example("case")).unwrap();
    let path = case.problem().unwrap().realised().unwrap();
    let answer = Answer::parse(example("answer")).unwrap();
    assert_eq!((&answer.id, answer.outcome), (&case.id, Outcome::Answered));
    // The scalar recursion in exact fractions, written out.
    let (mut mean, mut variance) = (ratio(0, 1), ratio(1, 1));
    for (k, (values, step)) in answer.steps.iter().zip(path.steps()).enumerate() {
        if k > 0 {
            variance += ratio(1, 1);
        }
        let spread = &variance + ratio(1, 1);
        let gain = &variance / &spread;
        let innovation = step.reading.entries()[0].as_ref().unwrap() - &mean;
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
            let small = |n: &num_bigint::BigInt| n.to_string().parse::<f64>().unwrap();
            let double = exact_value(small(exact.numer()) / small(exact.denom())).unwrap();
            assert_eq!(values[&quantity][(0, 0)], Number::Finite(double), "{quantity} at step {k}");
        }
        (mean, variance) = filtered;
    }
    assert_eq!(answer.steps.len(), 2);
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
    let limits = Limits::default();
    assert!(PAGE.contains(&format!("{} seconds a case", limits.case_time.as_secs())));
    assert!(PAGE.contains(&format!("{} MiB", limits.output_bytes >> 20)));
    assert_eq!(limits.output_bytes, MAXIMAL_DOCUMENT_BYTES);
}
