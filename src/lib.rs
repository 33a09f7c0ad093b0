//! The exact reference for Kalman filtering.

pub mod filter;
pub mod gaussian;
pub mod matrix;
pub mod model;
#[cfg(feature = "judge")]
pub mod protocol;
pub mod scalar;
pub mod trace;
