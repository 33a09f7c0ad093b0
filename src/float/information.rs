//! The information form: P⁻¹.

use nalgebra::{DMatrix, DVector};

use super::error::{Inverted, Obstacle};
use super::factor::Factor;
use super::moments::Moments;
use super::observed::Observed;
use super::recursion::{Recursion, Update};
use super::symmetric::{congruence, with_transpose};
use super::transition::{Departure, Transition};

/// Carries `Y = P⁻¹` and `z = P⁻¹x̂`; a reading is a sum.
///
/// Noise that is shared with the state is first told by it: v = M₁ᵀP⁻¹(x − x̂) + ṽ, and that of a departing transition by the
/// reading, w = M₂R⁻¹v + w̃.
///
/// ```text
/// C̃ = C + M₁ᵀP⁻¹,  R̃ = R − M₁ᵀP⁻¹M₁           Y' = Y + C̃ᵀR̃⁻¹C̃,   z' = z + C̃ᵀR̃⁻¹(y + M₁ᵀP⁻¹x̂)
/// Ã = A − M₂R⁻¹C,  Q̃ = Q − M₂R⁻¹M₂ᵀ           P₊ = Ã P' Ãᵀ + Q̃,    x̂₊ = Ã x̂' + B u + M₂R⁻¹y
/// ```
///
/// Source: Anderson and Moore, *Optimal Filtering*, 6.3; the transition goes through P, so that A need not be invertible. Good where
/// readings are many and the prior says little; a sensor without noise, a state that is known and a state without noise of
/// its own after a singular A have no information matrix: it stops there, since what comes out otherwise is rounding
/// error ([`rank`](super::rank) decides). Each moment that it is asked for costs an inverse, and so a condition number of P.
pub(super) struct Information;

/// Y and z.
#[derive(Clone, Debug)]
pub(super) struct Belief {
    information: DMatrix<f64>,
    vector: DVector<f64>,
}

impl Belief {
    fn of(moments: &Moments, what: Inverted) -> Result<Self, Obstacle> {
        let information = inverse(&moments.covariance, what)?;
        let vector = &information * &moments.mean;
        Ok(Self { information, vector })
    }
}

impl Recursion for Information {
    const NAME: &'static str = "information";
    const DESCRIPTION: &'static str = "inverse of P, readings added; refuses singular P and R";
    type Belief = Belief;

    fn start(moments: Moments) -> Result<Belief, Obstacle> {
        Belief::of(&moments, Inverted::Start)
    }

    fn moments(belief: &Belief) -> Result<Moments, Obstacle> {
        let covariance = inverse(&belief.information, Inverted::State)?;
        Ok(Moments { mean: &covariance * &belief.vector, covariance })
    }

    fn predicted(belief: &Belief, transition: &Transition) -> Result<Belief, Obstacle> {
        let Moments { mean, covariance } = Self::moments(belief)?;
        let Transition { matrix: a, input, noise: q } = transition;
        let ahead = Moments { mean: a * mean + input, covariance: congruence(a, &covariance) + q };
        Belief::of(&ahead, Inverted::State)
    }

    fn updated(
        belief: &Belief,
        observed: &Observed,
        departure: Option<&Departure<'_>>,
    ) -> Result<Update<Belief>, Obstacle> {
        let Observed { matrix: c, value, noise: r, state_noise: m } = observed;
        let Belief { information, vector } = belief;
        let Moments { mean, covariance: p } = Self::moments(belief)?;
        let innovation = value - c * &mean;
        let innovation_covariance = congruence(c, &p) + with_transpose(&(c * m)) + r;
        let told = m.transpose() * information;
        let (seen, noise) = if observed.shares_noise() {
            (c + &told, r - congruence(&m.transpose(), information))
        } else {
            (c.clone(), r.clone())
        };
        let weight = inverse(&noise, Inverted::Noise)?;
        let weighted = seen.transpose() * &weight;
        let filtered = Belief {
            information: information + congruence(&seen.transpose(), &weight),
            vector: vector + &weighted * (value + told * &mean),
        };
        let after = Self::moments(&filtered)?;
        let ahead = departure.map(|Departure { transition, cross_noise }| {
            let Transition { matrix: a, input, noise: q } = transition;
            let fed = cross_noise * &weight;
            let closed = a - &fed * c;
            let rest = q - congruence(cross_noise, &weight);
            let ahead = Moments {
                mean: &closed * &after.mean + input + &fed * value,
                covariance: congruence(&closed, &after.covariance) + rest,
            };
            Belief::of(&ahead, Inverted::State)
        });
        let gain = Some(&after.covariance * weighted);
        Ok(Update { innovation, innovation_covariance, gain, filtered, ahead: ahead.transpose()? })
    }
}

/// The inverse of a positive definite matrix by its factors; symmetric to the last bit.
///
/// # Errors
///
/// [`Obstacle::NoInverse`] if some pivot is nothing but rounding.
fn inverse(p: &DMatrix<f64>, what: Inverted) -> Result<DMatrix<f64>, Obstacle> {
    let factor = match Factor::of(p) {
        Err(Obstacle::Indefinite) => return Err(Obstacle::NoInverse(what)),
        other => other?,
    };
    if factor.rank() < p.nrows() {
        return Err(Obstacle::NoInverse(what));
    }
    // P = B Λ Bᵀ, so P⁻¹ = B⁻ᵀ Λ⁻¹ B⁻¹; B is unit triangular up to the order of its rows.
    let inverse = factor.rows.lu().try_inverse().ok_or(Obstacle::NoInverse(what))?;
    let reciprocals = factor.weights.map(f64::recip);
    Ok(Factor { rows: inverse.transpose(), weights: reciprocals }.covariance())
}
