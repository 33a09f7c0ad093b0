//! Floor 2 · Gaussian laws: affine images, joints, marginals, conditioning, expectations of polynomials.
//!
//! A vector X is conditionally Gaussian given Y if `E[exp(iλᵀX) | Y] = exp(iλᵀX̂ − ½λᵀPλ)` for every λ
//! (CKS-2). Given Y, such a law *is* its mean X̂ and its covariance P; both may be anything that is a
//! function of Y. So a [`Gaussian`] here is one realised pair, and the lemmas of the paper are its methods.
//! Holds no time and no model.
//!
//! Papers: Chen, Kumar, van Schuppen 1989, section 2.

mod condition;
mod expectation;
mod polynomial;

pub use condition::{ConditionError, Conditioned, Inconsistent};
pub use polynomial::Polynomial;

use crate::matrix::{LdlError, Matrix, Shape};
use crate::scalar::{Field, OrderedField, Scalar};

/// Mean and covariance of a Gaussian vector; the covariance may be singular.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Gaussian<S> {
    mean: Matrix<S>,
    covariance: Matrix<S>,
}

/// Why a pair is not a mean and a covariance.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GaussianError {
    /// The mean is no column, or the covariance does not fit it.
    #[error("a mean of shape {mean} does not fit a covariance of shape {covariance}")]
    Shape {
        /// The shape of the mean.
        mean: Shape,
        /// The shape of the covariance.
        covariance: Shape,
    },
    /// The covariance is not symmetric.
    #[error("the covariance is not symmetric: entries ({row}, {column}) and ({column}, {row}) differ")]
    Asymmetric {
        /// The row, counted from 0.
        row: usize,
        /// The column, counted from 0.
        column: usize,
    },
}

/// The exact parts of the characteristic function `exp(i·linear − ½·quadratic)`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CharacteristicExponent<S> {
    /// λᵀX̂
    pub linear: S,
    /// λᵀPλ
    pub quadratic: S,
}

impl<S: Field> Gaussian<S> {
    /// The law with the given mean and covariance; symmetry is checked, definiteness is not
    /// (see [`Gaussian::definiteness`]: it needs an order).
    ///
    /// Shapes: `mean` n×1, `covariance` n×n.
    ///
    /// # Errors
    ///
    /// [`GaussianError`] if the shapes do not fit or the covariance is not symmetric.
    pub fn new(mean: Matrix<S>, covariance: Matrix<S>) -> Result<Self, GaussianError> {
        if mean.columns() != 1 || covariance.shape() != (Shape { rows: mean.rows(), columns: mean.rows() }) {
            return Err(GaussianError::Shape { mean: mean.shape(), covariance: covariance.shape() });
        }
        match covariance.asymmetry() {
            Some((row, column)) => Err(GaussianError::Asymmetric { row, column }),
            None => Ok(Self { mean, covariance }),
        }
    }

    /// Whether the parts X and Y, chosen by their indices, are conditionally independent: their cross
    /// covariance vanishes.
    ///
    /// CKS-L2ii: `X ⊥ Y | Z  ⇔  E[(X − E(X|Z))(Y − E(Y|Z))ᵀ | Z] = 0`
    pub fn are_independent(&self, x: &[usize], y: &[usize]) -> bool {
        self.covariance.select(x, y).is_zero()
    }
}

impl<S: Scalar> Gaussian<S> {
    /// The standard law N(0, I) of dimension n, that of the noise w in CKS-A1.
    pub fn standard(n: usize) -> Self {
        Self { mean: Matrix::zeros(n, 1), covariance: Matrix::identity(n) }
    }

    /// The mean, n×1.
    pub fn mean(&self) -> &Matrix<S> {
        &self.mean
    }

    /// The covariance, n×n.
    pub fn covariance(&self) -> &Matrix<S> {
        &self.covariance
    }

    /// Mean and covariance, to keep.
    pub fn into_parts(self) -> (Matrix<S>, Matrix<S>) {
        (self.mean, self.covariance)
    }

    /// The number of components.
    pub fn dimension(&self) -> usize {
        self.mean.rows()
    }

    /// The law of `A X + b`.
    ///
    /// CKS-L2i: `E(AX + b | Z) = A X̂ + b,  cov(AX + b | Z) = A P Aᵀ`
    ///
    /// Shapes: `a` k×n, `b` k×1.
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{gaussian::Gaussian, matrix::Matrix, scalar::Rational};
    ///
    /// let x = Gaussian::<Rational>::standard(2);
    /// let sum = x.affine(&Matrix::from_integers(&[[1, 1]]), &Matrix::from_integers(&[[5]]));
    /// assert_eq!(sum.covariance(), &Matrix::from_integers(&[[2]]));
    /// ```
    pub fn affine(&self, a: &Matrix<S>, b: &Matrix<S>) -> Self {
        Self { mean: a * &self.mean + b, covariance: a.congruence(&self.covariance) }
    }

    /// The joint law of this vector and an independent one.
    pub fn joined(&self, independent: &Self) -> Self {
        Self {
            mean: self.mean.above(&independent.mean),
            covariance: self.covariance.block_diagonal(&independent.covariance),
        }
    }

    /// The law of the chosen components, in the order given.
    pub fn marginal(&self, components: &[usize]) -> Self {
        Self { mean: self.mean.select_rows(components), covariance: self.covariance.select(components, components) }
    }

    /// The exponent of the characteristic function at λ.
    ///
    /// CKS-2: `E[exp(iλᵀX) | Y] = exp(iλᵀX̂ − ½ λᵀPλ)`
    ///
    /// Shapes: `lambda` n×1.
    ///
    /// # Panics
    ///
    /// If the shape does not fit.
    pub fn characteristic_exponent(&self, lambda: &Matrix<S>) -> CharacteristicExponent<S> {
        let row = lambda.transpose();
        CharacteristicExponent {
            linear: (&row * &self.mean)[(0, 0)].clone(),
            quadratic: row.congruence(&self.covariance)[(0, 0)].clone(),
        }
    }
}

impl<S: OrderedField> Gaussian<S> {
    /// Whether the covariance is positive semidefinite.
    ///
    /// # Errors
    ///
    /// A vector v with vᵀPv < 0, in [`LdlError::Indefinite`].
    pub fn definiteness(&self) -> Result<(), LdlError<S>> {
        self.covariance.ldl().map(drop)
    }
}
