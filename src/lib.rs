//! The exact reference for Kalman filtering.

#[cfg(feature = "cli")]
pub mod cli;
pub mod filter;
#[cfg(feature = "float")]
pub mod float;
pub mod gaussian;
#[cfg(feature = "judge")]
pub mod judge;
pub mod matrix;
pub mod model;
#[cfg(feature = "judge")]
pub mod protocol;
#[cfg(feature = "cli")]
pub mod report;
pub mod scalar;
pub mod trace;
