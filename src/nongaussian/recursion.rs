//! One step of the recursions (2.1) to (2.7), with (1.7) and (3.20).

use super::Statistics;
use super::statistics::{NoInverse, inverse};
use crate::matrix::Matrix;
use crate::model::{Step, Transition};
use crate::scalar::Field;

/// The statistics so far.
pub(super) struct Recursion<S>(Statistics<S>);

impl<S: Field> Recursion<S> {
    /// At t = 0: everything is zero but Ψ(0, 0) = I.
    pub(super) fn new(n: usize) -> Self {
        let zero = Matrix::zeros(n, n);
        Self(Statistics {
            covariance: zero.clone(),
            cross: zero.clone(),
            error: zero.clone(),
            innovation_covariance: None,
            state_transition: Matrix::identity(n),
            transition: Matrix::identity(n),
            information: zero,
            mean: Matrix::zeros(n, 1),
            linear: Matrix::zeros(n, 1),
        })
    }

    pub(super) fn now(&self) -> &Statistics<S> {
        &self.0
    }

    /// From t to t + 1. An error is that of Σᵛ, or of J.
    ///
    /// SM-1.6: `Φ(t,t) = I,  Φ(s+1,t) = A(s)Φ(s,t),  s ≥ t`
    ///
    /// SM-1.7: `Ψ(t,t) = I,  Ψ(s+1,t) = [A(s) − Σʷᵛ(s+1)Σᵛ(s+1)⁻¹H(s)]Ψ(s,t),  s ≥ t`
    ///
    /// SM-2.6: `X̄(t+1) = {A(t) − [A(t)P(t)Hᵀ(t) + Σʷᵛ(t+1)]J⁻¹(t)H(t)}X̄(t) + [A(t)P(t)Hᵀ(t) + Σʷᵛ(t+1)]J⁻¹(t)Y(t),  X̄(0) = 0`
    ///
    /// SM-2.7: `B̄(t+1) = B̄(t) − (Q(t) + Ψ(t,0))ᵀHᵀ(t)J⁻¹(t)H(t)X̄(t) + (Q(t) + Ψ(t,0))ᵀHᵀ(t)J⁻¹(t)Y(t),  B̄(0) = 0`
    ///
    /// SM-3.20: `M(t+1) = ∑[s=0..t] Ψᵀ(s,0)Hᵀ(s)Σᵛ(s+1)⁻¹H(s)Ψ(s,0),  M(0) = 0`
    ///
    /// SM-2.2: `J(t) = H(t)P(t)Hᵀ(t) + Σᵛ(t+1)`
    pub(super) fn advance(&mut self, step: &Step<S>, transition: &Transition<S>) -> Result<(), NoInverse<S>> {
        let observed = step.reading.present();
        let (a, w, h) = (&transition.matrix, &transition.noise, &step.observation.select_rows(&observed));
        let wv = &transition.cross_noise.select_columns(&observed);
        let v = step.observation_noise.select(&observed, &observed);
        let v_inverse = inverse(&v)?;
        let Statistics { covariance: p, cross: q, error: r, transition: psi, information: m, mean, linear, .. } =
            &self.0;
        let j = h.congruence(p) + &v;
        // J ≥ Σᵛ > 0
        let j_inverse = inverse(&j)?;
        let cross = a * p * h.transpose() + wv;
        let gain = &cross * &j_inverse;
        let response = h * (q + psi);
        let initial = h * psi;
        let innovation = step.reading.values() - step.observation_input.select_rows(&observed) - h * mean;
        let seen = response.transpose() * &j_inverse;
        let reading_information = initial.transpose().congruence(&v_inverse);
        let regression = wv * &v_inverse;
        self.0 = Statistics {
            covariance: a.congruence(p) - &gain * cross.transpose() + w,
            cross: a * q - &gain * &response + &regression * &initial,
            error: r - &seen * &response + &reading_information,
            transition: (a - &regression * h) * psi,
            information: m + &reading_information,
            mean: a * mean + &gain * &innovation + &transition.input,
            linear: linear + seen * innovation,
            innovation_covariance: Some(j),
            state_transition: a * &self.0.state_transition,
        };
        Ok(())
    }
}
