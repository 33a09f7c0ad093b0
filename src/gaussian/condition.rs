//! Conditioning one part of a Gaussian vector on another (CKS Lemma 3).

use super::Gaussian;
use crate::matrix::{Matrix, PseudoInverseError};
use crate::scalar::{Scalar, ZeroTest};

/// Why a vector could not be conditioned.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ConditionError<S> {
    /// The data have probability zero: they lie outside the support of the law.
    #[error("the data have probability zero: {0}")]
    Inconsistent(Inconsistent<S>),
    /// There is no covariance to condition with: a part of it is infinite.
    #[error("a diffuse law has no covariance; its limit is taken by the recursion")]
    Diffuse,
    /// The observed covariance has no (certain) pseudo-inverse.
    #[error(transparent)]
    PseudoInverse(#[from] PseudoInverseError),
}

/// A combination of the innovation that has variance zero and is not zero: proof of inconsistency.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Inconsistent<S> {
    /// A vector v with S v = 0, so that vᵀν has variance zero.
    pub direction: Matrix<S>,
    /// The value vᵀν, which must be zero and over an ordered field is not; modulo a prime v may be orthogonal to ν.
    pub value: S,
}

impl<S: std::fmt::Display> std::fmt::Display for Inconsistent<S> {
    /// The combination and its value, as long as they can be read.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        const READABLE: usize = 120;
        let entries: Vec<String> = self.direction.entries().iter().map(ToString::to_string).collect();
        let (direction, value) = (entries.join(", "), self.value.to_string());
        f.write_str("a combination v of the observed entries has variance 0, but its innovation is not 0")?;
        if direction.len() + value.len() <= READABLE {
            write!(f, ": v = [{direction}], innovation {value}")?;
        }
        f.write_str("; add observation noise, or leave out a sensor that says the same as others")
    }
}

/// What conditioning yields, every named quantity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Conditioned<S> {
    /// The law of X given (Z, Y).
    pub law: Gaussian<S>,
    /// ν = Y − E(Y | Z)
    pub innovation: Matrix<S>,
    /// S = P_yy
    pub innovation_covariance: Matrix<S>,
    /// S⁺
    pub pseudo_inverse: Matrix<S>,
    /// P_xy
    pub cross_covariance: Matrix<S>,
    /// K = P_xy P_yy⁺
    pub gain: Matrix<S>,
}

impl<S: Scalar> Gaussian<S> {
    /// The law of the components that are not observed, given the values of those that are.
    ///
    /// CKS-L3i: `E[X | Z, Y] = E[X | Z] + P_xy P_yy⁺ (Y − E(Y | Z)),  P_xx|zy = P_xx − P_xy P_yy⁺ P_yx`
    ///
    /// P_yy may be singular, or zero. The formula holds almost surely: for values of probability zero it
    /// has no claim, so they are refused.
    ///
    /// Shapes: `observed` lists m components, `values` is m×1; the result has the other n − m components in
    /// their order.
    ///
    /// # Errors
    ///
    /// [`ConditionError::Inconsistent`] if `(I − P_yy P_yy⁺)(Y − E(Y|Z)) ≠ 0`, with the direction;
    /// [`ConditionError::PseudoInverse`] if there is none (a finite field), or it cannot be decided.
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    ///
    /// # Examples
    ///
    /// Two equal readings of one standard variable, without noise:
    ///
    /// ```
    /// use exact_kalman::{gaussian::Gaussian, matrix::Matrix, scalar::{ratio, Rational}};
    ///
    /// let x = Gaussian::<Rational>::standard(1);
    /// let copies = Matrix::from_integers(&[[1], [1], [1]]);
    /// let joint = x.affine(&copies, &Matrix::zeros(3, 1));
    /// let given = joint.conditioned(&[1, 2], &Matrix::column(vec![ratio(7, 3); 2]))?;
    /// assert_eq!(given.law.mean()[(0, 0)], ratio(7, 3));
    /// assert_eq!(given.law.covariance()[(0, 0)], ratio(0, 1));
    /// # Ok::<(), exact_kalman::gaussian::ConditionError<Rational>>(())
    /// ```
    pub fn conditioned(&self, observed: &[usize], values: &Matrix<S>) -> Result<Conditioned<S>, ConditionError<S>> {
        let hidden: Vec<usize> = (0..self.dimension()).filter(|i| !observed.contains(i)).collect();
        let y = self.marginal(observed);
        let cross_covariance = self.covariance.select(&hidden, observed);
        let innovation = values - &y.mean;
        let pseudo_inverse = y.covariance.pseudo_inverse()?;
        if let Some(proof) = Inconsistent::found(&y.covariance, &pseudo_inverse, &innovation) {
            return Err(ConditionError::Inconsistent(proof));
        }
        let x = self.marginal(&hidden);
        let gain = &cross_covariance * &pseudo_inverse;
        let law = Self {
            mean: x.mean + &gain * &innovation,
            covariance: x.covariance - &gain * cross_covariance.transpose(),
        };
        Ok(Conditioned { law, innovation, innovation_covariance: y.covariance, pseudo_inverse, cross_covariance, gain })
    }
}

impl<S: Scalar> Inconsistent<S> {
    /// The proof that an innovation ν does not lie in the range of its covariance S, if that is certain.
    ///
    /// Shapes: `covariance` and `pseudo_inverse` m×m, `innovation` m×1.
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    pub fn found(covariance: &Matrix<S>, pseudo_inverse: &Matrix<S>, innovation: &Matrix<S>) -> Option<Self> {
        let direction = innovation - covariance * (pseudo_inverse * innovation);
        if direction.entries().iter().all(|entry| entry.zero_test() != ZeroTest::Nonzero) {
            return None;
        }
        let value = (direction.transpose() * innovation)[(0, 0)].clone();
        Some(Self { direction, value }.simplified())
    }

    /// The same proof with one as the first entry that is not zero.
    #[must_use]
    pub fn simplified(self) -> Self {
        let first = self.direction.entries().iter().find(|entry| entry.zero_test() == ZeroTest::Nonzero).cloned();
        let scaled = first.and_then(|first| {
            let direction = self.direction.try_map(|entry| entry.over(&first)).ok()?;
            Some(Self { direction, value: self.value.over(&first).ok()? })
        });
        scaled.unwrap_or(self)
    }
}
