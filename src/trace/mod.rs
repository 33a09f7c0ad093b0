//! Floor 2 · The named quantities of each step: the contract between computing and judging.
//!
//! The filter writes a [`Trace`], the judge compares [`Values`]; neither knows the other. Nothing is computed
//! here.

mod quantity;
mod record;

pub use quantity::{Quantity, Values};
pub use record::{Likelihood, Moments, Record, Trace};
