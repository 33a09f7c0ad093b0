//! Why a filter stopped.

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
    /// The form knows no diffuse start.
    #[error("a diffuse initial law is not supported by this form")]
    Diffuse,
}

impl FloatError {
    /// The step that could not be done, counted from 0; nothing if the filter could not start.
    pub fn step(&self) -> Option<usize> {
        match self {
            Self::Singular { step, .. } | Self::NotFinite { step, .. } | Self::Unconverged { step, .. } => Some(*step),
            Self::Diffuse => None,
        }
    }

    /// The values of the steps before.
    pub fn computed(&self) -> &[Values<f64>] {
        match self {
            Self::Singular { computed, .. } | Self::NotFinite { computed, .. } | Self::Unconverged { computed, .. } => {
                computed
            }
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
}

impl Obstacle {
    /// The error for this obstacle at the step after those computed.
    pub(super) fn after(self, computed: Vec<Values<f64>>) -> FloatError {
        let step = computed.len();
        match self {
            Self::Singular => FloatError::Singular { step, computed },
            Self::NotFinite => FloatError::NotFinite { step, computed },
            Self::Unconverged => FloatError::Unconverged { step, computed },
        }
    }
}
