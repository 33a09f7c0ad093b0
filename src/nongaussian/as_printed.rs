//! The wrong equations as the paper prints them, so that a reader sees the difference. Nothing else uses them.

use super::{Statistics, StatisticsError, statistics};
use crate::matrix::Matrix;
use crate::model::Path;
use crate::scalar::OrderedField;

/// The statistics with (2.4) as printed: its last term is ΨᵀHᵀHΨ, without Σᵛ⁻¹. Right iff every Σᵛ that matters is I.
///
/// # Errors
///
/// As for [`statistics`].
pub fn statistics_with_printed_error<S: OrderedField>(
    path: &Path<S>,
) -> Result<Vec<Statistics<S>>, StatisticsError<S>> {
    let mut all = statistics(path)?;
    let n = path.states();
    let mut excess = Matrix::zeros(n, n);
    for (step, parts) in path.steps().iter().enumerate().take(all.len() - 1) {
        let seen = parts.observation.select_rows(&parts.reading.present()) * &all[step].transition;
        let right = &all[step + 1].information - &all[step].information;
        excess = excess + seen.transpose() * seen - right;
        all[step + 1].error = &all[step + 1].error + &excess;
    }
    Ok(all)
}

/// `log E[L | ξ = z]` with +½ in (3.14) and (3.15) as printed: zᵀMz, where a density has 0.
///
/// # Panics
///
/// If z is not n×1.
pub fn log_expectation<S: OrderedField>(ratio: &super::LikelihoodRatio<'_, S>, z: &Matrix<S>) -> S {
    ratio.quadratic(z)
}
