//! The filter run on estimates, in `f64`.

use nalgebra::{DMatrix, SMatrix, SVector};

use super::Estimates;
use super::pseudo_inverse::pseudo_inverse;
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
    /// Nothing, and no change, where Â(k) has no inverse under [`Repair::Keep`], or a result is not finite.
    pub fn observe(&mut self, estimates: &Estimates<P>, y: SVector<f64, P>) -> Option<Gained<P>> {
        let last = self.last;
        let [v, w] = match estimates.noise() {
            Some((v, w)) => [self.repaired(0, Some(v)), self.repaired(1, Some(w))],
            None if self.repair == Repair::Keep => return None,
            None => [self.repaired(0, None), self.repaired(1, None)],
        };
        let gained = self.advance(estimates.transition, v, w, y);
        if gained.is_none() {
            self.last = last;
        }
        gained
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
        let gain = quotient(s, s + w)?;
        let rest = SMatrix::<f64, P, P>::identity() - gain;
        let (mean, covariance) = (rest * (a * self.mean) + gain * y, rest * s);
        if !mean.iter().chain(&covariance).all(|entry| entry.is_finite()) {
            return None;
        }
        (self.mean, self.covariance) = (mean, covariance);
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

/// `s t⁺` for symmetric s and t: by Cholesky where t is certainly positive definite, else by the spectrum of t.
fn quotient<const P: usize>(s: SMatrix<f64, P, P>, t: SMatrix<f64, P, P>) -> Option<SMatrix<f64, P, P>> {
    if let Some(factor) = t.cholesky() {
        let pivots = factor.l_dirty().diagonal().map(|pivot| pivot * pivot);
        #[expect(clippy::cast_precision_loss, reason = "no matrix has 2^53 rows")]
        let threshold = P as f64 * f64::EPSILON * pivots.max();
        if pivots.min() > threshold {
            return Some(factor.solve(&s).transpose());
        }
    }
    if P == 1 && t.iter().all(|entry| entry.is_finite()) {
        return Some(s.zip_map(&t, |s, t| if t == 0.0 { 0.0 } else { s / t }));
    }
    let inverse = pseudo_inverse(&DMatrix::from_fn(P, P, |i, j| t[(i, j)])).ok()?;
    Some(s * SMatrix::<f64, P, P>::from_fn(|i, j| inverse[(i, j)]))
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
