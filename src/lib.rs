//! The exact reference for Kalman filtering.

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
pub mod scalar;
pub mod trace;
