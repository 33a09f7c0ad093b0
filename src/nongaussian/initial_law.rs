//! F, the law of the initial state.

use crate::gaussian::Gaussian;
use crate::matrix::{LdlError, Matrix};
use crate::scalar::OrderedField;

/// A part of a mixture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Component<S> {
    /// Its probability, positive.
    pub weight: S,
    /// Its law; an atom has the covariance 0.
    pub law: Gaussian<S>,
}

/// A finite mixture of Gaussian laws, degenerate ones included: atoms, a Gaussian, a spike and a slab, …
///
/// SM-A3: `ξ ~ F with E ξ = μ and cov(ξ) = Δ finite, ξ independent of (W°(t+1), V°(t+1)), t = 0, 1, …; nothing else is asked of F`
///
/// # Examples
///
/// ```
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::nongaussian::InitialLaw;
/// use exact_kalman::scalar::{ratio, Rational};
///
/// let coin = InitialLaw::atoms([(ratio(1, 2), Matrix::<Rational>::zeros(1, 1)), (ratio(1, 2), Matrix::identity(1))])?;
/// assert_eq!(coin.mean()[(0, 0)], ratio(1, 2));
/// assert_eq!(coin.covariance()[(0, 0)], ratio(1, 4));
/// # Ok::<(), exact_kalman::nongaussian::InitialLawError<Rational>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InitialLaw<S>(Vec<Component<S>>);

/// Why components make no law.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum InitialLawError<S> {
    /// There is none.
    #[error("a law has at least one component")]
    Empty,
    /// A weight is zero or negative.
    #[error("the weight of component {component} is not positive")]
    Weight {
        /// The component, counted from 0.
        component: usize,
    },
    /// The weights do not add up to one.
    #[error("the weights do not add up to one")]
    Sum {
        /// What they add up to.
        sum: S,
    },
    /// Components of different dimensions, or none.
    #[error("component {component} has dimension {found}, the first one {expected}")]
    Dimension {
        /// The component, counted from 0.
        component: usize,
        /// The dimension of the first.
        expected: usize,
        /// Its dimension.
        found: usize,
    },
    /// A covariance that no vector has.
    #[error("component {component}: {source}")]
    Covariance {
        /// The component, counted from 0.
        component: usize,
        /// Why, with a vector v such that vᵀΔv < 0.
        source: LdlError<S>,
    },
}

impl<S: OrderedField> InitialLaw<S> {
    /// The mixture of these components.
    ///
    /// # Errors
    ///
    /// [`InitialLawError`] with the component, and a witness where a covariance is indefinite.
    pub fn mixture(components: impl IntoIterator<Item = Component<S>>) -> Result<Self, InitialLawError<S>> {
        let components: Vec<Component<S>> = components.into_iter().collect();
        let expected = components.first().ok_or(InitialLawError::Empty)?.law.dimension();
        let mut sum = S::zero();
        for (component, part) in components.iter().enumerate() {
            if part.weight <= S::zero() {
                return Err(InitialLawError::Weight { component });
            }
            let found = part.law.dimension();
            if found != expected {
                return Err(InitialLawError::Dimension { component, expected, found });
            }
            part.law.definiteness().map_err(|source| InitialLawError::Covariance { component, source })?;
            sum = sum.plus(&part.weight);
        }
        if sum == S::one() { Ok(Self(components)) } else { Err(InitialLawError::Sum { sum }) }
    }

    /// Finitely many values with their probabilities; each value is n×1.
    ///
    /// # Errors
    ///
    /// As for [`InitialLaw::mixture`].
    pub fn atoms(values: impl IntoIterator<Item = (S, Matrix<S>)>) -> Result<Self, InitialLawError<S>> {
        Self::mixture(values.into_iter().map(|(weight, value)| {
            let covariance = Matrix::zeros(value.rows(), value.rows());
            Component { weight, law: law(value, covariance) }
        }))
    }

    /// One Gaussian law.
    ///
    /// # Errors
    ///
    /// As for [`InitialLaw::mixture`].
    pub fn gaussian(law: Gaussian<S>) -> Result<Self, InitialLawError<S>> {
        Self::mixture([Component { weight: S::one(), law }])
    }

    /// The components.
    pub fn components(&self) -> &[Component<S>] {
        &self.0
    }

    /// n.
    pub fn dimension(&self) -> usize {
        self.0.first().map_or(0, |component| component.law.dimension())
    }

    /// μ, n×1.
    pub fn mean(&self) -> Matrix<S> {
        let zero = Matrix::zeros(self.dimension(), 1);
        self.0.iter().fold(zero, |sum, part| sum + part.law.mean().scaled(&part.weight))
    }

    /// Δ, n×n: the covariance, not the second moment that the paper names.
    pub fn covariance(&self) -> Matrix<S> {
        let mean = self.mean();
        let zero = Matrix::zeros(self.dimension(), self.dimension());
        self.0.iter().fold(zero, |sum, part| {
            let away = part.law.mean() - &mean;
            sum + (part.law.covariance() + &away * away.transpose()).scaled(&part.weight)
        })
    }
}

/// A law whose covariance is symmetric by construction.
pub(super) fn law<S: OrderedField>(mean: Matrix<S>, covariance: Matrix<S>) -> Gaussian<S> {
    match Gaussian::new(mean, covariance) {
        Ok(law) => law,
        Err(error) => unreachable!("a covariance computed here is symmetric, but {error}"),
    }
}
