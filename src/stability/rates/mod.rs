//! How fast products along random paths decay.

mod decay;
mod drift;
mod product;

pub use decay::{Decay, DecayVerdict, OutsideUnitInterval};
pub use drift::{Contraction, Drift};
