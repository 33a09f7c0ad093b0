//! Floor 4 · Stability of the filter when its coefficients are random: the random Riccati equations of Wang and Guo.
//!
//! * [`Mode`] is what the coefficients are at one time: F, H, Q and R. One step of the equation is [`Mode::step`].
//! * [`ModeProcess`] says how modes follow each other: independent, or a Markov chain, with finitely many modes.
//!
//! Holds no simulation.
//!
//! Paper: Wang, Guo 1999. Its index k is ours; where its window of observations is i = k+1, …, k+h, ours is
//! i = k, …, k+h−1 (SPEC.md says why).

mod equation;
mod mode;
mod process;

pub use equation::RiccatiStep;
pub use mode::{Mode, ModeError, Part};
pub use process::{ModeProcess, ProcessError};
