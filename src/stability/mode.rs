//! What the coefficients are at one time.

use crate::matrix::{LdlError, Matrix, Shape};
use crate::scalar::{Field, OrderedField};

/// F, H, Q and R of one time: `x(k+1) = F x(k) + w(k+1), y(k) = H x(k) + v(k), cov w(k+1) = Q ≥ 0, cov v(k) = R ≥ 0`.
///
/// Shapes: F and Q d×d, H m×d, R m×m.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mode<S> {
    transition: Matrix<S>,
    observation: Matrix<S>,
    process_noise: Matrix<S>,
    observation_noise: Matrix<S>,
}

/// One of the matrices of a mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// F.
    Transition,
    /// H.
    Observation,
    /// Q.
    ProcessNoise,
    /// R.
    ObservationNoise,
}

impl std::fmt::Display for Part {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Transition => "transition",
            Self::Observation => "observation",
            Self::ProcessNoise => "process noise",
            Self::ObservationNoise => "observation noise",
        })
    }
}

/// Why matrices make no mode.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ModeError<S> {
    /// A matrix has the wrong shape.
    #[error("the {part} matrix is {found}, where {expected} is needed")]
    Shape {
        /// Which one.
        part: Part,
        /// Its shape.
        found: Shape,
        /// What the others ask for.
        expected: Shape,
    },
    /// A covariance is none.
    #[error("the {part}: {source}")]
    NotSemidefinite {
        /// Which one.
        part: Part,
        /// Why, with a vector v such that vᵀQv < 0.
        source: LdlError<S>,
    },
}

impl<S: OrderedField> Mode<S> {
    /// The mode of these F, H, Q and R.
    ///
    /// # Errors
    ///
    /// [`ModeError`] with the matrix that does not fit, or with a vector that proves that it is no covariance.
    pub fn new(
        transition: Matrix<S>,
        observation: Matrix<S>,
        process_noise: Matrix<S>,
        observation_noise: Matrix<S>,
    ) -> Result<Self, ModeError<S>> {
        let (d, m) = (transition.rows(), observation.rows());
        let shapes = [
            (Part::Transition, &transition, d, d),
            (Part::Observation, &observation, m, d),
            (Part::ProcessNoise, &process_noise, d, d),
            (Part::ObservationNoise, &observation_noise, m, m),
        ];
        for (part, matrix, rows, columns) in shapes {
            let (found, expected) = (matrix.shape(), Shape { rows, columns });
            if found != expected {
                return Err(ModeError::Shape { part, found, expected });
            }
        }
        for (part, noise) in [(Part::ProcessNoise, &process_noise), (Part::ObservationNoise, &observation_noise)] {
            noise.ldl().map_err(|source| ModeError::NotSemidefinite { part, source })?;
        }
        Ok(Self { transition, observation, process_noise, observation_noise })
    }
}

impl<S: Field> Mode<S> {
    /// The mode of matrices whose shapes and covariances the caller answers for, for identities that need no order.
    pub(crate) fn from_parts(
        transition: Matrix<S>,
        observation: Matrix<S>,
        process_noise: Matrix<S>,
        observation_noise: Matrix<S>,
    ) -> Self {
        Self { transition, observation, process_noise, observation_noise }
    }

    /// d.
    pub fn states(&self) -> usize {
        self.transition.rows()
    }

    /// F.
    pub fn transition(&self) -> &Matrix<S> {
        &self.transition
    }

    /// H.
    pub fn observation(&self) -> &Matrix<S> {
        &self.observation
    }

    /// Q.
    pub fn process_noise(&self) -> &Matrix<S> {
        &self.process_noise
    }

    /// R.
    pub fn observation_noise(&self) -> &Matrix<S> {
        &self.observation_noise
    }
}
