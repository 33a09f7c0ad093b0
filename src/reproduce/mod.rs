//! Floor 5 · The papers' tables and figures, computed again.
//!
//! Holds the systems that the papers simulate, with named streams of noise, and what comes of them as data and as text.
//! Holds no filter of its own.

pub mod bioreactor;
