//! The parallel sum, named after resistors: inverses add.

use super::{Matrix, PseudoInverseError, SolveError};
use crate::scalar::Scalar;

impl<S: Scalar> Matrix<S> {
    /// The parallel sum of two positive semidefinite matrices, singular ones included.
    ///
    /// AK-Par: `F:G = F(F + G)⁺G`
    ///
    /// For F, G ≥ 0 it is positive semidefinite, symmetric in F and G, monotone in each, at most F and at most G, and
    /// its kernel is the sum of theirs (AK-L4.1ii, AK-L4.1iii, AK-L4.1iv). Where both are regular the inverses add
    /// (AK-Par-inverse). It is continuous only where F + G is regular (AK-L4.1i). For other matrices the formula has
    /// no such meaning; definiteness is not checked here, as it needs an order.
    ///
    /// Shapes: both n×n.
    ///
    /// # Errors
    ///
    /// As for [`Matrix::pseudo_inverse`] of the sum; never over the rationals.
    ///
    /// # Panics
    ///
    /// If the matrices are not square, or of different orders.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}};
    ///
    /// let resistors = [2, 3].map(|ohms| Matrix::<Rational>::from_integers(&[[ohms]]));
    /// assert_eq!(resistors[0].parallel_sum(&resistors[1])?[(0, 0)], ratio(6, 5));
    /// # Ok::<(), exact_kalman::matrix::PseudoInverseError>(())
    /// ```
    pub fn parallel_sum(&self, other: &Self) -> Result<Self, PseudoInverseError> {
        assert!(self.is_square(), "a {} matrix has no parallel sum", self.shape());
        let total = self + other;
        match total.solve(other) {
            Ok(share) => Ok(self * share),
            // Only a singular sum needs the pseudo-inverse, which costs several times as much.
            Err(SolveError::Singular { .. }) => Ok(self * total.pseudo_inverse()? * other),
            Err(SolveError::Undecided(undecided)) => Err(undecided.into()),
        }
    }
}
