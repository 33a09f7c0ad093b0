//! What holds along one path of modes.

mod bracket;
mod closed_loop;
mod gain;
mod gramian;
mod misspecified;
mod observer;
mod transition_matrix;

pub use bracket::Bracket;
pub use closed_loop::{ClosedLoopBound, ClosedLoopError, Factor, riccati_path};
pub use gain::{GainBounds, GainError};
pub use gramian::{Unseen, excites, gramian};
pub use misspecified::{ErrorCovariances, Misspecified, OtherSystem, error_covariances};
pub use observer::{ErrorMap, Observer, ObserverError};
pub use transition_matrix::{SingularTransition, inverse_transition_matrix, transition_matrix};
