//! One examinee, for people.

use std::fmt::Write as _;

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};

use super::declared::declared;
pub(super) use super::printable::printable;
use super::{Report, diagnosis, entry};
use crate::judge::{Diagnosis, Judgement, Score, Verdict, meaning};
use crate::protocol::{Case, Decimal, short_witness};
use crate::trace::Quantity;

/// How many findings are shown unless all are asked for.
pub(super) const SHOWN: usize = 20;

/// What the numbers of a table are.
pub(super) const ATTAINABLE: &str = "\
Correct digits / attainable digits, at the step where they fall furthest behind; 17 is exact.
Attainable is what is left of the answer when all data are moved by one part in 2^53; where an
innovation covariance is singular, at most 15. Negative digits: wrong by so many powers of ten.
";

/// How many lines of a message that came from outside are shown: the last ones, where programs say what went wrong.
const MESSAGE_LINES: usize = 12;

/// The report on one examinee: a line per case, then the findings, worst first, then which known
/// mistakes explain them, then the count.
pub fn text(report: &Report, all: bool) -> String {
    let mut out = format!("{}\n{}\n{}\n\n", printable(&report.examinee), declared(report), table(report));
    if report.results.iter().any(|(_, judgement)| !judgement.scores.is_empty()) {
        out += ATTAINABLE;
    }
    let (findings, looks) = (report.placed_findings(), report.diagnosis());
    // What many come for stands before the details.
    out += &diagnosis::section(&looks);
    let shown = if all { findings.len() } else { findings.len().min(SHOWN) };
    if !findings.is_empty() {
        let _ = writeln!(out, "\n{}, worst first", counted(findings.len(), "finding"));
    }
    for (number, &(place, (case, judgement))) in findings.iter().take(shown).enumerate() {
        let id = printable(&case.id);
        let _ =
            write!(out, "\n{}. {id}: {}\n{}", number + 1, judgement.verdict, finding(case, judgement, place, &looks));
    }
    if shown < findings.len() {
        let _ = writeln!(out, "\n… and {}; --all shows them", counted(findings.len() - shown, "more finding"));
    }
    if all {
        out += &nearly(report);
    }
    out.push('\n');
    for remark in &report.remarks {
        let _ = writeln!(out, "note: {}", printable(remark));
    }
    let counts: Vec<String> = report.counts().iter().map(|(verdict, count)| format!("{count} {verdict}")).collect();
    let _ = writeln!(out, "{}: {}", counted(report.results.len(), "case"), counts.join(", "));
    out + &incomplete(report)
}

/// Where answers that agree are more than a digit behind: within what is forgiven, but somebody may want to know.
fn nearly(report: &Report) -> String {
    let behind = |score: &&Score| score.attainable.value() - score.worst.digits.value() > 1.0;
    let mut out = String::new();
    for (case, judgement) in report.results.iter().filter(|(_, judgement)| judgement.verdict == Verdict::Agrees) {
        for score in judgement.scores.iter().filter(behind) {
            let _ = writeln!(out, "   {}: {}", printable(&case.id), described(score));
        }
    }
    if out.is_empty() { out } else { format!("\nAgreeing, but more than a digit behind\n{out}") }
}

/// What is to be said of a report that is not on all cases.
pub(super) fn incomplete(report: &Report) -> String {
    match report.unjudged {
        0 => String::new(),
        cases if report.at_first_finding => {
            format!("incomplete: stopped at the first finding, and {} not asked\n", counted(cases, "more case"))
        }
        cases => format!("incomplete: interrupted, and {} not judged\n", counted(cases, "more case")),
    }
}

pub(super) fn counted(count: usize, noun: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{plural}")
}

/// A table in the house's style: no lines, columns apart.
pub(super) fn plain_table(header: Vec<String>) -> Table {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Disabled).set_header(header);
    if let Some(first) = table.column_mut(0) {
        first.set_padding((0, 1));
    }
    table
}

/// The table as text, without blanks at the ends of lines.
pub(super) fn trimmed(table: &Table) -> String {
    let lines: Vec<String> = table.lines().map(|line| line.trim_end().to_owned()).collect();
    lines.join("\n")
}

fn table(report: &Report) -> String {
    let quantities: Vec<Quantity> = Quantity::ALL
        .into_iter()
        .filter(|quantity| {
            report.results.iter().any(|(_, judgement)| judgement.scores.iter().any(|score| score.quantity == *quantity))
        })
        .collect();
    // Two short lines each, so that six quantities fit on a screen.
    let names = quantities.iter().map(|quantity| quantity.name().replace("covariance", "cov").replace('_', "\n"));
    let mut table = plain_table(["case".to_owned(), "verdict".to_owned()].into_iter().chain(names).collect());
    for (case, judgement) in &report.results {
        let cell = |quantity: &Quantity| {
            let score = judgement.scores.iter().find(|score| score.quantity == *quantity);
            score.map_or_else(String::new, |score| format!("{}/{}", score.worst.digits, score.attainable))
        };
        let cells = quantities.iter().map(cell);
        table.add_row([printable(&case.id), judgement.verdict.to_string()].into_iter().chain(cells));
    }
    for column in 2..quantities.len() + 2 {
        if let Some(column) = table.column_mut(column) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    trimmed(&table)
}

/// What there is to say about one finding.
pub(super) fn finding(case: &Case, judgement: &Judgement, place: usize, looks: &Diagnosis) -> String {
    let mut out = String::new();
    let mut line = |text: String| {
        let _ = writeln!(out, "   {text}");
    };
    if !case.about.is_empty() {
        line(printable(&case.about));
    }
    looks.explanations_of(place).map(diagnosis::line).for_each(&mut line);
    for remark in &judgement.remarks {
        last_lines(remark).into_iter().for_each(&mut line);
    }
    let behind = || judgement.scores.iter().filter(|score| score.verdict != Verdict::Agrees);
    behind().map(described).for_each(&mut line);
    if judgement.structural && behind().next().is_some() {
        line(
            "at most 15 digits count as attainable: an innovation covariance is singular, which moved data may not keep"
                .into(),
        );
    }
    if let Some((quantity, step, found)) = judgement.indefinite.as_ref().filter(|(.., found)| found.beyond_rounding) {
        let proof = short_witness(&found.matrix, &found.proof);
        let value = Decimal::rounded(&proof.value, 3);
        line(format!(
            "{quantity} at step {step} is not positive semidefinite: v = {} has vᵀPv = {value}",
            proof.witness.transpose()
        ));
    }
    if let Some((quantity, step, found)) = judgement.asymmetric {
        let by = if found.beyond_rounding { "" } else { " to the last bit" };
        let (row, column) = (found.row, found.column);
        line(format!(
            "{quantity} at step {step} is not symmetric{by}: entries [{row}, {column}] and [{column}, {row}]"
        ));
    }
    for flag in &case.flags {
        if let Some(meaning) = meaning(flag) {
            line(format!("({flag}: {meaning})"));
        }
    }
    out
}

/// The last lines of a text.
fn last_lines(text: &str) -> Vec<String> {
    let lines: Vec<&str> = text.trim_end().lines().collect();
    let left_out = lines.len().saturating_sub(MESSAGE_LINES);
    let note = (left_out > 0).then(|| format!("… {} …", counted(left_out, "line")));
    // The first line says what the others are.
    let (first, rest) = if left_out > 0 { lines.split_at(1) } else { lines.split_at(0) };
    let kept = rest.iter().skip(if left_out > 0 { left_out } else { 0 });
    first.iter().map(|line| printable(line)).chain(note).chain(kept.map(|line| printable(line))).collect()
}

fn described(score: &Score) -> String {
    let Score { quantity, step, worst, attainable, theirs, exact, .. } = score;
    let place =
        if quantity.is_vector() { format!("[{}]", worst.row) } else { format!("[{}, {}]", worst.row, worst.column) };
    format!(
        "{quantity} at step {step}, entry {place}: {} digits where {attainable} are attainable: {} answered, {} exact",
        worst.digits,
        entry::answered(theirs),
        entry::exact(exact),
    )
}
