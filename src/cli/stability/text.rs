//! Findings for people.

use std::io::{self, Write};

use super::Model;
use super::findings::{Arrivals, Critical, Findings, Moment, Observed};
use crate::cli::numbers::{Numbers, laid_out};
use crate::matrix::Matrix;
use crate::scalar::Rational;
use crate::stability::{MomentDoubt, MomentVerdict};

pub(super) fn write(out: &mut impl Write, model: &Model, findings: &Findings, numbers: Numbers) -> io::Result<()> {
    let page = Page { model, numbers };
    let (modes, states) = (counted(model.names.len(), "mode"), counted(model.process.states(), "state"));
    writeln!(out, "{} · {modes}, {states}", model.id)?;
    writeln!(out, "\nObservability (A1)")?;
    for line in page.observability(&findings.observability) {
        writeln!(out, "  {line}")?;
    }
    if let Some(bound) = &findings.bound {
        writeln!(out, "\nP(k) on every path")?;
        match bound {
            Ok(bound) => {
                let worst = bound.worst();
                let (trace, path) = (numbers.above(&worst.covariance.trace()), page.path(&worst.modes));
                writeln!(out, "  tr P(k) ≤ {trace} for k ≥ {}, whatever P(0); largest after {path}", bound.length)?;
            }
            Err(reason) => writeln!(out, "  bounded, but no bound was computed: {reason}")?,
        }
    }
    writeln!(out, "\nMoments of P(k)")?;
    for (order, moment) in &findings.moments {
        writeln!(out, "  order {order}  {}", page.moment(moment))?;
    }
    if let Some(arrivals) = &findings.arrivals {
        writeln!(out, "\nReadings that arrive with probability {}", page.number(&arrivals.probability))?;
        for line in page.arrivals(arrivals) {
            writeln!(out, "  {line}")?;
        }
    }
    if !findings.curve.is_empty() || findings.stopped.is_some() {
        writeln!(out, "\nP(k) over all paths, from P(0) = {}", page.matrix(&model.start))?;
    }
    for point in &findings.curve {
        let (mean, worst) = (page.matrix(&point.mean), page.matrix(&point.worst));
        writeln!(out, "  k = {}, {}", point.time, counted(point.values, "value"))?;
        writeln!(out, "    mean   {mean}")?;
        writeln!(out, "    worst  {worst}  after {}", page.path(&point.path))?;
    }
    if let Some(reason) = &findings.stopped {
        writeln!(out, "  stopped: {reason} (--most allows more)")?;
    }
    Ok(())
}

struct Page<'a> {
    model: &'a Model,
    numbers: Numbers,
}

impl Page<'_> {
    fn number(&self, value: &Rational) -> String {
        self.numbers.text(value)
    }

    fn matrix(&self, matrix: &Matrix<Rational>) -> String {
        laid_out(&matrix.map(|entry| self.number(entry)))
    }

    /// Modes in order, repeated ones once with a count.
    fn path(&self, modes: &[usize]) -> String {
        let runs = modes.chunk_by(|one, other| one == other);
        let run = |run: &[usize]| match run {
            [mode] => self.model.names[*mode].clone(),
            [mode, ..] => format!("{} ×{}", self.model.names[*mode], run.len()),
            [] => String::new(),
        };
        runs.map(run).collect::<Vec<_>>().join(" → ")
    }

    fn observability(&self, observed: &Observed) -> Vec<String> {
        match observed {
            Observed::Within { length, margin, shorter } => {
                let mut lines = vec![format!("holds with windows of {}", counted(*length, "reading"))];
                if let Some(margin) = margin {
                    lines.push(format!("each of their Gramians is above {} I", self.numbers.below(margin)));
                }
                if let Some(path) = shorter {
                    let (vector, modes) = (self.matrix(&path.vector), self.path(&path.modes));
                    lines.push(format!("shorter ones do not do: {modes} does not see v = {vector}"));
                }
                lines
            }
            Observed::Never(endless) => {
                let (head, cycle) = endless.modes.split_at(endless.back_to);
                let before = if head.is_empty() { String::new() } else { format!("{} and then ", self.path(head)) };
                vec![
                    "fails with windows of any length".to_owned(),
                    format!("{before}for ever {} never sees v = {}", self.path(cycle), self.matrix(&endless.vector())),
                ]
            }
            Observed::Undecided(reason) => vec![format!("{reason} (--most allows more)")],
        }
    }

    fn moment(&self, moment: &Moment) -> String {
        match moment {
            Moment::OnEveryPath => "bounded, as P(k) is on every path".to_owned(),
            Moment::Decided(MomentVerdict::Bounded(proof)) => {
                let power = if proof.order == 1 { String::new() } else { format!("^{}", proof.order) };
                format!("bounded: E (tr P(k)){power} ≤ {}", self.numbers.above(&proof.bound))
            }
            Moment::Decided(MomentVerdict::Unbounded(proof)) => {
                let names: Vec<&str> = proof.modes.iter().map(|&mode| self.model.names[mode].as_str()).collect();
                let names = names.join(", ");
                if proof.radius == Rational::from_integer(1.into()) {
                    return format!("unbounded: paths that stay in {names} keep what each step adds");
                }
                let one = Rational::from_integer(1.into());
                let rounded = self.numbers.below(&proof.radius);
                let times =
                    if rounded == one.to_string() { "more than 1".to_owned() } else { format!("at least {rounded}") };
                format!("unbounded: {times} times as large with each step of paths that stay in {names}")
            }
            Moment::Decided(MomentVerdict::Undecided(doubt)) => format!("undecided: {}", reason(*doubt)),
        }
    }

    fn arrivals(&self, arrivals: &Arrivals) -> Vec<String> {
        let mut lines = Vec::new();
        match &arrivals.critical {
            Critical::Exact(value) => {
                lines.push(format!(
                    "the mean stays bounded above the critical probability {}",
                    self.numbers.above(value)
                ));
            }
            Critical::NotSought => lines.push("the critical probability is sought for at most four states".to_owned()),
            Critical::Between(found) => {
                if let Some((at, _)) = &found.unbounded {
                    lines.push(format!("the mean is proved unbounded at {}", self.numbers.below(at)));
                }
                if let Some((at, _)) = &found.bounded {
                    lines.push(format!("the mean is proved bounded at {}", self.numbers.above(at)));
                }
                if let Some(gap) = found.gap() {
                    lines.push(format!(
                        "the critical probability lies between: undecided over {}",
                        self.numbers.above(&gap)
                    ));
                }
            }
        }
        if let Some((lower, upper)) = &arrivals.largest_moment {
            let (lower, upper) = (self.numbers.below(lower), self.numbers.above(upper));
            lines.push(format!("moments stay bounded below the order s with {lower} ≤ s < {upper}"));
        }
        lines
    }
}

pub(super) fn reason(doubt: MomentDoubt) -> String {
    match doubt {
        MomentDoubt::NoCertificate => "no gains were found that bound it, and nothing unobserved that grows".to_owned(),
        MomentDoubt::TooLarge { order } => format!("a linear system of order {order} would be needed"),
    }
}

fn counted(count: usize, what: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {what}{plural}")
}
