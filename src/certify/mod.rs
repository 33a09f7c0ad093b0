//! Floor 4 · Enclosures: proved digits at a cost that grows with the number of steps, and not with its square.
//!
//! Exact fractions lengthen with every step. Here a step keeps a covariance P̃ and a mean x̃ of a fixed number of bits, and
//! bounds in the order of Loewner for how far the exact ones may be from them. All arithmetic is on integers; no floating
//! point is trusted, and no inverse of P is taken, so P may be singular.

mod absence;
mod accuracy;
mod ahead;
#[cfg(feature = "judge")]
mod certificate;
mod derived;
#[cfg(feature = "judge")]
mod digits;
mod dyadics;
mod enclosed;
mod filter;
mod gain;
mod grid;
mod groups;
mod growth;
mod innovation;
mod law;
mod likelihood;
mod packed;
#[cfg(feature = "judge")]
mod raised;
mod readings;
mod standing;
mod steady;
mod target;
mod tiers;
mod upper;
mod whitening;
mod words;

pub use absence::{Absence, Existence, Unknown};
pub use derived::Derived;
#[cfg(feature = "judge")]
pub use digits::Digits;
pub use filter::{CertifiedFilter, CertifiedStep};
pub use growth::Growth;
pub use likelihood::EnclosedLikelihood;
#[cfg(feature = "judge")]
pub use raised::{Halt, RaisedFilter};
pub use steady::{SteadyEffort, SteadyState, Unproved};
pub use tiers::{TieredFilter, TieredStep, Tiers};

use crate::gaussian::Inconsistent;
use crate::scalar::Rational;

/// The covariance of an innovation is singular, or too near to it for the bits that were given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the covariance of the innovation may be singular: not decided with so many bits")]
pub struct Undecided;

/// Why a step has no enclosure.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotEnclosed {
    /// More bits may help, or exact numbers.
    #[error(transparent)]
    Undecided(#[from] Undecided),
    /// Sensors that repeat others say something else: that has probability zero, whatever the state is.
    #[error("the data have probability zero: {0}")]
    Contradiction(Inconsistent<Rational>),
}
