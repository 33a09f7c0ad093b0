//! One observation, under a covariance without diffuse part: CKS (3)–(4) for one step.

use crate::gaussian::{ConditionError, Inconsistent};
use crate::matrix::Matrix;
use crate::model::{Step, Timing};
use crate::scalar::Scalar;
use crate::trace::{Likelihood, Moments, Record};

/// The rows of the observation equation that were observed.
pub(super) struct Sensors<S> {
    /// Which rows.
    pub(super) observed: Vec<usize>,
    /// C
    pub(super) matrix: Matrix<S>,
    /// G v
    pub(super) input: Matrix<S>,
    /// F Fᵀ
    pub(super) noise: Matrix<S>,
    /// D Fᵀ with the transition of the same index, whichever way that leads.
    pub(super) cross_noise: Matrix<S>,
    /// y
    pub(super) values: Matrix<S>,
}

impl<S: Scalar> Sensors<S> {
    pub(super) fn of(step: &Step<S>) -> Self {
        let observed = step.reading.present();
        let cross_noise = match &step.transition {
            Some(transition) => transition.cross_noise.select_columns(&observed),
            None => Matrix::zeros(step.observation.columns(), observed.len()),
        };
        Self {
            matrix: step.observation.select_rows(&observed),
            input: step.observation_input.select_rows(&observed),
            noise: step.observation_noise.select(&observed, &observed),
            cross_noise,
            values: step.reading.values(),
            observed,
        }
    }

    /// cov(noise of x_k, noise of y_k): that of the transition which led *into* k.
    pub(super) fn shared_with_state(&self, timing: Timing) -> Matrix<S> {
        match timing {
            Timing::Arriving => self.cross_noise.clone(),
            Timing::Departing => Matrix::zeros(self.cross_noise.rows(), self.cross_noise.columns()),
        }
    }

    /// cov(x, y) and cov(y, y) for a state of covariance `p` whose noise has covariance `shared` with that
    /// of y: `P Cᵀ + DFᵀ` and `C P Cᵀ + FFᵀ + C DFᵀ + FDᵀ Cᵀ`. With P = R(t) they are
    ///
    /// CKS-10: `P_xy|z = A P Aᵀ Cᵀ + D(F + C D)ᵀ`
    ///
    /// CKS-11: `P_yy|z = C A P Aᵀ Cᵀ + (F + C D)(F + C D)ᵀ`
    pub(super) fn covariances(&self, p: &Matrix<S>, shared: &Matrix<S>) -> (Matrix<S>, Matrix<S>) {
        let c = &self.matrix;
        let cross = p * c.transpose() + shared;
        let mixed = c * shared;
        (cross, c.congruence(p) + &self.noise + &mixed + mixed.transpose())
    }
}

/// What an update yields: the record, and S⁺ for the prediction that departs from it.
pub(super) struct Updated<S> {
    pub(super) record: Record<S>,
    pub(super) pseudo_inverse: Matrix<S>,
}

/// Conditions the predicted state on the observation.
///
/// CKS-5: `E[x(t+1) | Y(t+1)] = E[x(t+1) | Y(t)] + P_xy|z P_yy|z⁺ [y(t+1) − E(y(t+1) | Y(t))]`
///
/// CKS-12: `P(t+1) = A P Aᵀ + D Dᵀ − P_xy|z P_yy|z⁺ P_yx|z`
///
/// Written out, these are
///
/// CKS-3: `x̂(t+1) = A(t)x̂(t) + B(t)u(t) + K(t)[y(t+1) − C(t)A(t)x̂(t) − C(t)B(t)u(t) − G(t)v(t)]`
///
/// CKS-4: `P(t+1) = R(t) − K(t)[C(t)R(t) + F(t)Dᵀ(t)]`
///
/// CKS-K: `K(t) = [R(t)Cᵀ(t) + D(t)Fᵀ(t)] [C(t)R(t)Cᵀ(t) + F(t)Fᵀ(t) + C(t)D(t)Fᵀ(t) + F(t)Dᵀ(t)Cᵀ(t)]⁺`
pub(super) fn update<S: Scalar>(
    predicted: Moments<S>,
    sensors: &Sensors<S>,
    timing: Timing,
) -> Result<Updated<S>, ConditionError<S>> {
    let shared = sensors.shared_with_state(timing);
    let (cross_covariance, innovation_covariance) = sensors.covariances(&predicted.covariance, &shared);
    let predicted_observation = &sensors.matrix * &predicted.mean + &sensors.input;
    let innovation = &sensors.values - &predicted_observation;
    let pseudo_inverse = innovation_covariance.pseudo_inverse()?;
    if let Some(proof) = Inconsistent::found(&innovation_covariance, &pseudo_inverse, &innovation) {
        return Err(ConditionError::Inconsistent(proof));
    }
    let gain = &cross_covariance * &pseudo_inverse;
    let filtered = Moments {
        mean: &predicted.mean + &gain * &innovation,
        covariance: &predicted.covariance - &gain * cross_covariance.transpose(),
        diffuse: None,
    };
    let likelihood = likelihood(&innovation_covariance, &pseudo_inverse, &innovation)?;
    let record = Record {
        observed: sensors.observed.clone(),
        predicted,
        predicted_observation,
        innovation,
        innovation_covariance,
        innovation_rank: likelihood.rank,
        cross_covariance,
        innovation_diffuse: None,
        gain,
        filtered,
        likelihood: Some(likelihood),
    };
    Ok(Updated { record, pseudo_inverse })
}

/// The parts νᵀS⁺ν, the product of the nonzero eigenvalues of S, and its rank.
pub(super) fn likelihood<S: Scalar>(
    covariance: &Matrix<S>,
    pseudo_inverse: &Matrix<S>,
    innovation: &Matrix<S>,
) -> Result<Likelihood<S>, ConditionError<S>> {
    let undecided = |undecided| ConditionError::PseudoInverse(crate::matrix::PseudoInverseError::Undecided(undecided));
    let factors = covariance.full_rank_factorisation().map_err(undecided)?;
    Ok(Likelihood {
        quadratic: innovation.transpose().congruence(pseudo_inverse)[(0, 0)].clone(),
        pseudo_determinant: covariance.pseudo_determinant().map_err(undecided)?,
        rank: factors.left.columns(),
    })
}
