//! The exact reference for Kalman filtering.

pub mod filter;
pub mod gaussian;
pub mod matrix;
pub mod model;
pub mod scalar;
pub mod trace;
