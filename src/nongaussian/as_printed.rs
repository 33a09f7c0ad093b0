//! The wrong equations as the paper prints them, so that a reader sees the difference. Nothing else uses them.
//!
//! # Examples
//!
//! The smallest example: A = H = Σʷ = 1, Σᵛ = 2, ξ = 0 or 1 with a fair coin, and the reading 1. Bayes' rule says that the next
//! state has the mean 1/(1 + exp(−1/4)) = 0.5622; with (2.4) as printed it comes out as 0.6225.
//!
//! ```
//! use exact_kalman::matrix::Matrix;
//! use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
//! use exact_kalman::nongaussian::{as_printed, statistics, Enclosed, InitialLaw, Statistics};
//! use exact_kalman::scalar::{ratio, Rational};
//!
//! let one = Matrix::<Rational>::identity(1);
//! let system = System {
//!     timing: Timing::Departing,
//!     initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), Matrix::zeros(1, 1)),
//!     transition: one.clone().into(),
//!     observation: one.clone().into(),
//!     noise: Noise::Covariances { process: one.clone().into(), cross: None, observation: one.scaled(&ratio(2, 1)).into() },
//!     input: None,
//!     observation_input: None,
//! };
//! let path = system.realised(&[Observation::complete([ratio(1, 1)])])?;
//! let coin = InitialLaw::atoms([(ratio(1, 2), Matrix::zeros(1, 1)), (ratio(1, 2), one)])?;
//! // The mean in units of 1/10000, rounded down.
//! let mean = |now: &Statistics<Rational>| match &now.posterior(&coin).mean(40) {
//!     Ok(entries) => match &entries[0] {
//!         Enclosed::Between(interval) => interval.lower().value().map(|x| (x * ratio(10_000, 1)).to_integer()),
//!         Enclosed::Exact(value) => Some((value * ratio(10_000, 1)).to_integer()),
//!     },
//!     Err(_) => None,
//! };
//! assert_eq!(mean(&statistics(&path)?[1]), Some(5621.into()));
//! assert_eq!(mean(&as_printed::statistics_with_printed_error(&path)?[1]), Some(6224.into()));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::girsanov::log_likelihood_ratios;
use super::{Decomposition, LogDensity, Shift, Statistics, StatisticsError, statistics};
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

/// log L(t) by (2.12) as printed, for t = 1, 2, … in L(t+1): L(0) = 1 and L(2), L(3), … have values, L(1) has none.
///
/// # Panics
///
/// As for [`log_likelihood_ratios`].
pub fn log_likelihood_ratio<S: OrderedField>(shifts: &[Shift<S>], noise: &[Matrix<S>], t: usize) -> Option<S> {
    if t == 1 { None } else { log_likelihood_ratios(shifts, noise).into_iter().nth(t) }
}

/// The new noise with (3.5) as printed, where no minus sign stands before the bracket: +[Σʷ − ΣʷᵛΣᵛ⁻¹Σᵛʷ]φ.
///
/// # Panics
///
/// As for [`Decomposition::new_noise`].
pub fn new_noise<S: OrderedField>(parts: &Decomposition<S>, z: &Matrix<S>, noise: &[Matrix<S>]) -> Vec<Matrix<S>> {
    parts.shifted(z, noise, &S::one())
}

/// The exponent of (3.6), (3.14) and (3.15) as printed, with +½ before the quadratic sum: its mean is not 1 but the
/// exponential of that sum, exp(zᵀMz) with the choice of the paper.
///
/// # Panics
///
/// As for [`Decomposition::log_density`].
pub fn log_density<S: OrderedField>(parts: &Decomposition<S>, z: &Matrix<S>) -> LogDensity<S> {
    parts.density_with(z, &S::one())
}

/// The exponent of (3.17) as printed: the linear part of the inverse, and −½ before the quadratic sum.
///
/// # Panics
///
/// As for [`Decomposition::log_density`].
pub fn inverse_log_density<S: OrderedField>(parts: &Decomposition<S>, z: &Matrix<S>) -> LogDensity<S> {
    let right = parts.log_density(z).inverse();
    LogDensity { constant: right.constant.negated(), ..right }
}

/// The coefficients of W°(1), …, W°(t+1) in X°(t+1) with (4.4) as printed, Φ(t,s), where Φ(t+1,s+1) is right; the path has
/// t+1 transitions or more.
///
/// # Panics
///
/// If it has fewer.
pub fn noise_coefficients<S: OrderedField>(path: &Path<S>, t: usize) -> Vec<Matrix<S>> {
    let matrix = |s: usize| match &path.steps()[s].transition {
        Some(transition) => &transition.matrix,
        None => panic!("no transition {s}"),
    };
    let phi = |to: usize, from: usize| (from..to).fold(Matrix::identity(path.states()), |phi, s| matrix(s) * phi);
    (0..=t).map(|s| phi(t, s)).collect()
}
