//! A steady state for people.

use std::io::{self, Write};

use super::enclosed::{named, rate, shown};
use super::{Finding, Page};
use crate::cli::numbers::laid_out;
use crate::report::printable;

pub(super) fn write(out: &mut impl Write, page: &Page<'_>, finding: &Finding) -> io::Result<()> {
    let (n, m) = (page.step.states(), page.step.sensors());
    let seen = if page.kind() == "control" { "input" } else { "sensor" };
    let (states, sensors) = (counted(n, "state"), counted(m, seen));
    writeln!(out, "{} · {states}, {sensors}, {}", printable(&page.model.id), page.kind())?;
    match finding {
        Finding::Proved(state) => {
            let known = match state.digits {
                None => "exactly".to_owned(),
                Some(digits) => format!("to {digits} digits of √(sᵢᵢ sⱼⱼ)"),
            };
            writeln!(out, "The stabilising solution, proved {known} with {} bits", state.bits)?;
            for (name, matrix) in named(page, state) {
                writeln!(out, "  {name:24} {}", laid_out(&matrix.map(|entry| shown(entry, page.digits).text())))?;
            }
            let (loop_, symbol) = if page.kind() == "control" { ("A − BF", "X") } else { ("A − KH", "S") };
            writeln!(out, "The closed loop {loop_} has spectral radius below {}", rate(state, page.digits.min(17)))?;
            if state.kept.len() < m {
                let kept: Vec<String> = state.kept.iter().map(ToString::to_string).collect();
                writeln!(out, "Used are {}; the others repeat them, noise included", named_list(seen, &kept))?;
            }
            if !state.vanishing.is_empty() {
                let vanishing: Vec<String> = state.vanishing.iter().map(ToString::to_string).collect();
                writeln!(out, "Not told from zero are the variances of {}", named_list("state", &vanishing))?;
            }
            if page.is_covariance() == Some(false) {
                writeln!(
                    out,
                    "The weights are indefinite: that {symbol} ≥ 0, or is the largest solution, is not claimed"
                )?;
            }
            Ok(())
        }
        Finding::Absent(absence) => {
            writeln!(out, "There is no stabilising solution: {absence}")
        }
        Finding::Undecided(unproved, more) => {
            writeln!(out, "Undecided: {unproved}")?;
            match more {
                Some(more) => writeln!(out, "  {more}"),
                None => Ok(()),
            }
        }
    }
}

fn named_list(what: &str, kept: &[String]) -> String {
    if kept.is_empty() { format!("no {what}s") } else { format!("{what}s {}", kept.join(", ")) }
}

fn counted(count: usize, what: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {what}{plural}")
}
