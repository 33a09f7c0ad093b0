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

mod bound;
mod bracket;
mod classes;
mod closed_loop;
mod decay;
mod drift;
mod equation;
mod expectation;
mod gain;
mod gain_search;
mod gramian;
mod growth;
mod intermittent;
mod largest_moment;
mod margin;
mod misspecified;
mod mode;
mod moment_bound;
mod moments;
mod observability;
mod observer;
mod process;
mod product;
mod search;
mod subspace;
mod transition_matrix;
mod unobservable;
mod window;

pub use bound::{BoundError, UniformBound, WindowBound};
pub use bracket::Bracket;
pub use closed_loop::{ClosedLoopBound, ClosedLoopError, Factor, riccati_path};
pub use decay::{Decay, DecayVerdict, OutsideUnitInterval};
pub use drift::{Contraction, Drift};
pub use equation::RiccatiStep;
pub use expectation::{CovarianceLaw, CovarianceState, StartError, TooManyStates};
pub use gain::{GainBounds, GainError};
pub use gramian::{Unseen, excites, gramian};
pub use growth::MomentGrowth;
pub use intermittent::CriticalArrival;
pub use largest_moment::LargestMoment;
pub use margin::MarginError;
pub use misspecified::{ErrorCovariances, Misspecified, OtherSystem, error_covariances};
pub use mode::{Mode, ModeError, Part};
pub use moment_bound::MomentBound;
pub use moments::{MomentDoubt, MomentVerdict};
pub use observability::{Observability, SmallestWindow, Start, TooManySubspaces};
pub use observer::{ErrorMap, Observer, ObserverError};
pub use process::{ModeProcess, ProcessError};
pub use transition_matrix::{SingularTransition, inverse_transition_matrix, transition_matrix};
pub use unobservable::{UnobservableLoop, UnobservablePath};
pub use window::Window;
