//! Harnesses on finite fields: replayed natively over their whole domain, and written for Kani.
//!
//! Run natively they are exhaustive tests, not proofs; see `proofs/README.md`.

mod chinese;
mod covariance;
mod determinant;
mod fraction_free;
mod harness;
mod matrices;
mod prime_field;
mod pseudo_inverse;
mod ratio;
mod rational;
mod residue;
mod rounding;
mod update;
