//! A steady state for programs.

use std::io::{self, Write};

use serde_json::{Map, Value, json};

use super::enclosed::{named, rate, shown};
use super::{Finding, Page};
use crate::matrix::Matrix;
use crate::scalar::Interval;

pub(super) fn write(out: &mut impl Write, page: &Page<'_>, finding: &Finding) -> io::Result<()> {
    let all = match finding {
        Finding::Proved(state) => {
            let matrices: Map<String, Value> = named(page, state)
                .into_iter()
                .map(|(name, matrix)| (name.replace(' ', "_"), enclosed(&matrix, page.digits)))
                .collect();
            let of =
                |asked| page.other(state).filter(|(name, ..)| *name == asked).map_or(&[][..], |(_, _, states)| states);
            json!({"id": page.model.id, "verdict": "stabilising", "digits": page.known(state), "bits": state.bits,
                "kept": state.kept, "vanishing": state.vanishing, "filtered_vanishing": of("filtered"),
                "predicted_vanishing": of("predicted"), "rate": rate(state, page.digits.min(17)), "noise_is_covariance": page.is_covariance(),
                "matrices": matrices})
        }
        Finding::Absent(absence) => {
            json!({"id": page.model.id, "verdict": "absent", "reason": absence.to_string()})
        }
        Finding::Undecided(unproved, more) => {
            json!({"id": page.model.id, "verdict": "undecided", "reason": unproved.to_string(), "existence": more})
        }
    };
    writeln!(out, "{all}")
}

/// Decimals, and how far entries may be from them; nothing where an entry is correctly rounded.
fn enclosed(matrix: &Matrix<&Interval>, digits: u32) -> Value {
    let all = matrix.map(|entry| shown(entry, digits));
    let rows = |of: &dyn Fn(usize, usize) -> Value| {
        (0..all.rows()).map(|i| (0..all.columns()).map(|j| of(i, j)).collect::<Value>()).collect::<Value>()
    };
    let value = rows(&|i, j| all[(i, j)].value.clone().into());
    let within = rows(&|i, j| all[(i, j)].within.clone().into());
    json!({"value": value, "within": within})
}
