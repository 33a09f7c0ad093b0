//! The exact reference for Kalman filtering: exact values, a judge for any program, an oracle for tests.
//!
//! Every equation is evaluated over the rationals: no rounding, no tolerance. Beside the exact core stand `f64`
//! filters that do not know it, and a judge that counts how many of their digits are right, how many could be, and
//! says where and why they are not.
//!
//! # The house
//!
//! A room imports only from lower floors; rooms of one floor do not know each other. A test keeps it so.
//!
//! | floor | room | holds |
//! |---|---|---|
//! | 0 | [`scalar`] | numbers, and what each can decide |
//! | 1 | [`matrix`] | dense algebra: fraction-free elimination, pseudo-inverse, LDLᵀ, Loewner order |
//! | 1 | [`modular`] | arithmetic modulo many word-sized primes, and the integers that it determines |
//! | 2 | [`gaussian`] | Gaussian laws: affine images, conditioning |
//! | 2 | [`model`] | state space systems, their realisation along data, and what can be wrong with them |
//! | 2 | [`trace`] | the named quantities of each step |
//! | 3 | [`filter`] | the filter by exact routes that agree, the diffuse start, the d-step predictor |
//! | 3 | [`riccati`] | the map of Riccati, its filter and its fixed point |
//! | 3 | `float` | the f64 filters, on nalgebra (feature `float`) |
//! | 3 | `protocol` | cases and answers as JSON, programs under test (feature `judge`) |
//! | 3 | `verify` | the checker of certificates (feature `judge`) |
//! | 4 | [`identify`] | systems from data: estimates of A, V, W, the adaptive filter, least squares |
//! | 4 | [`nongaussian`] | prediction from a start that is not Gaussian |
//! | 4 | [`stability`] | random Riccati equations: observability, moments, rates, with certificates |
//! | 5 | [`prove`] | identities proved by running the library's code on variables, or checked at random points |
//! | 5 | `reproduce` | the papers' tables and figures, simulated again (feature `judge`) |
//! | 5 | `judge` | digits, attainable digits, verdicts, the suite (feature `judge`) |
//! | 6 | [`spec`] | the specification, and its entries as data |
//! | 6 | `report` | judgements as text and JSON (feature `cli`) |
//! | 7 | `cli` | the program `exact-kalman` (feature `cli`) |
//!
//! With `default-features = false` the library is floors 0 to 4 without `float` and `protocol`, and the specification.
//! The equations, with
//! their sources, their errata and the items that implement them, are in [`spec`].
//!
//! # A first example
//!
//! A random walk read twice; every number is a fraction, and equal means equal:
//!
//! ```
//! use exact_kalman::filter::filter;
//! use exact_kalman::matrix::Matrix;
//! use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
//! use exact_kalman::scalar::{ratio, Rational};
//!
//! let one = Matrix::<Rational>::identity(1);
//! let walk = System {
//!     timing: Timing::Departing,
//!     initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), one.clone()),
//!     transition: one.clone().into(),
//!     observation: one.clone().into(),
//!     noise: Noise::Covariances { process: one.clone().into(), cross: None, observation: one.into() },
//!     input: None,
//!     observation_input: None,
//! };
//! let readings = [1, 3].map(|y| Observation::complete([ratio(y, 1)]));
//! let trace = filter(&walk.realised(&readings)?)?;
//! assert_eq!(trace.records[1].filtered.mean[(0, 0)], ratio(2, 1));
//! assert_eq!(trace.records[1].filtered.covariance[(0, 0)], ratio(3, 5));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod certify;
#[cfg(feature = "cli")]
pub mod cli;
pub mod filter;
#[cfg(feature = "float")]
pub mod float;
pub mod gaussian;
pub mod identify;
#[cfg(feature = "judge")]
pub mod judge;
pub mod matrix;
pub mod model;
pub mod modular;
pub mod nongaussian;
#[cfg(feature = "judge")]
pub mod protocol;
pub mod prove;
#[cfg(feature = "cli")]
pub mod report;
#[cfg(feature = "judge")]
pub mod reproduce;
pub mod riccati;
pub mod scalar;
pub mod stability;
pub mod trace;
#[cfg(feature = "judge")]
pub mod verify;

#[doc = include_str!("../SPEC.md")]
pub mod spec;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub mod readme {}
