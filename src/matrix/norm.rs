//! The Euclidean norm of vectors and matrices: its square, since roots leave the field; and the trace.

use super::Matrix;
use crate::scalar::Scalar;

impl<S: Scalar> Matrix<S> {
    /// The square of the Euclidean norm (of Frobenius, for a matrix): the sum of the squares of all entries.
    ///
    /// AK-N.x: `|x| = (xᵀx)^½`
    ///
    /// AK-N.G: `‖G‖ = [tr(GGᵀ)]^½`
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}};
    ///
    /// assert_eq!(Matrix::<Rational>::from_integers(&[[3], [4]]).squared_norm(), ratio(25, 1));
    /// ```
    pub fn squared_norm(&self) -> S {
        self.entries().iter().fold(S::zero(), |sum, entry| sum.plus(&entry.times(entry)))
    }

    /// The sum of the diagonal entries.
    ///
    /// # Panics
    ///
    /// If the matrix is not square.
    pub fn trace(&self) -> S {
        assert!(self.is_square(), "a {} matrix has no trace", self.shape());
        (0..self.rows()).fold(S::zero(), |sum, i| sum.plus(&self[(i, i)]))
    }
}
