//! Floor 4 · Stability of the filter when its coefficients are random: the random Riccati equations of Wang and Guo.
//!
//! * [`Mode`] is what the coefficients are at one time: F, H, Q and R. One step of the equation is [`Mode::step`].
//! * [`ModeProcess`] says how modes follow each other: independent, or a Markov chain, with finitely many modes.
//! * [`ModeProcess::moment`] says whether a moment of P(k) stays bounded, [`Mode::critical_arrival`] how often an observation must arrive,
//!   [`ModeProcess::product_bound`], [`ModeProcess::decay`] and [`Drift`] how fast products decay.
//!
//! Holds no simulation.
//!
//! Paper: Wang, Guo 1999. Its index k is ours; where its window of observations is i = k+1, …, k+h, ours is
//! i = k, …, k+h−1 (SPEC.md says why).

mod classes;
mod decay;
mod drift;
mod equation;
mod gain_search;
mod growth;
mod intermittent;
mod largest_moment;
mod mode;
mod moment_bound;
mod moments;
mod process;
mod product;

pub use decay::{Decay, DecayVerdict, OutsideUnitInterval};
pub use drift::{Contraction, Drift};
pub use equation::RiccatiStep;
pub use growth::MomentGrowth;
pub use intermittent::CriticalArrival;
pub use largest_moment::LargestMoment;
pub use mode::{Mode, ModeError, Part};
pub use moment_bound::MomentBound;
pub use moments::{MomentDoubt, MomentVerdict};
pub use process::{ModeProcess, ProcessError};
