//! The functionals 𝒯 and 𝒰 of Theorem 1.

use super::initial_law::law;
use super::posterior::half;
use super::{Evidence, InitialLaw, Measure, Statistics};
use crate::matrix::{LdlError, Matrix};
use crate::scalar::OrderedField;

/// N(0, Σ), the law of a pair (X_Σ, B_Σ) of vectors of n components each; Σ may be singular.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct JointLaw<S> {
    covariance: Matrix<S>,
    cross: Matrix<S>,
    error: Matrix<S>,
}

/// Why 𝒯 or 𝒰 has no value there.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DomainError<S> {
    /// Shapes that do not fit: x and b are n×1, Λ and Ψ n×n, Σ 2n×2n.
    #[error("the shapes of the arguments do not fit")]
    Shape,
    /// No pair of vectors has Σ as its covariance.
    #[error("Σ: {0}")]
    Covariance(LdlError<S>),
    /// Λ − R is not positive semidefinite, R being the covariance of B_Σ: for some F the value is infinite.
    #[error("Λ − R: {0}")]
    Precision(LdlError<S>),
    /// b is not in the range of Λ − R: for some F the value is infinite.
    #[error("b is not in the range of Λ − R")]
    Range {
        /// A v with (Λ − R)v = 0 and vᵀb ≠ 0.
        witness: Matrix<S>,
    },
}

impl<S: OrderedField> JointLaw<S> {
    /// The law with this covariance, 2n×2n.
    ///
    /// # Errors
    ///
    /// [`DomainError`] if Σ has an odd number of rows, or is not positive semidefinite.
    pub fn new(covariance: &Matrix<S>) -> Result<Self, DomainError<S>> {
        if !covariance.is_square() || covariance.rows() % 2 == 1 {
            return Err(DomainError::Shape);
        }
        covariance.ldl().map_err(DomainError::Covariance)?;
        let (n, all) = (covariance.rows() / 2, covariance.rows());
        Ok(Self {
            covariance: covariance.block(0..n, 0..n),
            cross: covariance.block(0..n, n..all),
            error: covariance.block(n..all, n..all),
        })
    }

    /// 𝒯φ[x, b; Σ] for every φ, as the measure that integrates φ: the mass exp(½ bᵀRb) of N(x + Qb, P), by completing the square.
    ///
    /// SM-1.4: `𝒯φ[x, b; Σ] = E[φ(x + X_Σ) exp(bᵀB_Σ)],  (X_Σ, B_Σ) ~ N(0, Σ)`
    ///
    /// # Panics
    ///
    /// If x or b is not n×1.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::gaussian::Polynomial;
    /// use exact_kalman::matrix::Matrix;
    /// use exact_kalman::nongaussian::{Enclosed, JointLaw};
    /// use exact_kalman::scalar::{Rational, ratio};
    ///
    /// // E[X exp(B)] = E[XB] exp(½) for standard B
    /// let pair = JointLaw::new(&Matrix::<Rational>::from_integers(&[[1, 1], [1, 1]]))?;
    /// let (zero, one) = (Matrix::zeros(1, 1), Matrix::identity(1));
    /// let sum = pair.tilted(&zero, &one).polynomial(&Polynomial::variable(1, 0));
    /// assert_eq!((&sum.terms()[0].weight, &sum.terms()[0].exponent), (&ratio(1, 1), &ratio(1, 2)));
    /// # Ok::<(), exact_kalman::nongaussian::DomainError<Rational>>(())
    /// ```
    pub fn tilted(&self, x: &Matrix<S>, b: &Matrix<S>) -> Measure<S> {
        let quadratic = b.transpose().congruence(&self.error)[(0, 0)].clone();
        let mass = Evidence { weight: S::one(), determinant: S::one(), exponent: half(&quadratic) };
        Measure { parts: vec![(mass, law(x + &self.cross * b, self.covariance.clone()))] }
    }
}

/// The arguments x, b; Λ, Ψ; Σ of 𝒰, for which its value is finite whatever F is (for bounded φ).
///
/// With R the covariance of B_Σ, integration over the pair leaves `∫ exp(bᵀz − ½ zᵀ(Λ − R)z) … dF(z)`. If Λ − R ≥ 0 and b is in its range, the
/// exponential is bounded. If not, it is unbounded along some line, and a law F with a density like (1 + z⁴)⁻¹ there makes the value
/// infinite: n = 1, Λ = 1, R = 2. For the statistics of a system both hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Functional<S>(Statistics<S>);

impl<S: OrderedField> Functional<S> {
    /// At these arguments: x and b are n×1, Λ and Ψ n×n, Σ 2n×2n.
    ///
    /// # Errors
    ///
    /// [`DomainError`] with a witness.
    pub fn new(
        x: &Matrix<S>,
        b: &Matrix<S>,
        lambda: &Matrix<S>,
        psi: &Matrix<S>,
        sigma: &Matrix<S>,
    ) -> Result<Self, DomainError<S>> {
        let JointLaw { covariance, cross, error } = JointLaw::new(sigma)?;
        let (column, square) = (Matrix::<S>::zeros(covariance.rows(), 1).shape(), covariance.shape());
        if x.shape() != column || b.shape() != column || lambda.shape() != square || psi.shape() != square {
            return Err(DomainError::Shape);
        }
        let arguments = Statistics {
            covariance,
            cross,
            error,
            // Neither matters to an integral over ξ.
            innovation_covariance: None,
            state_transition: psi.clone(),
            transition: psi.clone(),
            information: lambda.clone(),
            mean: x.clone(),
            linear: b.clone(),
        };
        let precision = arguments.precision();
        precision.ldl().map_err(DomainError::Precision)?;
        let kernel = precision.kernel();
        let product = kernel.transpose() * b;
        match (0..product.rows()).find(|&row| !product[(row, 0)].is_zero()) {
            Some(row) => Err(DomainError::Range { witness: kernel.select_columns(&[row]) }),
            None => Ok(Self(arguments)),
        }
    }

    /// 𝒰φ[x, b; Λ, Ψ; Σ] for every φ, as the measure that integrates φ, for ξ ~ F.
    ///
    /// SM-1.5: `𝒰φ[x, b; Λ, Ψ; Σ] = ∫ 𝒯φ[x + Ψz, z; Σ] exp(bᵀz − ½ zᵀΛz) dF(z)`
    ///
    /// # Panics
    ///
    /// If F has another dimension.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::matrix::Matrix;
    /// use exact_kalman::nongaussian::{DomainError, Functional};
    /// use exact_kalman::scalar::{Rational, ratio};
    ///
    /// // Λ = 1 and R = 2: infinite for some F.
    /// let (zero, one) = (Matrix::<Rational>::zeros(1, 1), Matrix::identity(1));
    /// let sigma = Matrix::from_integers(&[[0, 0], [0, 2]]);
    /// assert!(matches!(Functional::new(&zero, &zero, &one, &one, &sigma), Err(DomainError::Precision(_))));
    /// ```
    pub fn over(&self, initial: &InitialLaw<S>) -> Measure<S> {
        self.0.posterior(initial).measure()
    }
}

impl<S: OrderedField> Statistics<S> {
    /// 𝒰 at the arguments of SM-2.9: X̄, B̄; M, Ψ; Σ.
    ///
    /// # Errors
    ///
    /// None for what [`super::statistics`] computes: there M − R is R* ≥ 0, and B̄ is in its range.
    pub fn functional(&self) -> Result<Functional<S>, DomainError<S>> {
        Functional::new(&self.mean, &self.linear, &self.information, &self.transition, &self.joint_covariance())
    }
}
