//! One examinee, for people.

use std::fmt::Write as _;

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};

use super::Report;
use crate::judge::{Judgement, Score, Verdict, meaning};
use crate::protocol::{Case, Decimal, short_witness};
use crate::trace::Quantity;

/// How many findings are shown unless all are asked for.
const SHOWN: usize = 20;

/// The report on one examinee: a line per case, then the findings, worst first, then the count.
pub fn text(report: &Report, all: bool) -> String {
    let mut out = format!("{}\n\n{}\n\n", report.examinee, table(report));
    out += "digits: correct / attainable, where they fall furthest behind; 17 means exact\n";
    let findings = report.findings();
    let shown = if all { findings.len() } else { findings.len().min(SHOWN) };
    for (place, (case, judgement)) in findings.iter().take(shown).enumerate() {
        let _ = write!(out, "\n{}. {} — {}\n{}", place + 1, case.id, judgement.verdict, finding(case, judgement));
    }
    if shown < findings.len() {
        let _ = writeln!(out, "\n… and {} more findings; --all shows them", findings.len() - shown);
    }
    out.push('\n');
    for remark in &report.remarks {
        let _ = writeln!(out, "note: {remark}");
    }
    let counts: Vec<String> = report.counts().iter().map(|(verdict, count)| format!("{count} {verdict}")).collect();
    let _ = writeln!(out, "{} cases: {}", report.results.len(), counts.join(", "));
    out
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
    let names = quantities.iter().map(|quantity| quantity.to_string().replace("covariance", "cov"));
    let mut table = plain_table(["case".to_owned()].into_iter().chain(names).chain(["verdict".to_owned()]).collect());
    for (case, judgement) in &report.results {
        let cell = |quantity: &Quantity| {
            let score = judgement.scores.iter().find(|score| score.quantity == *quantity);
            score.map_or_else(String::new, |score| format!("{}/{}", score.worst.digits, score.attainable))
        };
        let cells = quantities.iter().map(cell);
        table.add_row([case.id.clone()].into_iter().chain(cells).chain([judgement.verdict.to_string()]));
    }
    for column in 1..=quantities.len() {
        if let Some(column) = table.column_mut(column) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    trimmed(&table)
}

/// What there is to say about one finding.
fn finding(case: &Case, judgement: &Judgement) -> String {
    let mut out = String::new();
    let mut line = |text: String| {
        let _ = writeln!(out, "   {text}");
    };
    if !case.about.is_empty() {
        line(case.about.clone());
    }
    for remark in &judgement.remarks {
        line(remark.clone());
    }
    for score in judgement.scores.iter().filter(|score| score.verdict != Verdict::Agrees) {
        line(described(score));
    }
    if let Some((quantity, step, found)) = judgement.indefinite.as_ref().filter(|(.., found)| found.beyond_rounding) {
        let proof = short_witness(&found.matrix, &found.proof);
        let value = Decimal::rounded(&proof.value, 3);
        line(format!(
            "{quantity} at step {step} is not positive semidefinite: v = {} has vᵀPv = {value}",
            proof.witness
        ));
    }
    if let Some((quantity, step)) = judgement.asymmetric {
        line(format!("{quantity} at step {step} is not symmetric to the last bit"));
    }
    for flag in &case.flags {
        if let Some(meaning) = meaning(flag) {
            line(format!("{flag}: {meaning}"));
        }
    }
    out
}

fn described(score: &Score) -> String {
    let Score { quantity, step, worst, attainable, theirs, exact, .. } = score;
    let place =
        if quantity.is_vector() { format!("[{}]", worst.row) } else { format!("[{}, {}]", worst.row, worst.column) };
    format!(
        "{quantity} at step {step}, entry {place}: {} digits where {attainable} are attainable: {} answered, {} exact",
        worst.digits,
        Decimal::rounded(theirs, 17),
        Decimal::rounded(exact, 17),
    )
}
