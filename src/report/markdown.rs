//! Reports for a comment on a change, or an issue.

use std::fmt::Write as _;

use super::declared::{short, unsupported};
use super::text::{ATTAINABLE, SHOWN, counted, finding, incomplete, printable};
use super::{Report, diagnosis};
use crate::judge::{Diagnosis, Judgement, Score, Verdict};
use crate::protocol::Case;
use crate::trace::Quantity;

/// The columns after which a line of details is broken.
const WIDTH: usize = 100;

/// One section for each report: the counts, the findings as a table and in words, then all cases.
///
/// What came from outside stands in code, where nothing is obeyed: no markup, no mention, no link.
pub fn markdown(reports: &[Report], all: bool) -> String {
    reports.iter().map(|report| section(report, all)).collect::<Vec<_>>().join("\n")
}

fn section(report: &Report, all: bool) -> String {
    let (findings, looks) = (report.placed_findings(), report.diagnosis());
    let cases = counted(report.results.len(), "case");
    let heading = match findings.len() {
        0 => format!("no finding in {cases}"),
        count => format!("{} in {cases}", counted(count, "finding")),
    };
    let mut out = format!("### exact-kalman: {heading}\n\nJudged: {}", code(&report.examinee));
    if let Some(declaration) = &report.declaration {
        let name = declaration.name.as_deref().map_or_else(|| "no name".to_owned(), |name| code(&short(name)));
        let flags = unsupported(report).map_or_else(String::new, |flags| format!("; unsupported: {}", code(&flags)));
        let _ = write!(out, ", declares {name}{flags}");
    }
    out += "\n\n| verdict | cases |\n|---|---:|\n";
    for (verdict, count) in report.counts() {
        let _ = writeln!(out, "| {verdict} | {count} |");
    }
    for remark in &report.remarks {
        let _ = write!(out, "\nNote: {}\n", code(remark));
    }
    let left = incomplete(report);
    if !left.is_empty() {
        let _ = write!(out, "\n**{}**\n", left.trim_end());
    }
    if !findings.is_empty() {
        out += &found(&findings, if all { findings.len() } else { SHOWN }, &looks);
        out += &looks_like(&looks);
    }
    out += &every_case(report);
    out
}

/// The findings, worst first.
fn found(findings: &[(usize, &(Case, Judgement))], most: usize, looks: &Diagnosis) -> String {
    let mut out = "\n| | finding | verdict | what | digits | attainable |\n|---:|---|---|---|---:|---:|\n".to_owned();
    let shown = || findings.iter().take(most).enumerate().map(|(place, result)| (place + 1, result));
    for (place, (_, (case, judgement))) in shown() {
        let behind = |score: &&Score| score.verdict != Verdict::Agrees;
        let missing = |score: &Score| score.attainable.value() - score.worst.digits.value();
        let worst = judgement.scores.iter().filter(behind).max_by(|one, other| missing(one).total_cmp(&missing(other)));
        let digits = worst.map_or_else(
            || format!("{} | |", judgement.remarks.first().map_or_else(String::new, |why| code(&short(why)))),
            |score| {
                format!("{} at step {} | {} | {}", score.quantity, score.step, score.worst.digits, score.attainable)
            },
        );
        let _ = writeln!(out, "| {place} | {} | {} | {digits} |", code(&case.id), judgement.verdict);
    }
    if most < findings.len() {
        let _ = writeln!(out, "\n… and {}; `--all` shows them", counted(findings.len() - most, "more finding"));
    }
    out += "\n<details><summary>The findings in words</summary>\n";
    for (number, (place, (case, judgement))) in shown() {
        let words: String =
            finding(case, judgement, *place, looks).lines().map(|line| wrapped(line.trim_start())).collect();
        let fence = fence(&words);
        let _ = write!(
            out,
            "\n**{number}.** {}: **{}**\n\n{fence}text\n{words}{fence}\n",
            code(&case.id),
            judgement.verdict
        );
    }
    out + "\n</details>\n"
}

/// Which known mistakes explain the findings.
fn looks_like(looks: &Diagnosis) -> String {
    let section = diagnosis::section(looks);
    let words: String = section.lines().skip(2).map(|line| wrapped(line.trim_start())).collect();
    if words.is_empty() { words } else { format!("\n**What it looks like**\n\n```text\n{words}```\n") }
}

/// The table of all cases.
fn every_case(report: &Report) -> String {
    let quantities: Vec<Quantity> = Quantity::ALL
        .into_iter()
        .filter(|quantity| {
            report.results.iter().any(|(_, judgement)| judgement.scores.iter().any(|score| score.quantity == *quantity))
        })
        .collect();
    let mut out = "\n<details><summary>All cases</summary>\n\n| case | verdict |".to_owned();
    for quantity in &quantities {
        let _ = write!(out, " {quantity} |");
    }
    let _ = writeln!(out, "\n|---|---|{}", "---:|".repeat(quantities.len()));
    for (case, judgement) in &report.results {
        let _ = write!(out, "| {} | {} |", code(&case.id), judgement.verdict);
        for quantity in &quantities {
            let score = judgement.scores.iter().find(|score| score.quantity == *quantity);
            let _ = match score {
                Some(score) => write!(out, " {} / {} |", score.worst.digits, score.attainable),
                None => write!(out, " |"),
            };
        }
        out.push('\n');
    }
    if !quantities.is_empty() {
        let _ = write!(out, "\n{ATTAINABLE}");
    }
    out + "\n</details>\n"
}

/// Text from outside, as code: between backquotes, or with all punctuation as entities if it has backquotes of its own, or
/// bars, which end a cell of a table.
fn code(text: &str) -> String {
    let text = printable(text);
    let text = text.trim();
    if !text.is_empty() && !text.contains(['`', '|', '\\']) {
        return format!("`{text}`");
    }
    let entity = |c: char| if c.is_ascii_punctuation() { format!("&#{};", u32::from(c)) } else { c.to_string() };
    format!("<code>{}</code>", text.chars().map(entity).collect::<String>())
}

/// A fence that is longer than any in the text.
fn fence(text: &str) -> String {
    let (mut longest, mut run) = (2, 0);
    for c in text.chars() {
        run = if c == '`' { run + 1 } else { 0 };
        longest = longest.max(run);
    }
    "`".repeat(longest + 1)
}

/// The line, broken at spaces, each line with its end.
fn wrapped(line: &str) -> String {
    let (mut out, mut column) = (String::new(), 0);
    for word in line.split(' ') {
        let length = word.chars().count();
        if column > 0 && column + 1 + length > WIDTH {
            out += "\n  ";
            column = 2;
        } else if column > 0 {
            out.push(' ');
            column += 1;
        }
        out += word;
        column += length;
    }
    out + "\n"
}
