//! Everything that one step of the filter computes.

use super::{Quantity, Values};
use crate::matrix::Matrix;
use crate::scalar::Rational;

/// Mean and covariance of the state; while a diffuse start is not resolved, also P∞.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Moments<T> {
    /// The mean, n×1.
    pub mean: Matrix<T>,
    /// The covariance, n×n.
    pub covariance: Matrix<T>,
    /// P∞, n×n: the covariance is `covariance + κ·diffuse` as κ → ∞.
    pub diffuse: Option<Matrix<T>>,
}

/// The exact parts of the log likelihood of one observation,
/// `−½ (quadratic + ln pseudo_determinant + rank · ln 2π)`.
///
/// If S is singular this is a density on its range. Directions that are still diffuse are left out, with no
/// constant in their place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Likelihood<T> {
    /// νᵀS⁺ν
    pub quadratic: T,
    /// The product of the nonzero eigenvalues of S.
    pub pseudo_determinant: T,
    /// The rank of S.
    pub rank: usize,
}

/// One step: the state before y_k, what y_k says, the state after.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Record<T> {
    /// Which entries of y_k were observed.
    pub observed: Vec<usize>,
    /// x_k given y_0, …, y_{k−1}; its covariance is R(k−1) in CKS.
    pub predicted: Moments<T>,
    /// E(y_k | y_0, …, y_{k−1})
    ///
    /// CKS-9: `E[y(t+1) | Y(t)] = C(t)E(x(t+1) | Y(t)) + G(t)v(t)`
    pub predicted_observation: Matrix<T>,
    /// ν
    pub innovation: Matrix<T>,
    /// S
    ///
    /// CKS-7: `P_yy|z = E[ν νᵀ | Y(t)], ν = y(t+1) − E(y(t+1) | Y(t))`
    pub innovation_covariance: Matrix<T>,
    /// The rank of S, its part of order κ included.
    pub innovation_rank: usize,
    /// cov(x_k, y_k | y_0, …, y_{k−1})
    ///
    /// CKS-6: `P_xy|z = E[(x(t+1) − E(x(t+1) | Y(t))) νᵀ | Y(t)]`
    pub cross_covariance: Matrix<T>,
    /// The part of S that grows with κ, while a diffuse start is not resolved.
    pub innovation_diffuse: Option<Matrix<T>>,
    /// K = cov(x_k, y_k) S⁺, or its limit as κ → ∞.
    pub gain: Matrix<T>,
    /// x_k given y_0, …, y_k.
    pub filtered: Moments<T>,
    /// The parts of the log likelihood of y_k; absent if S has a diffuse part.
    pub likelihood: Option<Likelihood<T>>,
}

/// The records of all steps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trace<T> {
    /// One record per observation.
    pub records: Vec<Record<T>>,
    /// The state after the last transition, if the path has one after its last observation.
    pub ahead: Option<Moments<T>>,
}

impl Record<Rational> {
    /// The length in bits of the longest denominator that goes on to the next step.
    pub fn denominator_bits(&self) -> u64 {
        let Moments { covariance, diffuse, .. } = &self.filtered;
        let entries = covariance.entries().iter().chain(diffuse.iter().flat_map(Matrix::entries));
        entries.map(|entry| entry.denom().bits()).max().unwrap_or(0)
    }
}

impl<T: Clone> Record<T> {
    /// The results by name. What is still diffuse has no value and is absent.
    pub fn values(&self) -> Values<T> {
        let mut values = Values::new();
        for (moments, mean, covariance) in [
            (&self.predicted, Quantity::PredictedMean, Quantity::PredictedCovariance),
            (&self.filtered, Quantity::FilteredMean, Quantity::FilteredCovariance),
        ] {
            if moments.diffuse.is_none() {
                values.insert(mean, moments.mean.clone());
                values.insert(covariance, moments.covariance.clone());
            }
        }
        if self.predicted.diffuse.is_none() && !self.observed.is_empty() {
            values.insert(Quantity::Innovation, self.innovation.clone());
            values.insert(Quantity::InnovationCovariance, self.innovation_covariance.clone());
            values.insert(Quantity::Gain, self.gain.clone());
        }
        values
    }
}
