//! Harnesses on small domains: replayed natively over all inputs, or random ones, and written for Kani.
//!
//! Run natively they are exhaustive tests, not proofs; see `proofs/README.md`.

mod chinese;
mod covariance;
mod determinant;
mod fraction_free;
mod harness;
#[cfg(feature = "judge")]
mod literals;
mod matrices;
mod prime_field;
mod pseudo_inverse;
mod ratio;
mod rational;
mod residue;
mod rounding;
#[cfg(feature = "float")]
mod scalar_riccati;
mod update;
