//! Conditioning one part of a Gaussian vector on another (CKS Lemma 3).

use super::Gaussian;
use crate::matrix::{Matrix, PseudoInverseError};
use crate::scalar::{Scalar, ZeroTest};

/// Why a vector could not be conditioned.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ConditionError<S> {
    /// The data have probability zero: they lie outside the support of the law.
    #[error("the data contradict each other: a combination that must be zero is not")]
    Inconsistent(Inconsistent<S>),
    /// The observed covariance has no (certain) pseudo-inverse.
    #[error(transparent)]
    PseudoInverse(#[from] PseudoInverseError),
}

/// A combination of the innovation that has variance zero and is not zero: proof of inconsistency.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Inconsistent<S> {
    /// A vector v with S v = 0, so that vᵀν has variance zero.
    pub direction: Matrix<S>,
    /// The value vᵀν, which must be zero and is not.
    pub value: S,
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
        Some(Self { direction, value })
    }
}
