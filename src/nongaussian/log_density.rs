//! The logarithm of a density as an affine function of white Gaussian noise.

use super::girsanov::product;
use super::posterior::half;
use crate::matrix::Matrix;
use crate::scalar::OrderedField;

/// `constant + Σ cᵀ(s)U(s+1)` with independent U(s+1) ~ N(0, Γ(s+1)): a density given ξ = z, or what is printed as one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LogDensity<S> {
    /// c(s), as many rows as U(s+1).
    pub coefficients: Vec<Matrix<S>>,
    /// Γ(s+1)
    pub covariances: Vec<Matrix<S>>,
    /// What does not depend on the noise.
    pub constant: S,
}

impl<S: OrderedField> LogDensity<S> {
    /// Its value for values of the noise.
    ///
    /// # Panics
    ///
    /// If there are not as many values as coefficients, or one has another dimension.
    pub fn at(&self, noise: &[Matrix<S>]) -> S {
        assert!(noise.len() == self.coefficients.len(), "one value for each step");
        let parts = self.coefficients.iter().zip(noise).map(|(coefficient, value)| product(coefficient, value));
        parts.fold(self.constant.clone(), |sum, part| sum.plus(&part))
    }

    /// Its variance, `Σ cᵀ(s)Γ(s+1)c(s)`.
    pub fn variance(&self) -> S {
        let parts = self.coefficients.iter().zip(&self.covariances);
        parts.fold(S::zero(), |sum, (c, gamma)| sum.plus(&c.transpose().congruence(gamma)[(0, 0)]))
    }

    /// The logarithm of the mean of the density to the power s: `s · constant + ½ s² · variance`, since the exponent is
    /// Gaussian. It is 0 at s = 1 exactly if this is a density.
    pub fn log_moment(&self, power: &S) -> S {
        power.times(&self.constant).plus(&half(&power.times(power).times(&self.variance())))
    }

    /// The logarithm of the inverse.
    ///
    /// SM-3.17: `L⁻¹(t+1) = exp(∑[s=0..t] Zᵀ(s)Hᵀ(s)Σᵛ(s+1)⁻¹V°(s+1) + ½ ∑[s=0..t] Zᵀ(s)Hᵀ(s)Σᵛ(s+1)⁻¹H(s)Z(s))`
    #[must_use]
    pub fn inverse(&self) -> Self {
        Self {
            coefficients: self.coefficients.iter().map(|coefficient| -coefficient).collect(),
            covariances: self.covariances.clone(),
            constant: self.constant.negated(),
        }
    }
}
