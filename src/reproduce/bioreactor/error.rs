//! What can go wrong with the reactor.

use crate::filter::FilterError;
use crate::float::{ExtendedError, FloatError};
use crate::matrix::{Indefinite, Matrix};
use crate::model::ModelError;
use crate::scalar::Rational;

/// A state for which the reactor has no next one.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Unphysical {
    /// A concentration below zero, for which there is no growth law.
    #[error("the substrate is {value} mg/l, which is negative")]
    NegativeSubstrate {
        /// The concentration.
        value: f64,
    },
    /// γ + x^β is zero, or the rate is not finite.
    #[error("the growth rate is not finite at a substrate of {substrate} mg/l")]
    NoGrowthRate {
        /// The concentration.
        substrate: f64,
    },
    /// y = −1, where the control law divides by zero.
    #[error("the control law has no value at a reading of -1 mg/l")]
    NoControl,
}

/// Why a run of the reactor, or a predictor on it, stopped. Steps count from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BioreactorError {
    /// The reactor, or its coefficients along given readings, are not defined.
    #[error("transition {step}: {source}")]
    Unphysical {
        /// The transition.
        step: usize,
        /// Why.
        source: Unphysical,
    },
    /// An initial covariance is not positive semidefinite, and the override is not set.
    #[error(
        "the initial covariance of the {predictor} predictor is not positive semidefinite: v = {} has vᵀPv = {}; \
         set `allow_indefinite` to run it all the same",
        proof.witness, proof.value
    )]
    Indefinite {
        /// Whose.
        predictor: &'static str,
        /// The matrix P.
        covariance: Matrix<Rational>,
        /// The vector v and the value.
        proof: Indefinite<Rational>,
    },
    /// An initial covariance is not symmetric.
    #[error("the initial covariance of the {predictor} predictor is not symmetric")]
    Asymmetric {
        /// Whose.
        predictor: &'static str,
    },
    /// A belief has not the number of states that the predictor has.
    #[error("the initial belief of the {predictor} predictor has {found} states where {expected} are needed")]
    States {
        /// Whose.
        predictor: &'static str,
        /// The number needed.
        expected: usize,
        /// The number found.
        found: usize,
    },
    /// The coefficients of so many steps ahead depend on readings that are still to come.
    #[error("{ahead} steps ahead need coefficients that are known {} steps before; they are known {delay}", ahead - 1)]
    Unknown {
        /// How far ahead.
        ahead: usize,
        /// How old the readings are on which the coefficients depend.
        delay: usize,
    },
    /// There is nothing to average, or to predict.
    #[error("at least two steps and one run are needed")]
    Empty,
    /// The system cannot be realised.
    #[error(transparent)]
    Model(#[from] ModelError<Rational>),
    /// The exact predictor stopped.
    #[error(transparent)]
    Exact(#[from] FilterError<Rational>),
    /// The standard predictor stopped, in `f64`.
    #[error(transparent)]
    Standard(#[from] FloatError),
    /// The extended predictor stopped.
    #[error(transparent)]
    Extended(#[from] ExtendedError<Unphysical>),
}
