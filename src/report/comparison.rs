//! Several examinees side by side, for people.

use std::fmt::Write as _;

use comfy_table::CellAlignment;

use super::Report;
use super::text::{incomplete, plain_table, printable, trimmed};
use crate::judge::{Digits, Judgement, Score, Verdict};
use crate::trace::Quantity;

/// The fewest digits of the filtered mean and covariance of each examinee, case by case. The reports must be on the
/// same cases in the same order; a report that is shorter leaves cells empty.
pub fn side_by_side(reports: &[Report]) -> String {
    let names = reports.iter().map(|report| report.examinee.clone());
    let header = ["case".to_owned(), "attainable".to_owned()].into_iter().chain(names).collect();
    let mut table = plain_table(header);
    let cases = reports.first().map_or(&[][..], |report| &report.results);
    for (row, (case, _)) in cases.iter().enumerate() {
        let judgements = || reports.iter().filter_map(|report| report.results.get(row)).map(|(_, judgement)| judgement);
        let attainable = judgements()
            .map(|judgement| pair(judgement, |score| score.fewest_attainable))
            .find(|text| !text.is_empty());
        let cells = judgements().map(cell);
        table.add_row([printable(&case.id), attainable.unwrap_or_default()].into_iter().chain(cells));
    }
    for column in 1..=reports.len() + 1 {
        if let Some(column) = table.column_mut(column) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    let mut out = trimmed(&table);
    out += "\n\n";
    for report in reports {
        let counts: Vec<String> = report.counts().iter().map(|(verdict, count)| format!("{count} {verdict}")).collect();
        let _ = writeln!(out, "{:16}{}", report.examinee, counts.join(", "));
    }
    out + &reports.first().map(incomplete).unwrap_or_default()
}

/// `mean/covariance`, or nothing if neither was judged.
fn pair(judgement: &Judgement, digits: impl Fn(&Score) -> Digits) -> String {
    let of = |quantity: Quantity| {
        let score = judgement.scores.iter().find(|score| score.quantity == quantity);
        score.map(|score| digits(score).to_string())
    };
    match (of(Quantity::FilteredMean), of(Quantity::FilteredCovariance)) {
        (Some(mean), Some(covariance)) => format!("{mean}/{covariance}"),
        _ => String::new(),
    }
}

/// The digits, with a mark if they are the finding; the verdict where it says more, or is about other quantities.
fn cell(judgement: &Judgement) -> String {
    let digits = pair(judgement, |score| score.fewest);
    match judgement.verdict {
        Verdict::Agrees if digits.is_empty() => "refused".to_owned(),
        Verdict::Agrees => digits,
        Verdict::Loses { .. } | Verdict::Wrong if is_seen(judgement) => format!("{digits} !"),
        other if digits.is_empty() => other.to_string(),
        other => format!("{digits} {}", other.name()),
    }
}

/// Whether one of the two quantities that are shown is to blame.
fn is_seen(judgement: &Judgement) -> bool {
    let shown = |score: &&Score| matches!(score.quantity, Quantity::FilteredMean | Quantity::FilteredCovariance);
    judgement.scores.iter().filter(shown).any(|score| score.verdict != Verdict::Agrees)
}
