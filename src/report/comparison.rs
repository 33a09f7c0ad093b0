//! Several examinees side by side, for people.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use comfy_table::{CellAlignment, Table};

use super::Report;
use super::text::{incomplete, plain_table, printable, trimmed};
use crate::judge::{Digits, Judgement, Score, Verdict};

/// Several examinees side by side: by category how many cases agree, and the cases on which they differ, or all of them.
///
/// The reports must be on the same cases in the same order; a report that is shorter leaves cells empty.
pub fn side_by_side(reports: &[Report], all: bool) -> String {
    let cases = reports.first().map_or(0, |report| report.results.len());
    let mut out = format!("{}\n\n", trimmed(&by_category(reports)));
    let shown: Vec<usize> = (0..cases).filter(|&row| all || differ(reports, row)).collect();
    if shown.is_empty() {
        out += "No case tells them apart.\n";
    } else {
        let title = if all { "Each case" } else { "The cases that tell them apart" };
        let _ = write!(
            out,
            "{title}, fewest digits of any mean/of any covariance\n\n{}\n",
            trimmed(&by_case(reports, &shown))
        );
    }
    out.push('\n');
    for report in reports {
        let counts: Vec<String> = report.counts().iter().map(|(verdict, count)| format!("{count} {verdict}")).collect();
        let _ = writeln!(out, "{:16}{}", report.examinee, counts.join(", "));
    }
    out += "\n! loses more than 2 digits of those attainable, !! wrong, - unsupported. Digits are those of the step and entry\n\
            where there are fewest; 17 is exact, negative ones are wrong by so many powers of ten.\n";
    out + &reports.first().map(incomplete).unwrap_or_default()
}

/// A row for each category: how many cases agree of those that are supported, and the fewest digits of any quantity.
fn by_category(reports: &[Report]) -> Table {
    let mut table = table(reports, &["category", "cases"]);
    let cases = reports.first().map_or(&[][..], |report| &report.results);
    let mut categories: Vec<&str> = Vec::new();
    for (case, _) in cases {
        let category = category(&case.id);
        if !categories.contains(&category) {
            categories.push(category);
        }
    }
    let whole = (categories.len() > 1).then_some(None);
    for wanted in categories.into_iter().map(Some).chain(whole) {
        let is_wanted = |id: &str| wanted.is_none_or(|wanted| category(id) == wanted);
        let count = cases.iter().filter(|(case, _)| is_wanted(&case.id)).count();
        let cells = reports.iter().map(|report| {
            let judged = report.results.iter().filter(|(case, _)| is_wanted(&case.id)).map(|(_, judgement)| judgement);
            summary(&judged.collect::<Vec<_>>())
        });
        let name = wanted.map_or_else(|| "all".to_owned(), printable);
        table.add_row([name, count.to_string()].into_iter().chain(cells));
    }
    aligned(table, reports.len() + 1)
}

/// `agreeing/supported digits`.
fn summary(judgements: &[&Judgement]) -> String {
    let supported: Vec<_> = judgements.iter().filter(|judgement| judgement.verdict != Verdict::Unsupported).collect();
    if supported.is_empty() {
        return "-".to_owned();
    }
    let agreeing = supported.iter().filter(|judgement| judgement.verdict == Verdict::Agrees).count();
    let scores = supported.iter().flat_map(|judgement| &judgement.scores);
    let digits = scores.map(|score| score.fewest).reduce(Digits::min);
    let digits = digits.map_or_else(String::new, |digits| format!(" {digits:>2}"));
    format!("{agreeing}/{}{digits}", supported.len())
}

/// What stands before the first slash.
fn category(id: &str) -> &str {
    id.split_once('/').map_or(id, |(category, _)| category)
}

/// A row for each of the given cases.
fn by_case(reports: &[Report], rows: &[usize]) -> Table {
    let mut table = table(reports, &["case", "attainable"]);
    for &row in rows {
        let judgements = || reports.iter().filter_map(|report| report.results.get(row)).map(|(_, judgement)| judgement);
        let attainable = judgements()
            .map(|judgement| pair(judgement, |score| score.fewest_attainable))
            .find(|text| !text.is_empty());
        let id = reports.first().and_then(|report| report.results.get(row)).map(|(case, _)| printable(&case.id));
        table.add_row(
            [id.unwrap_or_default(), attainable.unwrap_or_default()].into_iter().chain(judgements().map(cell)),
        );
    }
    aligned(table, reports.len() + 1)
}

/// Whether the verdicts on a case are not all of one kind, those who do not support it left aside.
fn differ(reports: &[Report], row: usize) -> bool {
    let verdicts = reports.iter().filter_map(|report| report.results.get(row)).map(|(_, judgement)| judgement.verdict);
    let kinds: BTreeSet<&str> =
        verdicts.filter(|verdict| *verdict != Verdict::Unsupported).map(Verdict::name).collect();
    kinds.len() > 1
}

fn table(reports: &[Report], first: &[&str]) -> Table {
    // Names on two lines, so that nine of them fit beside each other.
    let names = reports.iter().map(|report| printable(&report.examinee).replace('-', "-\n"));
    plain_table(first.iter().map(ToString::to_string).chain(names).collect())
}

fn aligned(mut table: Table, last: usize) -> Table {
    for column in 1..=last {
        if let Some(column) = table.column_mut(column) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table
}

/// `mean/covariance`, the fewest of all that were judged; nothing if none was.
fn pair(judgement: &Judgement, digits: impl Fn(&Score) -> Digits) -> String {
    let of = |is_mean: bool| {
        let scores = judgement
            .scores
            .iter()
            .filter(|score| if is_mean { score.quantity.is_vector() } else { score.quantity.is_covariance() });
        scores.map(&digits).reduce(Digits::min)
    };
    let text = |digits: Option<Digits>| digits.map_or_else(|| "-".to_owned(), |digits| digits.to_string());
    match (of(true), of(false)) {
        (None, None) => String::new(),
        (mean, covariance) => format!("{}/{}", text(mean), text(covariance)),
    }
}

/// The digits, with a mark if they are the finding; another verdict in a word.
fn cell(judgement: &Judgement) -> String {
    let digits = pair(judgement, |score| score.fewest);
    match judgement.verdict {
        Verdict::Agrees if digits.is_empty() => "refused".to_owned(),
        Verdict::Agrees => digits,
        Verdict::Unsupported => "-".to_owned(),
        Verdict::Loses { .. } => format!("{digits} !"),
        Verdict::Wrong if !digits.is_empty() => format!("{digits} !!"),
        Verdict::AcceptedBadInput => "accepted".to_owned(),
        Verdict::RefusedValidInput => "refused !".to_owned(),
        other => other.name().to_owned(),
    }
}
