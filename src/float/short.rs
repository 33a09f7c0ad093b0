//! The short covariance update, for forms that hold an inverse of S.

use nalgebra::DMatrix;

use super::error::Obstacle;
use super::moments::Moments;
use super::observed::Observed;
use super::recursion::Update;
use super::transition::{Departure, Transition};

/// `A x̂ + B u, A P Aᵀ + Q`
pub(super) fn predicted(before: &Moments, transition: &Transition) -> Moments {
    let Transition { matrix: a, input, noise: q } = transition;
    Moments { mean: a * &before.mean + input, covariance: a * &before.covariance * a.transpose() + q }
}

/// The filtered moments and those ahead, with whatever `inverse` takes for the inverse of S.
///
/// ```text
/// filtered: x̂ + Kν,            (I − KC)P − K M₁ᵀ
/// ahead:    A x̂ + Bu + K₊ν,    A P Aᵀ + Q − K₊ S K₊ᵀ
/// ```
///
/// The first is P − KΓᵀ, since Γᵀ = CP + M₁ᵀ. Neither is symmetric under rounding, and nothing makes it so: that
/// is what these forms are.
///
/// # Errors
///
/// What `inverse` returns.
pub(super) fn updated(
    predicted: &Moments,
    observed: &Observed,
    departure: Option<&Departure<'_>>,
    inverse: impl FnOnce(&DMatrix<f64>) -> Result<DMatrix<f64>, Obstacle>,
) -> Result<Update<Moments>, Obstacle> {
    let Moments { mean, covariance: p } = predicted;
    let Observed { matrix: c, value, noise: r, state_noise: m } = observed;
    let innovation = value - c * mean;
    let cm = c * m;
    let s = c * p * c.transpose() + &cm + cm.transpose() + r;
    let weight = inverse(&s)?;
    let gain = (p * c.transpose() + m) * &weight;
    let identity = DMatrix::identity(p.nrows(), p.nrows());
    let filtered =
        Moments { mean: mean + &gain * &innovation, covariance: (identity - &gain * c) * p - &gain * m.transpose() };
    let ahead = departure.map(|Departure { transition, cross_noise }| {
        let Transition { matrix: a, input, noise: q } = transition;
        let gain_ahead = (a * p * c.transpose() + cross_noise) * &weight;
        Moments {
            mean: a * mean + input + &gain_ahead * &innovation,
            covariance: a * p * a.transpose() + q - &gain_ahead * &s * gain_ahead.transpose(),
        }
    });
    Ok(Update { innovation, innovation_covariance: s, gain: Some(gain), filtered, ahead })
}
