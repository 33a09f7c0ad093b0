//! Floor 4 · Stability of the filter when its coefficients are random: the random Riccati equations of Wang and Guo.
//!
//! * [`Mode`] is what the coefficients are at one time: F, H, Q and R. One step of the equation is [`Mode::step`].
//! * [`ModeProcess`] says how modes follow each other: independent, or a Markov chain, with finitely many modes.
//!   Its law of P(k) is a [`CovarianceLaw`]; whether it is observable is decided by [`ModeProcess::smallest_window`], and
//!   [`ModeProcess::uniform_bound`] bounds P(k) on every path.
//!
//! Holds no simulation.
//!
//! Paper: Wang, Guo 1999. Its index k is ours; where its window of observations is i = k+1, …, k+h, ours is
//! i = k, …, k+h−1 (SPEC.md says why).

mod bound;
mod equation;
mod expectation;
mod margin;
mod mode;
mod observability;
mod process;
mod search;
mod subspace;
mod unobservable;

pub use bound::{BoundError, UniformBound, WindowBound};
pub use equation::RiccatiStep;
pub use expectation::{CovarianceLaw, CovarianceState, StartError, TooManyStates};
pub use margin::MarginError;
pub use mode::{Mode, ModeError, Part};
pub use observability::{Observability, SmallestWindow, Start, TooManySubspaces, Window};
pub use process::{ModeProcess, ProcessError};
pub use unobservable::{UnobservableLoop, UnobservablePath};
