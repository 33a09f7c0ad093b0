//! `verify` for certificates on steady states.

use num_bigint::BigInt;
use serde_json::json;

use super::numbers::Numbers;
use super::proved_interval::{shown_matrix, text};
use super::verify::{Failed, Verified, digits, rejected};
use crate::protocol::SteadyModel;
use crate::scalar::Rational;
use crate::verify::{Condition, ProvedSteady, SteadyDocument, check_steady};

/// Checks the document against the model inside, which must be the one that is given.
pub(super) fn verified(document: &str, given: Option<&SteadyModel>, most: u32) -> Result<Verified, Failed> {
    let document = SteadyDocument::parse(document).map_err(Failed::Rejected)?;
    let inside = |error| rejected(Condition::Case, format!("the model inside: {error}"));
    let model = SteadyModel::parse(&document.model.to_string()).map_err(inside)?;
    if given.is_some_and(|given| given.equation != model.equation) {
        return Err(rejected(Condition::Case, "the model inside is not the one that is given"));
    }
    let (step, timing) = model.step();
    let proved = check_steady(&step, timing, &document.evidence).map_err(Failed::Rejected)?;
    let (mut lines, mut members) = (Vec::new(), vec![("kind", json!("steady"))]);
    let mut verdict = |verdict: &str, words: String| {
        members.push(("verdict", json!(verdict)));
        lines.push(("verdict".to_owned(), words));
    };
    match proved {
        ProvedSteady::Stabilising { solution, bits, rate_squared, is_covariance } => {
            verdict("stabilising", "exactly one solution has a stable closed loop".into());
            let known = bits.map_or_else(|| "all: it is exact".to_owned(), |bits| digits(bits).to_string());
            let rate = rate(&root_above(&rate_squared), 10);
            let n = solution.states();
            let entries: Vec<Vec<String>> =
                (0..n).map(|i| (0..n).map(|j| text(&solution.covariance(i, j), most)).collect()).collect();
            lines.push(("digits proved, at least".into(), known));
            lines.push(("spectral radius, at most".into(), rate.clone()));
            if is_covariance {
                lines.push(("it is".into(), "positive semidefinite, and no other solution exceeds it".into()));
            }
            lines.push(("solution".into(), shown_matrix(&entries)));
            members.extend([
                ("digits", json!(bits.map(digits))),
                ("spectral_radius_at_most", json!(rate)),
                ("is_covariance", json!(is_covariance)),
                ("solution", json!(entries)),
            ]);
        }
        ProvedSteady::Unobservable { modes } => {
            let words =
                format!("no closed loop is stable: of {modes} unobserved eigenvalues one has modulus 1 or more");
            verdict("unobservable", words);
            members.push(("modes", json!(modes)));
        }
        ProvedSteady::Unreachable { modes } => {
            let words = format!(
                "no solution with a regular innovation covariance has a stable closed loop: of {modes} eigenvalues that no \
                 noise reaches, after feedback of the reading, one has modulus 1"
            );
            verdict("unreachable", words);
            members.push(("modes", json!(modes)));
        }
    }
    Ok(Verified { name: model.id, lines, members })
}

/// A number below 1, rounded up to so many digits, or more, so that it is seen to be below 1.
fn rate(root: &Rational, digits: u32) -> String {
    let text = Numbers { digits, exact: false }.above(root);
    if text == "1" && digits < 4096 { rate(root, 2 * digits) } else { text }
}

/// Not less than the root of a positive number, and little more.
fn root_above(square: &Rational) -> Rational {
    let (over, under) = (square.numer(), square.denom());
    let places = 64 + under.bits().saturating_sub(over.bits());
    let root: BigInt = ((over * under) << (2 * places)).sqrt() + 1;
    Rational::new(root, under << places)
}
