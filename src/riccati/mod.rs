//! Floor 3 · The map of Riccati, its iterates and its fixed point.
//!
//! What Anderson, Kleindorfer, Kleindorfer and Woodroofe study: every state is observed with noise,
//! `x(k+1) = A x(k) + v(k)`, `y(k) = x(k) + w(k)`. Then the covariance before an observation goes from step to step by
//! `φ(S) = A(S:W)Aᵀ + V` ([`RiccatiMap`]), the filter is [`RiccatiMap::step`], and with V > 0 there is one fixed point
//! S∞, to which all starts converge: [`RiccatiMap::fixed_point`] encloses it between two matrices of fractions.
//!
//! Matrices that change from step to step have one map per step. The same model as a
//! [`System`](crate::model::System) is [`RiccatiMap::system`]: the filters of the house run on it, and agree.
//!
//! Papers: Anderson, Kleindorfer, Kleindorfer, Woodroofe 1969, sections 1, 2 and 4.

mod error;
mod fixed_point;
mod map;
mod rounding;
mod step;
mod system;

pub use error::{FixedPointError, RiccatiError, Role};
pub use fixed_point::{FixedPointEnclosure, GainEnclosure};
pub use map::RiccatiMap;
pub use step::CovarianceStep;
