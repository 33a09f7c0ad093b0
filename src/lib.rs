//! The exact reference for Kalman filtering.

#[cfg(feature = "float")]
pub mod float;
pub mod gaussian;
pub mod matrix;
pub mod model;
pub mod scalar;
pub mod trace;
