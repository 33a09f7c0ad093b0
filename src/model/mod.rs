//! Floor 2 · State space systems driven by white Gaussian noise, and their realisation along data.
//!
//! A [`System`] is a description: every matrix and input of CKS (1) constant, one per step, or a function of
//! the past observations. [`System::realised`] evaluates it along given observations, checks everything once
//! (shapes, symmetry, definiteness, each with a witness) and returns a [`Path`]: what filters work on.
//! [`System::steps`] does so one step at a time. [`System::realised_ahead`] does so for predictors, which need more and may know less. Holds no filter.
//!
//! **Index rule.** k counts observations, from 0; the observation matrix, its noise and its input with index k
//! belong to y_k. What a transition with index k does is said by [`Timing`].
//!
//! Papers: Chen, Kumar, van Schuppen 1989, section 1; Hilgert, Vila 1999 for the other timing.

mod ahead;
mod coefficient;
mod error;
mod estimation;
mod initial;
mod observation;
mod path;
mod realise;
mod steps;
mod system;
mod timing;
mod unified;

pub use ahead::PathAhead;
pub use coefficient::{Coefficient, Past};
pub use error::{Field, ModelError, Place};
pub use estimation::{Reading, Repair};
pub use initial::{Before, Initial};
pub use observation::Observation;
pub use path::{Path, Step, Transition};
pub use steps::Steps;
pub use system::{Input, Noise, System, Timing};
pub use unified::UnifiedStep;
