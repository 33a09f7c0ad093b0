//! Floor 4 · Stability of the filter when its coefficients are random: the random Riccati equations of Wang and Guo.
//!
//! * [`Mode`] is what the coefficients are at one time: F, H, Q and R. One step of the equation is [`Mode::step`].
//! * [`ModeProcess`] says how modes follow each other: independent, or a Markov chain, with finitely many modes.
//!   Its law of P(k) is a [`CovarianceLaw`]; whether it is observable is decided by [`ModeProcess::smallest_window`], and
//!   [`ModeProcess::uniform_bound`] bounds P(k) on every path.
//! * Along one path: [`gramian`], the [`Observer`], products of the closed loop ([`ClosedLoopBound`]), the size of the gain
//!   ([`Mode::gain_bounds`]), a filter with wrong noise ([`error_covariances`]).
//! * [`ModeProcess::moment`] says whether a moment of P(k) stays bounded, [`Mode::critical_arrival`] how often an observation must arrive,
//!   [`ModeProcess::product_bound`], [`ModeProcess::decay`] and [`Drift`] how fast products decay.
//!
//! Holds no simulation.
//!
//! Paper: Wang, Guo 1999. Its index k is ours; where its window of observations is i = k+1, …, k+h, ours is
//! i = k, …, k+h−1 (SPEC.md says why).

mod classes;
mod equation;
mod expectation;
mod mode;
mod moments;
mod observability;
mod path;
mod process;
mod rates;
mod window;

pub use equation::RiccatiStep;
pub use expectation::{CovarianceLaw, CovarianceState, StartError, TooManyStates};
pub use mode::{Mode, ModeError, Part};
pub use moments::{CriticalArrival, LargestMoment, MomentBound, MomentDoubt, MomentGrowth, MomentVerdict};
pub use observability::{
    BoundError, MarginError, Observability, SmallestWindow, Start, TooManySubspaces, UniformBound, UnobservableLoop,
    UnobservablePath, WindowBound,
};
pub use path::{
    Bracket, ClosedLoopBound, ClosedLoopError, ErrorCovariances, ErrorMap, Factor, GainBounds, GainError, Misspecified,
    Observer, ObserverError, OtherSystem, SingularTransition, Unseen, error_covariances, excites, gramian,
    inverse_transition_matrix, riccati_path, transition_matrix,
};
pub use process::{ModeProcess, ProcessError};
pub use rates::{Contraction, Decay, DecayVerdict, Drift, OutsideUnitInterval};
pub use window::Window;
