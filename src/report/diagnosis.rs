//! What a run looks like, in words.

use std::fmt::Write as _;

use serde_json::{Value, json as object};

use super::Report;
use crate::judge::{Diagnosis, Explanation, Kind};

/// What comes at the end of a text.
pub(super) fn section(diagnosis: &Diagnosis) -> String {
    if diagnosis.explanations.is_empty() {
        return String::new();
    }
    let mut out = "\nWhat it looks like\n".to_owned();
    for explanation in &diagnosis.explanations {
        let Explanation { mistake, shows, met, .. } = explanation;
        let _ = writeln!(out, "\n{}: {}{}", mistake.name, mistake.sentence, ways(explanation));
        let tail = match mistake.kind {
            Kind::Mistake => "with it",
            Kind::Reading => "if it is read so; this is a convention, not a fault",
        };
        let _ = match *shows {
            1 => writeln!(out, "   The one answer in which it would show agrees {tail}."),
            _ => writeln!(out, "   {met} of the {shows} answers in which it would show agree {tail}."),
        };
        if !explanation.alike.is_empty() {
            let names: Vec<&str> = explanation.alike.iter().map(|other| other.name).collect();
            let _ = writeln!(out, "   These answers do not tell it from {}.", names.join(", "));
        }
        let _ = writeln!(out, "   Remedy: {}", mistake.remedy);
        let _ = writeln!(out, "   More: exact-kalman explain {}", mistake.name);
    }
    out
}

/// What is said under a finding.
pub(super) fn line(explanation: &Explanation) -> String {
    let mistake = explanation.mistake;
    format!("this is the answer if {}{} ({})", mistake.sentence, ways(explanation), mistake.name)
}

fn ways(explanation: &Explanation) -> String {
    match &explanation.ways[..] {
        [] => String::new(),
        ways => format!(" ({})", ways.join(" or ")),
    }
}

/// The same for programs.
pub(super) fn json(report: &Report, diagnosis: &Diagnosis) -> Value {
    let one = |explanation: &Explanation| {
        let ids = explanation.explains.iter().filter_map(|&place| report.results.get(place)).map(|(case, _)| &case.id);
        object!({
            "mistake": explanation.mistake.name,
            "kind": explanation.mistake.kind.name(),
            "sentence": explanation.mistake.sentence,
            "remedy": explanation.mistake.remedy,
            "ways": explanation.ways,
            "shows": explanation.shows,
            "met": explanation.met,
            "cases": ids.collect::<Vec<_>>(),
            "alike": explanation.alike.iter().map(|other| other.name).collect::<Vec<_>>(),
        })
    };
    diagnosis.explanations.iter().map(one).collect()
}
