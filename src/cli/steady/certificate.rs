//! What proves a steady state, or that there is none, as a file.

use std::fs;
use std::path::Path;

use super::{Finding, Page};
use crate::certify::Absence;
use crate::cli::exit::Trouble;
use crate::matrix::Matrix;
use crate::scalar::Rational;
use crate::verify::{RationalRows, SteadyDocument, SteadyEvidence};

pub(super) fn write(file: &Path, page: &Page<'_>, finding: &Finding) -> Result<(), Trouble> {
    let place = file.display().to_string();
    let evidence = match finding {
        Finding::Proved(state) => SteadyEvidence::Stabilising(state.evidence.clone()),
        Finding::Absent(absence) => of_absence(absence),
        Finding::Undecided(..) => {
            not_written(&place, "nothing is proved, so there is no certificate");
            return Ok(());
        }
    };
    let document = SteadyDocument { model: page.model.document(), evidence };
    fs::write(file, document.to_line() + "\n").map_err(|source| Trouble::Input { place, source })
}

/// What is known is printed all the same.
fn not_written(place: &str, why: &str) {
    eprintln!("{place}: not written: {why}");
}

fn of_absence(absence: &Absence) -> SteadyEvidence {
    match absence {
        Absence::Unobservable { basis, map } => SteadyEvidence::Unobservable { basis: rows(basis), map: rows(map) },
        Absence::Unreachable { basis, injection, map, between } => SteadyEvidence::Unreachable {
            basis: rows(basis),
            injection: rows(injection),
            map: rows(map),
            between: between.as_ref().map(|(low, high)| [low.to_string(), high.to_string()]),
        },
    }
}

fn rows(matrix: &Matrix<Rational>) -> RationalRows {
    RationalRows((0..matrix.rows()).map(|i| matrix.row(i).iter().map(Rational::to_string).collect()).collect())
}
