//! The catalogue of identities: each holds, each twin is disproved, and the machinery can fail.

mod catalogue;
mod degrees;
mod scalar;
