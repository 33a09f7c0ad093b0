//! Why a filter stopped.

use std::fmt;

use crate::trace::Values;

/// Why a filter in `f64` stopped, and the complete steps before that.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FloatError {
    /// The innovation covariance has no inverse in `f64`.
    #[error("the innovation covariance is singular at step {step}")]
    Singular {
        /// The step, counted from 0.
        step: usize,
        /// The values of the steps before.
        computed: Vec<Values<f64>>,
    },
    /// A result is infinite or not a number.
    #[error("a result is not finite at step {step}")]
    NotFinite {
        /// The step, counted from 0.
        step: usize,
        /// The values of the steps before.
        computed: Vec<Values<f64>>,
    },
    /// The spectral decomposition did not converge.
    #[error("the spectrum of the innovation covariance was not found at step {step}")]
    Unconverged {
        /// The step, counted from 0.
        step: usize,
        /// The values of the steps before.
        computed: Vec<Values<f64>>,
    },
    /// A covariance of the model is not positive semidefinite, so it has no factors.
    #[error("a covariance is not positive semidefinite at step {step}: this form needs its factors")]
    Indefinite {
        /// The step, counted from 0.
        step: usize,
        /// The values of the steps before.
        computed: Vec<Values<f64>>,
    },
    /// A covariance that this form inverts has no inverse, to the precision of `f64`.
    #[error("the covariance of the {what} has no inverse at step {step}: this form needs it")]
    NoInverse {
        /// Whose covariance it is.
        what: Inverted,
        /// The step, counted from 0.
        step: usize,
        /// The values of the steps before.
        computed: Vec<Values<f64>>,
    },
    /// The form knows no diffuse start.
    #[error("a diffuse initial law is not supported by this form")]
    Diffuse,
}

/// A covariance that the information form inverts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inverted {
    /// P of the initial law: given with the model.
    Start,
    /// P after a transition.
    State,
    /// R: given with the model.
    Noise,
}

impl fmt::Display for Inverted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Start => "initial state",
            Self::State => "state",
            Self::Noise => "observation noise",
        })
    }
}

impl FloatError {
    /// Whether the model is of a kind that the form does not know, rather than a step that failed.
    pub fn is_unsupported(&self) -> bool {
        matches!(
            self,
            Self::Diffuse | Self::Indefinite { .. } | Self::NoInverse { what: Inverted::Start | Inverted::Noise, .. }
        )
    }

    /// The step that could not be done, counted from 0; nothing if the filter could not start.
    pub fn step(&self) -> Option<usize> {
        match self {
            Self::Singular { step, .. }
            | Self::NotFinite { step, .. }
            | Self::Unconverged { step, .. }
            | Self::Indefinite { step, .. }
            | Self::NoInverse { step, .. } => Some(*step),
            Self::Diffuse => None,
        }
    }

    /// The values of the steps before.
    pub fn computed(&self) -> &[Values<f64>] {
        match self {
            Self::Singular { computed, .. }
            | Self::NotFinite { computed, .. }
            | Self::Unconverged { computed, .. }
            | Self::Indefinite { computed, .. }
            | Self::NoInverse { computed, .. } => computed,
            Self::Diffuse => &[],
        }
    }
}

/// Why one step cannot be done; the recursion adds where that was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Obstacle {
    /// S has no inverse.
    Singular,
    /// An entry is infinite or not a number.
    NotFinite,
    /// An iteration found no end.
    Unconverged,
    /// A covariance has no factors.
    Indefinite,
    /// A covariance has no inverse.
    NoInverse(Inverted),
}

impl Obstacle {
    /// The error for this obstacle at the step after those computed.
    pub(super) fn after(self, computed: Vec<Values<f64>>) -> FloatError {
        let step = computed.len();
        match self {
            Self::Singular => FloatError::Singular { step, computed },
            Self::NotFinite => FloatError::NotFinite { step, computed },
            Self::Unconverged => FloatError::Unconverged { step, computed },
            Self::Indefinite => FloatError::Indefinite { step, computed },
            Self::NoInverse(what) => FloatError::NoInverse { what, step, computed },
        }
    }
}
