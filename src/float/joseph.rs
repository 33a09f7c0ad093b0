//! The form of Joseph, with noise shared between state and observation.

use nalgebra::DMatrix;

use super::error::Obstacle;
use super::moments::Moments;
use super::observed::Observed;
use super::recursion::{MomentRecursion, Update};
use super::symmetric::{congruence, with_transpose};
use super::transition::{Departure, Transition};

/// The covariance of the error as what it is, for any gain; symmetric to the last bit.
///
/// The filtered error is `(I − KC)(x − x̂) − Kv`, the error ahead `(A − K₊C)(x − x̂) + w − K₊v`; with
/// cov(x − x̂, v) = M₁ and cov(w, v) = M₂ their covariances are
///
/// ```text
/// (I − KC) P (I − KC)ᵀ + K R Kᵀ − (I − KC) M₁ Kᵀ − K M₁ᵀ (I − KC)ᵀ
/// (A − K₊C) P (A − K₊C)ᵀ + Q + K₊ R K₊ᵀ − M₂ K₊ᵀ − K₊ M₂ᵀ
/// ```
pub(super) struct Joseph;

impl MomentRecursion for Joseph {
    const NAME: &'static str = "joseph";
    const DESCRIPTION: &'static str = "gain by solving with S, covariance (I - KC)P(I - KC)' + KRK'";

    fn predicted(belief: &Moments, transition: &Transition) -> Result<Moments, Obstacle> {
        let Transition { matrix: a, input, noise: q } = transition;
        Ok(Moments { mean: a * &belief.mean + input, covariance: congruence(a, &belief.covariance) + q })
    }

    fn updated(
        belief: &Moments,
        observed: &Observed,
        departure: Option<&Departure<'_>>,
    ) -> Result<Update<Moments>, Obstacle> {
        let Moments { mean, covariance: p } = belief;
        let Observed { matrix: c, value, noise: r, state_noise: m } = observed;
        let innovation = value - c * mean;
        let s = congruence(c, p) + with_transpose(&(c * m)) + r;
        // S Kᵀ = Γᵀ. LU rather than Cholesky: the second of two equal rows then leaves a pivot that is exactly zero.
        let factors = s.clone().lu();
        let gain_for = |cross_covariance: DMatrix<f64>| {
            factors.solve(&cross_covariance.transpose()).map(|gain| gain.transpose()).ok_or(Obstacle::Singular)
        };
        let gain = gain_for(p * c.transpose() + m)?;
        let closed = DMatrix::identity(p.nrows(), p.nrows()) - &gain * c;
        let shared = with_transpose(&(&closed * m * gain.transpose()));
        let filtered = Moments {
            mean: mean + &gain * &innovation,
            covariance: congruence(&closed, p) + congruence(&gain, r) - shared,
        };
        let ahead = departure.map(|Departure { transition, cross_noise }| {
            let Transition { matrix: a, input, noise: q } = transition;
            let gain_ahead = gain_for(a * p * c.transpose() + cross_noise)?;
            let closed = a - &gain_ahead * c;
            let shared = with_transpose(&(cross_noise * gain_ahead.transpose()));
            Ok(Moments {
                mean: a * mean + input + &gain_ahead * &innovation,
                covariance: congruence(&closed, p) + q + congruence(&gain_ahead, r) - shared,
            })
        });
        let ahead = ahead.transpose()?;
        Ok(Update { innovation, innovation_covariance: s, gain: Some(gain), filtered, ahead })
    }
}
