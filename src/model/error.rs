//! What can be wrong with a system, with place and witness.

use std::fmt;

use crate::matrix::{Indefinite, Matrix, Shape};
use crate::scalar::Undefined;

/// The field of a system that an error speaks of, by its name in the protocol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[expect(missing_docs, reason = "each is the field of that name")]
pub enum Field {
    InitialMean,
    InitialCovariance,
    InitialDiffuse,
    Transition,
    Observation,
    ProcessFactor,
    ObservationFactor,
    ProcessNoise,
    CrossNoise,
    ObservationNoise,
    JointNoise,
    InputMatrix,
    Input,
    ObservationInputMatrix,
    ObservationInput,
    Observations,
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::InitialMean => "initial mean",
            Self::InitialCovariance => "initial covariance",
            Self::InitialDiffuse => "initial diffuse covariance",
            Self::Transition => "transition",
            Self::Observation => "observation",
            Self::ProcessFactor => "process noise factor",
            Self::ObservationFactor => "observation noise factor",
            Self::ProcessNoise => "process noise",
            Self::CrossNoise => "cross noise",
            Self::ObservationNoise => "observation noise",
            Self::JointNoise => "joint noise covariance [process, cross; crossᵀ, observation]",
            Self::InputMatrix => "input matrix",
            Self::Input => "input",
            Self::ObservationInputMatrix => "observation input matrix",
            Self::ObservationInput => "observation input",
            Self::Observations => "observations",
        })
    }
}

/// A place in a system: a field and, unless it is the initial belief, a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The field.
    pub field: Field,
    /// The step, counted from 0.
    pub step: Option<usize>,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.step {
            Some(step) => write!(f, "{} at step {step}", self.field),
            None => write!(f, "{}", self.field),
        }
    }
}

/// Why a system cannot be realised along given observations.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError<S> {
    /// There is nothing to filter.
    #[error("{0} is empty: a system has at least one state, one sensor and one observation")]
    Empty(Field),
    /// A matrix does not fit the others.
    #[error("{place} is {found}; {expected} is needed (states: {states}, sensors: {sensors})")]
    Shape {
        /// Where.
        place: Place,
        /// The shape that fits.
        expected: Shape,
        /// The shape found.
        found: Shape,
        /// n, read from the initial mean.
        states: usize,
        /// m, read from the first observation.
        sensors: usize,
    },
    /// A list of one matrix per step has another length than the list of observations.
    #[error(
        "{field} lists {found} steps where there are {expected} observations: give one entry per observation{}",
        if *may_go_on { ", or more for what follows" } else { "" }
    )]
    Length {
        /// Which list.
        field: Field,
        /// The number of observations.
        expected: usize,
        /// Whether it may go on beyond them: it is a list of transitions.
        may_go_on: bool,
        /// The length found.
        found: usize,
    },
    /// A list has no matrix where one is needed.
    #[error("{place} is null, and an observation depends on it: give a matrix there")]
    Absent {
        /// Where.
        place: Place,
    },
    /// A covariance is not symmetric, to the last bit.
    #[error(
        "{place} is not symmetric: entries ({row}, {column}) and ({column}, {row}) differ; \
         symmetrise it before you hand it over, so that one model is meant"
    )]
    Asymmetric {
        /// Where.
        place: Place,
        /// The row, counted from 0.
        row: usize,
        /// The column, counted from 0.
        column: usize,
    },
    /// A covariance takes a negative value.
    #[error("{place} is not positive semidefinite: a vector v has vᵀPv < 0")]
    Indefinite {
        /// Where.
        place: Place,
        /// The matrix P.
        matrix: Matrix<S>,
        /// The vector v and the value.
        proof: Indefinite<S>,
    },
    /// An adapted coefficient has no finite value on this path (CKS-A4 or HV-C6 fails).
    #[error("{place} has no finite value on these observations: {source}")]
    Infinite {
        /// Where.
        place: Place,
        /// Why.
        source: Undefined,
    },
    /// The override for an indefinite initial covariance stands beside a diffuse part.
    #[error(
        "the initial covariance is not positive semidefinite and has a diffuse part: the limit that a diffuse start \
         stands for exists for semidefinite covariances only; leave one of the two out"
    )]
    IndefiniteAndDiffuse,
    /// The initial law comes before a transition that has no index.
    #[error(
        "with departing timing transition 0 leads from x_0 to x_1, so the initial law must come before the \
         observation; predict it once, or use arriving timing"
    )]
    NoTransitionBefore,
}
