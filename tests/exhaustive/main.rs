//! Small worlds, exhausted: every matrix of a small size over {−2, …, 2} or a small field.
//!
//! Expectations come from minors (Laplace's expansion), adjugates, enumeration and machine integers, never from the crate's own
//! elimination; a test with a domain counts what it covered.

mod conditioning;
mod definiteness;
mod elimination;
mod filter;
mod gaussian;
mod minors;
mod modes;
mod parallel_sum;
mod pseudo_inverse;
mod riccati;
mod spectral_radius;
mod symmetric_power;
mod worlds;
