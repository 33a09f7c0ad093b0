//! Findings for programs, with the certificates.

use std::io::{self, Write};

use serde_json::{Value, json};

use super::Model;
use super::findings::{Critical, Findings, Moment, Observed};
use super::text::reason;
use crate::cli::numbers::Numbers;
use crate::matrix::Matrix;
use crate::scalar::Rational;
use crate::stability::{MomentBound, MomentGrowth, MomentVerdict, UniformBound, WindowBound};

pub(super) fn write(out: &mut impl Write, model: &Model, findings: &Findings, numbers: Numbers) -> io::Result<()> {
    let page = Page { model, numbers };
    let bound = findings.bound.as_ref().map(|bound| match bound {
        Ok(bound) => page.bound(bound),
        Err(reason) => json!({"undecided": reason}),
    });
    let moments: Vec<Value> = findings.moments.iter().map(|(order, moment)| page.moment(*order, moment)).collect();
    let arrivals = findings.arrivals.as_ref().map(|arrivals| {
        let ends = arrivals.largest_moment.as_ref();
        let largest = ends.map(|(lower, upper)| json!([lower.to_string(), upper.to_string()]));
        let critical = match &arrivals.critical {
            Critical::Exact(value) => json!({"exact": value.to_string()}),
            Critical::NotSought => Value::Null,
            Critical::Between(found) => json!({
                "unbounded": found.unbounded.as_ref().map(|(at, proof)| json!({"at": at.to_string(), "proof": page.growth(proof)})),
                "bounded": found.bounded.as_ref().map(|(at, proof)| json!({"at": at.to_string(), "proof": moment_bound(proof)})),
            }),
        };
        json!({"probability": arrivals.probability.to_string(), "critical": critical, "largest_moment": largest})
    });
    let points: Vec<Value> = findings
        .curve
        .iter()
        .map(|point| {
            json!({"step": point.time, "values": point.values, "mean": page.matrix(&point.mean),
                "worst": page.matrix(&point.worst), "worst_path": page.path(&point.path)})
        })
        .collect();
    let all = json!({"id": model.id, "observability": page.observability(&findings.observability), "uniform_bound": bound,
        "moments": moments, "arrivals": arrivals, "steps": points, "stopped": findings.stopped});
    writeln!(out, "{all}")
}

struct Page<'a> {
    model: &'a Model,
    numbers: Numbers,
}

fn rows(texts: &Matrix<String>) -> Value {
    (0..texts.rows()).map(|i| Value::from(texts.row(i).to_vec())).collect()
}

/// The matrix of a proof, which is never rounded.
fn proof_matrix(matrix: &Matrix<Rational>) -> Value {
    rows(&matrix.map(Rational::to_string))
}

/// A column of a proof, as a list.
fn proof_vector(column: &Matrix<Rational>) -> Value {
    column.entries().iter().map(Rational::to_string).collect()
}

fn moment_bound(proof: &MomentBound) -> Value {
    let list = |matrices: &[Matrix<Rational>]| matrices.iter().map(proof_matrix).collect::<Value>();
    json!({"bound": proof.bound.to_string(), "gains": list(&proof.gains), "lyapunov": list(&proof.lyapunov)})
}

impl Page<'_> {
    fn matrix(&self, matrix: &Matrix<Rational>) -> Value {
        rows(&matrix.map(|entry| self.numbers.text(entry)))
    }

    fn path(&self, modes: &[usize]) -> Value {
        modes.iter().map(|&mode| Value::from(self.model.names[mode].clone())).collect()
    }

    fn observability(&self, observed: &Observed) -> Value {
        match observed {
            Observed::Within { length, margin, shorter } => json!({
                "verdict": "holds", "length": length, "margin": margin.as_ref().map(Rational::to_string),
                "shorter": shorter.as_ref().map(|path| json!({"modes": self.path(&path.modes), "vector": proof_vector(&path.vector)})),
            }),
            Observed::Never(endless) => json!({
                "verdict": "fails", "modes": self.path(&endless.modes), "back_to": endless.back_to,
                "vector": proof_vector(&endless.vector()),
                "subspaces": endless.subspaces.iter().map(proof_matrix).collect::<Vec<_>>(),
            }),
            Observed::Undecided(reason) => json!({"verdict": "undecided", "reason": reason.to_string()}),
        }
    }

    fn bound(&self, bound: &UniformBound<Rational>) -> Value {
        let worst = bound.worst();
        let window = |window: &WindowBound<Rational>| json!({"modes": self.path(&window.modes), "covariance": proof_matrix(&window.covariance)});
        json!({"length": bound.length, "windows": bound.windows.iter().map(window).collect::<Vec<_>>(), "trace": worst.covariance.trace().to_string(),
            "modes": self.path(&worst.modes), "covariance": proof_matrix(&worst.covariance)})
    }

    fn moment(&self, order: usize, moment: &Moment) -> Value {
        let (verdict, key, value) = match moment {
            Moment::OnEveryPath => ("bounded", "reason", json!("P(k) is bounded on every path")),
            Moment::Decided(MomentVerdict::Bounded(proof)) => ("bounded", "proof", moment_bound(proof)),
            Moment::Decided(MomentVerdict::Unbounded(proof)) => ("unbounded", "proof", self.growth(proof)),
            Moment::Decided(MomentVerdict::Undecided(doubt)) => ("undecided", "reason", json!(reason(*doubt))),
        };
        json!({"order": order, "verdict": verdict, key: value})
    }

    fn growth(&self, proof: &MomentGrowth) -> Value {
        json!({"modes": self.path(&proof.modes), "subspace": proof_matrix(&proof.subspace),
            "radius": proof.radius.to_string(), "recurrent": proof.recurrent})
    }
}
