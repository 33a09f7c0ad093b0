//! From one timing of shared noise to the other, without enlarging the state.

use super::{Before, Initial, Path, Step, Timing, Transition};
use crate::matrix::{Matrix, PseudoInverseError};
use crate::scalar::Scalar;

impl<S: Scalar> Path<S> {
    /// The same observations in departing timing, of the state *before* each transition.
    ///
    /// HV-X.ad: `z(k+1) = A z(k) + B u + D w(k),  y(k) = C A z(k) + C B u + G v + (C D + F)w(k),  z(k+1) = x(k)`
    ///
    /// In covariances: R + C Q Cᵀ + C(DFᵀ) + (DFᵀ)ᵀCᵀ for the observation, Q Cᵀ + DFᵀ between transition and
    /// observation. z_{k+1} given y_0, …, y_k is x_k given the same: what is predicted there is filtered here. Where
    /// the initial law is that of x_0, z_0 is x_0 too, and the transition into z_1 changes nothing.
    ///
    /// A path in departing timing is returned as it is.
    pub fn to_departing(&self) -> Self {
        if self.timing() == Timing::Departing {
            return self.clone();
        }
        let still = || Transition {
            matrix: Matrix::identity(self.states()),
            input: Matrix::zeros(self.states(), 1),
            noise: Matrix::zeros(self.states(), self.states()),
            cross_noise: Matrix::zeros(self.states(), self.sensors()),
        };
        let steps = self.steps().iter().map(|step| {
            let Transition { matrix, input, noise, cross_noise } = step.transition.clone().unwrap_or_else(still);
            let c = &step.observation;
            let mixed = c * &cross_noise;
            Step {
                observation: c * &matrix,
                observation_input: c * &input + &step.observation_input,
                observation_noise: c.congruence(&noise) + &mixed + mixed.transpose() + &step.observation_noise,
                reading: step.reading.clone(),
                transition: Some(Transition {
                    cross_noise: &noise * c.transpose() + cross_noise,
                    matrix,
                    input,
                    noise,
                }),
            }
        });
        let steps = steps.collect();
        let initial = Initial { before: Before::Observation, ..self.initial().clone() };
        self.in_timing(Timing::Departing, initial, steps)
    }

    /// The same states and observations in arriving timing, by feeding each reading back.
    ///
    /// HV-X.da: `x(k+1) = (A − L C)x(k) + B u + L(y(k) − G v) + D(I − F⁺F)w(k),  L = D F⁺ = (D Fᵀ)(F Fᵀ)⁺`
    ///
    /// The rest of the noise, of covariance Q − L(DFᵀ)ᵀ, is uncorrelated with F w(k), so no noise is shared any more;
    /// the input depends on y_k, which CKS-A3 allows. Holds for a singular F too, since F w(k) lies in the range of
    /// F. Of a reading with missing entries the observed rows alone are fed back. A transition that departs from the last
    /// observation is left out: nothing observed depends on it.
    ///
    /// A path in arriving timing is returned as it is.
    ///
    /// # Errors
    ///
    /// [`PseudoInverseError`] if FFᵀ has no (certain) pseudo-inverse; never over the rationals.
    pub fn to_arriving(&self) -> Result<Self, PseudoInverseError> {
        if self.timing() == Timing::Arriving {
            return Ok(self.clone());
        }
        let mut arriving = None;
        let mut steps = Vec::with_capacity(self.steps().len());
        for step in self.steps() {
            let next = step.transition.as_ref().map(|transition| fed_back(step, transition)).transpose()?;
            let transition = std::mem::replace(&mut arriving, next);
            steps.push(Step { transition, ..step.clone() });
        }
        Ok(self.in_timing(Timing::Arriving, self.initial().clone(), steps))
    }
}

/// The transition that departs from an observation, given that observation.
fn fed_back<S: Scalar>(step: &Step<S>, transition: &Transition<S>) -> Result<Transition<S>, PseudoInverseError> {
    let observed = step.reading.present();
    let c = step.observation.select_rows(&observed);
    let cross = transition.cross_noise.select_columns(&observed);
    let feedback = &cross * step.observation_noise.select(&observed, &observed).pseudo_inverse()?;
    let value = step.reading.values() - step.observation_input.select_rows(&observed);
    Ok(Transition {
        matrix: &transition.matrix - &feedback * c,
        input: &transition.input + &feedback * value,
        noise: &transition.noise - feedback * cross.transpose(),
        cross_noise: Matrix::zeros(transition.cross_noise.rows(), transition.cross_noise.columns()),
    })
}
