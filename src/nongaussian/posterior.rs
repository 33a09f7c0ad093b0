//! The conditional law of the next state: a mixture again.

use super::initial_law::law;
use super::linear::{regular, tilted};
use super::{InitialLaw, Statistics};
use crate::gaussian::Gaussian;
use crate::matrix::Matrix;
use crate::scalar::{OrderedField, Scalar};

/// How well a component explains the readings: its probability is proportional to
/// `weight · determinant^(−½) · exp(exponent)`, exact in every part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Evidence<S> {
    /// Its probability before the readings.
    pub weight: S,
    /// det(I + Δ R*), at least one.
    pub determinant: S,
    /// `μᵀB̄ − ½ μᵀR*μ + ½ cᵀ(I + ΔR*)⁻¹Δc` with c = B̄ − R*μ.
    pub exponent: S,
}

/// A component given the readings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PosteriorComponent<S> {
    /// What its probability is made of.
    pub evidence: Evidence<S>,
    /// The law of ξ in it.
    pub initial: Gaussian<S>,
    /// The law of the state X°(t) in it.
    pub state: Gaussian<S>,
}

/// The conditional law of the state given the readings (Theorem 1 for a mixture F).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Posterior<S> {
    /// One for each component of F, in the same order.
    pub components: Vec<PosteriorComponent<S>>,
}

impl<S: OrderedField> Statistics<S> {
    /// The conditional law of the state for ξ ~ F, by the quotient of Theorem 1 (SM-T1):
    ///
    /// SM-2.9: `E[φ(X°(t+1)) | 𝒴(t)] = 𝒰φ[X̄(t+1), B̄(t+1); M(t+1), Ψ(t+1,0); Σ(t+1)] / 𝒰1[X̄(t+1), B̄(t+1); M(t+1), Ψ(t+1,0); Σ(t+1)]`
    ///
    /// Its denominator is the sum, over the components, of
    ///
    /// SM-4.29: `∫ exp(zᵀB̄(t+1) − ½ zᵀR*(t+1)z) dG(z) = det(ΔR*(t+1) + I)^(−1/2) · exp(−½ μᵀΔ⁻¹μ + ½ [B̄(t+1) + Δ⁻¹μ]ᵀ[R*(t+1) + Δ⁻¹]⁻¹[B̄(t+1) + Δ⁻¹μ])`
    ///
    /// is evaluated for each component in a form that needs no Δ⁻¹ ([`Evidence::exponent`]).
    ///
    /// # Panics
    ///
    /// If the law has another dimension.
    pub fn posterior(&self, initial: &InitialLaw<S>) -> Posterior<S> {
        let precision = self.precision();
        let components = initial.components().iter().map(|component| {
            let (mean, covariance) = (component.law.mean(), component.law.covariance());
            let (tilted_mean, spread) = tilted(mean, covariance, &self.linear, &precision);
            let evidence = Evidence {
                weight: component.weight.clone(),
                determinant: determinant(&regular(covariance, &precision)),
                exponent: self.exponent(mean, &spread, &precision),
            };
            let initial = law(tilted_mean, spread);
            let state = law(
                &self.mean + self.response() * initial.mean(),
                &self.covariance + self.response().congruence(initial.covariance()),
            );
            PosteriorComponent { evidence, initial, state }
        });
        Posterior { components: components.collect() }
    }

    fn exponent(&self, mean: &Matrix<S>, spread: &Matrix<S>, precision: &Matrix<S>) -> S {
        let form = |left: &Matrix<S>, middle: &Matrix<S>| left.transpose().congruence(middle)[(0, 0)].clone();
        let rest = &self.linear - precision * mean;
        let curvature = form(&rest, spread).minus(&form(mean, precision));
        half(&curvature).plus(&(mean.transpose() * &self.linear)[(0, 0)])
    }
}

pub(super) fn half<S: Scalar>(value: &S) -> S {
    match value.over(&S::from_integer(2)) {
        Ok(half) => half,
        Err(error) => unreachable!("an ordered field has no characteristic, but {error}"),
    }
}

fn determinant<S: OrderedField>(matrix: &Matrix<S>) -> S {
    match matrix.determinant() {
        Ok(determinant) => determinant,
        Err(error) => unreachable!("a field decides, but {error}"),
    }
}
