//! Reports for programs.

use serde_json::{Value, json as object};

use super::{Report, diagnosis, entry};
use crate::judge::{Judgement, Score};
use crate::protocol::Case;

/// One object per examinee: what it declared, counts by verdict, how many cases are left unjudged and whether the first finding is
/// the reason, which known mistakes explain the findings, and for each case the verdict, its reasons and the digits.
pub fn json(report: &Report) -> Value {
    let counts: serde_json::Map<String, Value> =
        report.counts().into_iter().map(|(verdict, count)| (verdict.to_owned(), count.into())).collect();
    object!({
        "format": "exact-kalman/report/1",
        "examinee": report.examinee,
        "declaration": report.declaration,
        "counts": counts,
        "remarks": report.remarks,
        "unjudged": report.unjudged,
        "at_first_finding": report.at_first_finding,
        "diagnosis": diagnosis::json(report, &report.diagnosis()),
        "cases": report.results.iter().map(|(case, judgement)| result(case, judgement)).collect::<Vec<_>>(),
    })
}

fn result(case: &Case, judgement: &Judgement) -> Value {
    let indefinite = judgement.indefinite.as_ref().map(|(quantity, step, found)| {
        object!({
            "quantity": quantity.name(),
            "step": step,
            "beyond_rounding": found.beyond_rounding,
            "witness": found.proof.witness.entries().iter().map(ToString::to_string).collect::<Vec<_>>(),
        })
    });
    let asymmetric = judgement.asymmetric.map(|(quantity, step, found)| {
        object!({
            "quantity": quantity.name(),
            "step": step,
            "row": found.row,
            "column": found.column,
            "beyond_rounding": found.beyond_rounding,
        })
    });
    object!({
        "id": case.id,
        "flags": case.flags,
        "verdict": judgement.verdict.name(),
        "remarks": judgement.remarks,
        "structural": judgement.structural,
        "scores": judgement.scores.iter().map(score).collect::<Vec<_>>(),
        "not_psd": indefinite,
        "asymmetric": asymmetric,
    })
}

fn score(score: &Score) -> Value {
    object!({
        "quantity": score.quantity.name(),
        "verdict": score.verdict.name(),
        "step": score.step,
        "row": score.worst.row,
        "column": score.worst.column,
        "digits": tenths(score.worst.digits.value()),
        "attainable": tenths(score.attainable.value()),
        "fewest_digits": tenths(score.fewest.value()),
        "fewest_attainable": tenths(score.fewest_attainable.value()),
        "answered": entry::answered(&score.theirs),
        "exact": entry::exact(&score.exact),
    })
}

/// Digits to one place, rounded down like everywhere.
fn tenths(digits: f64) -> f64 {
    (digits * 10.0).floor() / 10.0
}
