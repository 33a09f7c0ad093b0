//! What is shipped beside each case: the exact answer in decimals, and the digits that doubles can keep.

use serde::Serialize;
use serde_json::value::RawValue;
use std::collections::BTreeMap;

use crate::judge::{Digits, Reference, Truth};
use crate::protocol::{Answer, Case, Decimal, Outcome};
use crate::trace::Quantity;

/// Significant digits of a reference: more than any double holds, and few enough to read.
const DIGITS: u32 = 25;

/// Beyond so many steps a reference holds only the moments of the state.
const DETAILED: usize = 100;

#[derive(Serialize)]
struct Document<'a> {
    format: &'static str,
    id: &'a str,
    digits: u32,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    attainable: BTreeMap<&'static str, String>,
    answer: Box<RawValue>,
}

/// The reference of a case as a document of the format `exact-kalman/reference/1`: under `answer` stands an exact answer,
/// correctly rounded to 25 significant digits, as a program could have given it. Nothing for a truth that is unknown.
///
/// # Examples
///
/// ```
/// use exact_kalman::{judge::{Truth, suite}, report::reference};
///
/// let case = &suite()[0];
/// let document = reference(case, &Truth::of(case)).expect("the truth is known");
/// assert!(document.contains(r#""filtered_mean":["0.5"]"#));
/// ```
pub fn reference(case: &Case, truth: &Truth) -> Option<String> {
    let (answer, attainable) = match truth {
        Truth::Unknown(_) => return None,
        Truth::BadInput(why) => (without_steps(case, Outcome::Refused, why), BTreeMap::new()),
        Truth::Known(reference) => (answer(case, reference), attainable(reference)),
    };
    let answer = RawValue::from_string(answer).ok()?;
    let document = Document { format: "exact-kalman/reference/1", id: &case.id, digits: DIGITS, attainable, answer };
    serde_json::to_string(&document).ok().map(|text| a_step_a_line(&text))
}

fn without_steps(case: &Case, outcome: Outcome, why: &str) -> String {
    let answer: Answer<Decimal> = Answer::answered(&case.id, Vec::new());
    Answer { outcome, message: Some(why.to_owned()), ..answer }.to_line()
}

fn answer(case: &Case, reference: &Reference) -> String {
    let shown = |quantity: Quantity| {
        let moments = [
            Quantity::FilteredMean,
            Quantity::FilteredCovariance,
            Quantity::PredictedMean,
            Quantity::PredictedCovariance,
        ];
        reference.values.len() <= DETAILED || moments.contains(&quantity)
    };
    let steps = reference.values.iter().map(|values| {
        let shown = values.iter().filter(|(quantity, _)| shown(**quantity));
        shown.map(|(&quantity, matrix)| (quantity, matrix.map(|value| Decimal::rounded(value, DIGITS)))).collect()
    });
    let answer = Answer::answered(&case.id, steps.collect());
    match &reference.contradiction {
        None => answer.to_line(),
        Some((step, why)) => {
            Answer { outcome: Outcome::Flagged, step: Some(*step), message: Some(why.to_string()), ..answer }.to_line()
        }
    }
}

/// The fewest attainable digits of each quantity over all steps, cut to tenths.
fn attainable(reference: &Reference) -> BTreeMap<&'static str, String> {
    let mut fewest: BTreeMap<Quantity, Digits> = BTreeMap::new();
    for (&quantity, &digits) in reference.attainable.iter().flatten() {
        fewest.entry(quantity).and_modify(|least| *least = least.min(digits)).or_insert(digits);
    }
    let tenths = |digits: Digits| format!("{:.1}", (digits.value() * 10.0).floor() / 10.0);
    fewest.into_iter().map(|(quantity, digits)| (quantity.name(), tenths(digits))).collect()
}

/// The same document with a line for each step.
fn a_step_a_line(text: &str) -> String {
    const STEPS: &str = r#""steps":["#;
    let Some((head, steps)) = text.split_once(STEPS) else { return format!("{text}\n") };
    let head = head.replacen(r#","answer":"#, ",\n\"answer\":", 1);
    let steps = steps.replace("},{", "},\n{").replacen("]}}", "\n]}}", usize::from(steps.starts_with('{')));
    let begin = if steps.starts_with('{') { "\n" } else { "" };
    format!("{head}{STEPS}{begin}{steps}\n")
}
