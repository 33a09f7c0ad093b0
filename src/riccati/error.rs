//! What can be wrong with a map, and why a fixed point is not handed out.

use std::fmt;

use super::FixedPointEnclosure;
use crate::matrix::{LdlError, Matrix, Shape};
use crate::scalar::Rational;

/// Which matrix is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A
    Transition,
    /// V
    StateNoise,
    /// W
    ObservationNoise,
    /// M
    Sensors,
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Transition => "the transition A",
            Self::StateNoise => "the covariance V of the state noise",
            Self::ObservationNoise => "the covariance W of the observation noise",
            Self::Sensors => "the sensor matrix M",
        })
    }
}

/// Why three matrices make no map.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RiccatiError<S> {
    /// A matrix is not square, or not of the order of A.
    #[error("{role} is {found}, not {expected}")]
    Shape {
        /// Which one.
        role: Role,
        /// Its shape.
        found: Shape,
        /// What it must be.
        expected: Shape,
    },
    /// A covariance is not symmetric, or takes a negative value at the vector handed out.
    #[error("{role} is no covariance: {source}")]
    NotSemidefinite {
        /// Which one.
        role: Role,
        /// The place, or the vector v with vᵀPv < 0.
        source: LdlError<S>,
    },
    /// M has no inverse: the model is not that of Anderson and others.
    #[error("{} is singular: M v = 0 for v = {direction}", Role::Sensors)]
    SensorsSingular {
        /// A vector v ≠ 0 with M v = 0.
        direction: Matrix<S>,
    },
}

/// Why there is no enclosure of the fixed point as narrow as was asked for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FixedPointError {
    /// V is singular, and the theorem needs V > 0: with W = 1 and V = 0 no positive S is fixed for A = 1/2, and for A = 2
    /// both 0 and 3 are.
    #[error(
        "V is singular, so there may be no fixed point or several (A = 2, V = 0, W = 1 has 0 and 3): V v = 0 for \
         v = {direction}"
    )]
    StateNoiseSingular {
        /// A vector v ≠ 0 with V v = 0.
        direction: Matrix<Rational>,
    },
    /// The steps allowed did not suffice.
    #[error("the enclosure is wider than asked for after {} steps", .reached.steps)]
    TooFewSteps {
        /// The enclosure reached, which holds.
        reached: FixedPointEnclosure,
    },
}
