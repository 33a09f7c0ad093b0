//! The filter run on estimates, in `f64`.

use nalgebra::{SMatrix, SVector};

use super::Estimates;
use crate::model::Repair;

/// The adaptive filter between two readings (AK-2.3a, AK-2.3b, AK-2.3c, AK-2.4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdaptiveFilter<const P: usize> {
    /// x̂(k|k).
    pub mean: SVector<f64, P>,
    /// P̂(k).
    pub covariance: SMatrix<f64, P, P>,
    repair: Repair,
    /// The last V̂ and Ŵ that were positive semidefinite; zero before there is one.
    last: [SMatrix<f64, P, P>; 2],
}

/// What a step computed besides the belief.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gained<const P: usize> {
    /// Ŝ(k).
    pub predicted_covariance: SMatrix<f64, P, P>,
    /// Δ̂(k).
    pub gain: SMatrix<f64, P, P>,
}

impl<const P: usize> AdaptiveFilter<P> {
    /// The filter that starts with these moments.
    pub fn new(mean: SVector<f64, P>, covariance: SMatrix<f64, P, P>, repair: Repair) -> Self {
        Self { mean, covariance, repair, last: [SMatrix::zeros(); 2] }
    }

    /// Takes the reading y(k), with the estimates from y(1), …, y(k).
    ///
    /// Nothing, and no change, where a matrix has no inverse: Â(k) under [`Repair::Keep`], or Ŝ(k) + Ŵ(k) unless it
    /// is zero.
    pub fn observe(&mut self, estimates: &Estimates<P>, y: SVector<f64, P>) -> Option<Gained<P>> {
        let [v, w] = match estimates.noise() {
            Some((v, w)) => [self.repaired(0, Some(v)), self.repaired(1, Some(w))],
            None if self.repair == Repair::Keep => return None,
            None => [self.repaired(0, None), self.repaired(1, None)],
        };
        self.advance(estimates.transition, v, w, y)
    }

    /// One step with any matrices for A, V and W.
    pub fn advance(
        &mut self,
        a: SMatrix<f64, P, P>,
        v: SMatrix<f64, P, P>,
        w: SMatrix<f64, P, P>,
        y: SVector<f64, P>,
    ) -> Option<Gained<P>> {
        let s = a * self.covariance * a.transpose() + v;
        let sum = s + w;
        let gain = if sum.iter().all(|entry| *entry == 0.0) { sum } else { s * sum.try_inverse()? };
        let rest = SMatrix::<f64, P, P>::identity() - gain;
        self.mean = rest * (a * self.mean) + gain * y;
        self.covariance = rest * s;
        Some(Gained { predicted_covariance: s, gain })
    }

    fn repaired(&mut self, place: usize, estimate: Option<SMatrix<f64, P, P>>) -> SMatrix<f64, P, P> {
        match (estimate, self.repair) {
            (Some(estimate), Repair::Keep) => estimate,
            (Some(estimate), _) if is_semidefinite(estimate) => {
                self.last[place] = estimate;
                estimate
            }
            (_, Repair::LastSemidefinite) => self.last[place],
            _ => SMatrix::zeros(),
        }
    }
}

/// Whether LDLᵀ of the lower triangle meets no negative pivot, and no zero pivot above a nonzero entry.
fn is_semidefinite<const P: usize>(mut schur: SMatrix<f64, P, P>) -> bool {
    for k in 0..P {
        let pivot = schur[(k, k)];
        if pivot < 0.0 || pivot.is_nan() || (pivot == 0.0 && (k + 1..P).any(|i| schur[(i, k)] != 0.0)) {
            return false;
        }
        for i in k + 1..P {
            for j in k + 1..=i {
                if pivot > 0.0 {
                    schur[(i, j)] -= schur[(i, k)] / pivot * schur[(j, k)];
                }
            }
        }
    }
    true
}
