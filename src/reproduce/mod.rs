//! Floor 5 · The papers' tables and figures, computed again.
//!
//! Holds the systems that the papers simulate, with named streams of noise, and what comes of them as data and as text.
//! A stream has a name and a seed, and nothing else decides what comes out: the same name and seed give the same
//! table, to the last byte, on every machine. Whether a printed number fits is asked of the *distribution* of the
//! number over many repetitions of the published experiment, never of one repetition. Holds no filter of its own: of
//! the reactor, predictions of more than one step go on from the filter by HV-6 and HV-7. Where an integral of Sowers and
//! Makowski is not enclosed, a simulation stands beside it, labelled as one.
//!
//! Papers: Anderson, Kleindorfer, Kleindorfer, Woodroofe 1969, section 6; Hilgert, Vila 1999, section 3; Sowers, Makowski 1988.

pub mod bioreactor;
mod consistency_table;
mod price;
mod random;

pub use consistency_table::{Cell, ConsistencyTable, Estimate, Row, Setting, Statistic};
pub use price::{NotSimulated, SimulatedPrice, simulated_price};
pub use random::Stream;
