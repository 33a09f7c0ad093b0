//! The change of measure for white Gaussian noise, and what is exact about the one that makes the readings forget ξ.

use super::Statistics;
use super::initial_law::law;
use super::posterior::half;
use crate::gaussian::Gaussian;
use crate::matrix::Matrix;
use crate::scalar::OrderedField;

/// One step of a change of measure: white noise U with the covariance Λ, and the value of χ, which is known before U is.
///
/// # Examples
///
/// ```
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::nongaussian::Shift;
/// use exact_kalman::scalar::{ratio, Rational};
///
/// let number = |n| Matrix::<Rational>::identity(1).scaled(&ratio(n, 1));
/// let shift = Shift::new(number(2), number(3));
/// // χU − ½χ²Λ at U = 5
/// assert_eq!(shift.log_factor(&number(5)), ratio(6, 1));
/// // It is a density, and under it U has the mean Λχ.
/// assert_eq!(shift.log_moment(&ratio(1, 1)), ratio(0, 1));
/// assert_eq!(shift.law_of_noise().mean(), &number(6));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shift<S> {
    covariance: Matrix<S>,
    shift: Matrix<S>,
}

impl<S: OrderedField> Shift<S> {
    /// The step with the covariance Λ, n×n, and χ, n×1.
    ///
    /// # Panics
    ///
    /// If the shapes do not fit, or Λ is not symmetric.
    pub fn new(covariance: Matrix<S>, shift: Matrix<S>) -> Self {
        assert!(covariance.asymmetry().is_none(), "a covariance is symmetric");
        assert!(covariance.rows() == shift.rows() && shift.columns() == 1, "χ has the dimension of the noise");
        Self { covariance, shift }
    }

    /// Λ
    pub fn covariance(&self) -> &Matrix<S> {
        &self.covariance
    }

    /// χ
    pub fn shift(&self) -> &Matrix<S> {
        &self.shift
    }

    /// The noise that is white under the new measure, for a value of the old one.
    ///
    /// SM-2.11: `Ū(t+1) = U(t+1) − Λ(t+1)χ(t),  χ adapted to ℱ`
    ///
    /// # Panics
    ///
    /// If the noise has another dimension; so with all methods that take one.
    pub fn new_noise(&self, noise: &Matrix<S>) -> Matrix<S> {
        noise - &self.covariance * &self.shift
    }

    /// The law of the noise under the new measure, given the past: N(Λχ, Λ). The mean is moved and the covariance stays.
    ///
    /// SM-Girsanov-b: `Ū(t+1), t = 0, …, T, is white Gaussian noise for (ℱ(t), ℙ̄) with Ē[Ū(t+1)Ūᵀ(t+1)] = Λ(t+1)`
    pub fn law_of_noise(&self) -> Gaussian<S> {
        law(&self.covariance * &self.shift, self.covariance.clone())
    }

    /// The exponent `χᵀU − ½ χᵀΛχ` of the factor of SM-2.12, for a value of the noise.
    pub fn log_factor(&self, noise: &Matrix<S>) -> S {
        product(&self.shift, noise).minus(&half(&self.variance()))
    }

    /// The same exponent by a value of the new noise, `χᵀŪ + ½ χᵀΛχ`.
    ///
    /// SM-2.15: `L(t+1) = ∏[s=0..t] exp(χᵀ(s)Ū(s+1) + ½ χᵀ(s)Λ(s+1)χ(s)),  t = 0, 1, …`
    pub fn log_factor_by_new_noise(&self, new_noise: &Matrix<S>) -> S {
        product(&self.shift, new_noise).plus(&half(&self.variance()))
    }

    /// χᵀΛχ, the variance of the exponent given the past.
    pub fn variance(&self) -> S {
        self.shift.transpose().congruence(&self.covariance)[(0, 0)].clone()
    }

    /// The logarithm of the mean of the factor to the power s, given the past: `½(s² − s) χᵀΛχ`.
    pub fn log_moment(&self, power: &S) -> S {
        half(&power.times(power).minus(power).times(&self.variance()))
    }
}

/// The logarithms of L(0), L(1), …: nothing is added at t = 0, one factor at each step after it, for these values of the
/// noise.
///
/// SM-2.12: `L(t+1) = ∏[s=0..t] exp(χᵀ(s)U(s+1) − ½ χᵀ(s)Λ(s+1)χ(s)),  t = 0, 1, …,  L(0) = 1`
///
/// # Panics
///
/// If there are not as many values as steps, or one has another dimension.
pub fn log_likelihood_ratios<S: OrderedField>(shifts: &[Shift<S>], noise: &[Matrix<S>]) -> Vec<S> {
    assert!(shifts.len() == noise.len(), "{} values of noise for {} steps", noise.len(), shifts.len());
    let mut all = vec![S::zero()];
    for (shift, value) in shifts.iter().zip(noise) {
        all.push(all[all.len() - 1].plus(&shift.log_factor(value)));
    }
    all
}

/// aᵀb
pub(super) fn product<S: OrderedField>(a: &Matrix<S>, b: &Matrix<S>) -> S {
    (a.transpose() * b)[(0, 0)].clone()
}

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

    /// The law of B̄ under ℙ̄, where it is independent of ξ: centred, and degenerate where R* is singular, a unit mass where the readings
    /// see nothing of ξ.
    ///
    /// SM-L1: `B̄(t+1) ~ N(0, R*(t+1)) under ℙ̄`
    ///
    /// SM-G: `G_Λ = N(0, Λ),  Λ ∈ 𝒬_n`
    pub fn law_of_linear(&self) -> Gaussian<S> {
        let precision = self.precision();
        law(Matrix::zeros(precision.rows(), 1), precision)
    }
}

impl<S: OrderedField> LikelihoodRatio<'_, S> {
    /// `log E[Lˢ | ξ = z] = ½(s² − s) zᵀMz`: 0 for s = 0 and s = 1 (L is a density), −zᵀMz/8 for s = ½ (Hellinger).
    ///
    /// # Panics
    ///
    /// If z is not n×1.
    pub fn log_moment(&self, s: &S, z: &Matrix<S>) -> S {
        half(&s.times(s).minus(s).times(&self.quadratic(z)))
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
