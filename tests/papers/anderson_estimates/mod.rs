//! Anderson, Kleindorfer, Kleindorfer, Woodroofe 1969: the estimators, their consistency, and the adaptive filter.
//!
//! Identities of polynomials are checked with `==` at random rationals. Moments come from a [`world::World`], where
//! every variable is written as a combination of uncorrelated sources, or from a law with finitely many outcomes.

mod adaptive_limits;
mod estimates;
mod lagged_products;
mod martingales;
mod numbers;
mod products;
mod residuals;
#[cfg(feature = "judge")]
mod simulated;
mod solution;
mod summed_products;
#[cfg(feature = "judge")]
mod table;
mod world;
