//! Floor 3 · The Kalman filter of Chen, Kumar and van Schuppen, by independent routes.
//!
//! * [`filter`] is the recursion of the Theorem, CKS (3)–(4), as one reads it, over any scalar;
//! * [`one_shot`] conditions the joint Gaussian of (x_0, w_1, …, w_T) once: slow, one formula, no recursion;
//! * [`filter_rational`] is a fast route for the rationals: integer matrices over one denominator.
//!
//! [`predict_ahead`] looks d steps ahead, and [`one_shot_ahead`] is its second route. [`RationalFilter`], [`Records`] and
//! [`Predictions`] give one step at a time, so that long runs can be followed, bounded and broken off.
//!
//! All agree with `==` on the rationals. A diffuse start is resolved by exact series in 1/κ. Holds no
//! floating point: the f64 filters live in a room of their own that does not know this one.
//!
//! Papers: Chen, Kumar, van Schuppen 1989, section 3; Hilgert, Vila 1999 for departing timing.

mod ahead;
mod diffuse;
mod error;
mod one_shot;
mod rational;
mod records;
mod recursion;
mod series;
mod update;

pub use ahead::{Predictions, StepAhead, TraceAhead, predict_ahead};
pub use error::FilterError;
pub use one_shot::{OneShot, one_shot, one_shot_ahead};
pub use rational::{
    Effort, FRACTIONS_PART, RationalFilter, RationalFilterError, RationalStep, Route, StepValues, StopReason, Wanted,
    filter_rational,
};
pub use records::Records;
pub use recursion::filter;
