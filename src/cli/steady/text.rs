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
            let known = match page.known(state) {
                None => "exactly".to_owned(),
                Some(digits) => format!("to {digits} digits of √(sᵢᵢ sⱼⱼ)"),
            };
            writeln!(out, "The stabilising solution, proved {known} with {} bits", state.bits)?;
            for (name, matrix) in named(page, state) {
                writeln!(out, "  {name:24} {}", laid_out(&matrix.map(|entry| shown(entry, page.digits).text())))?;
            }
            let (loop_, solution, weights) = if page.kind() == "control" {
                ("A − BF", "X", "The weights are indefinite")
            } else {
                ("A − KH", "the predicted covariance", "The noise is no covariance: its joint matrix is indefinite")
            };
            writeln!(out, "The closed loop {loop_} has spectral radius below {}", rate(state, page.digits.min(17)))?;
            if state.kept.len() < m {
                let verb = if state.kept.len() == 1 { "is" } else { "are" };
                let kept = named_list(seen, &state.kept);
                writeln!(out, "Used {verb} {kept}; what is left out repeats that, noise included")?;
            }
            if !state.vanishing.is_empty() {
                writeln!(out, "Not told from zero: the variance of {}", named_list("state", &state.vanishing))?;
            }
            if let Some((name, _, states)) = page.other(state).filter(|(_, _, states)| !states.is_empty()) {
                writeln!(out, "Not told from zero: the {name} variance of {}", named_list("state", states))?;
            }
            if !page.is_covariance() {
                writeln!(out, "{weights}; that {solution} ≥ 0, or the largest solution, is not claimed")?;
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

fn named_list(what: &str, places: &[usize]) -> String {
    let names: Vec<String> = places.iter().map(ToString::to_string).collect();
    match names.as_slice() {
        [] => format!("no {what}"),
        [one] => format!("{what} {one}"),
        _ => format!("{what}s {}", names.join(", ")),
    }
}

fn counted(count: usize, what: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {what}{plural}")
}
