//! Why a matrix equation has no solution in `f64`.

use super::error::Obstacle;

/// Why a matrix equation was not solved in `f64`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FloatMatrixError {
    /// A matrix that must be inverted has no inverse in `f64`.
    #[error("a matrix is singular in f64")]
    Singular,
    /// A result is infinite or not a number.
    #[error("a result is not finite")]
    NotFinite,
    /// An iteration found no end.
    #[error("the iteration did not converge")]
    Unconverged,
}

impl From<Obstacle> for FloatMatrixError {
    fn from(obstacle: Obstacle) -> Self {
        match obstacle {
            Obstacle::Singular | Obstacle::Indefinite | Obstacle::NoInverse(_) => Self::Singular,
            Obstacle::NotFinite => Self::NotFinite,
            Obstacle::Unconverged => Self::Unconverged,
        }
    }
}
