//! The change of measure that makes the readings forget ξ.

use super::Statistics;
use crate::matrix::Matrix;
use crate::scalar::OrderedField;

/// What is exact about the likelihood ratio L(t) = dℙ̄/dℙ given ξ = z.
///
/// SM-3.15: `L(t+1) = exp(−∑[s=0..t] Zᵀ(s)Hᵀ(s)Σᵛ(s+1)⁻¹V°(s+1) − ½ ∑[s=0..t] Zᵀ(s)Hᵀ(s)Σᵛ(s+1)⁻¹H(s)Z(s)),  L(0) = 1`
///
/// Given ξ = z the first sum has mean 0 and variance zᵀMz, so that L is log-normal.
#[derive(Clone, Copy, Debug)]
pub struct LikelihoodRatio<'a, S> {
    pub(super) information: &'a Matrix<S>,
}

impl<S: OrderedField> Statistics<S> {
    /// The likelihood ratio at this t.
    pub fn likelihood_ratio(&self) -> LikelihoodRatio<'_, S> {
        LikelihoodRatio { information: &self.information }
    }
}

impl<S: OrderedField> LikelihoodRatio<'_, S> {
    /// `log E[Lˢ | ξ = z] = ½(s² − s) zᵀMz`: 0 for s = 0 and s = 1 (L is a density), −zᵀMz/8 for s = ½ (Hellinger).
    ///
    /// # Panics
    ///
    /// If z is not n×1.
    pub fn log_moment(&self, s: &S, z: &Matrix<S>) -> S {
        let curvature = s.times(s).minus(s);
        match curvature.times(&self.quadratic(z)).over(&S::from_integer(2)) {
            Ok(half) => half,
            Err(error) => unreachable!("an ordered field has no characteristic, but {error}"),
        }
    }

    /// zᵀMz, the variance of log L given ξ = z.
    ///
    /// # Panics
    ///
    /// If z is not n×1.
    pub fn quadratic(&self, z: &Matrix<S>) -> S {
        z.transpose().congruence(self.information)[(0, 0)].clone()
    }
}
