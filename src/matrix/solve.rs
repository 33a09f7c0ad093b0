//! Linear systems and the inverse.

use super::{Echelon, Matrix, Undecided};
use crate::scalar::Scalar;

/// Why a square system has no unique solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SolveError {
    /// The matrix is singular.
    #[error("the matrix is singular: rank {rank} of {order}")]
    Singular {
        /// Its rank.
        rank: usize,
        /// Its order.
        order: usize,
    },
    /// Whether it is singular cannot be decided.
    #[error(transparent)]
    Undecided(#[from] Undecided),
}

impl<S: Scalar> Matrix<S> {
    /// The unique X with `self · X = right`.
    ///
    /// Shapes: `self` n×n, `right` n×k, X n×k.
    ///
    /// # Errors
    ///
    /// [`SolveError::Singular`] if the matrix is singular, [`SolveError::Undecided`] if that cannot be told.
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    pub fn solve(&self, right: &Self) -> Result<Self, SolveError> {
        assert!(self.is_square(), "a system with a {} matrix is not square", self.shape());
        let order = self.columns();
        let echelon = Echelon::of(&self.beside(right), order)?;
        if echelon.rank() < order {
            return Err(SolveError::Singular { rank: echelon.rank(), order });
        }
        Ok(echelon.reduced()?.block(0..order, order..order + right.columns()))
    }

    /// The inverse.
    ///
    /// # Errors
    ///
    /// As for [`Matrix::solve`].
    ///
    /// # Panics
    ///
    /// If the matrix is not square.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::Rational};
    ///
    /// let a = Matrix::<Rational>::from_integers(&[[2, 1], [1, 1]]);
    /// assert_eq!(a.inverse()?, Matrix::from_integers(&[[1, -1], [-1, 2]]));
    /// # Ok::<(), exact_kalman::matrix::SolveError>(())
    /// ```
    pub fn inverse(&self) -> Result<Self, SolveError> {
        self.solve(&Self::identity(self.rows()))
    }
}
