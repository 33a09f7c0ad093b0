//! Stein's equation X − DXDᵀ = Q, by its Kronecker system.

use super::{Matrix, Shape, SolveError};
use crate::scalar::Field;

/// The equation of Stein has no solution or many: some two eigenvalues of D, perhaps the same twice, have product one.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("X - D X D' = Q has no unique solution: there is a nonzero X with X = D X D'")]
pub struct SteinNotUnique<S> {
    /// A matrix X ≠ 0 with X = D X Dᵀ.
    pub homogeneous: Matrix<S>,
}

impl<S: Field> Matrix<S> {
    /// The one X with `X − D X Dᵀ = Q`, where D is `self`.
    ///
    /// If ρ(D) < 1 it is Σ DʲQ(Dʲ)ᵀ, the covariance of the stationary x(k+1) = D x(k) + v(k) with cov v = Q, and it is
    /// positive definite for Q > 0; Stein's theorem says that this happens only then (AK-L4.2). It exists more often:
    /// wherever no two eigenvalues of D have product one.
    ///
    /// The n² linear equations are solved as such: slow for large n, and independent of any series.
    ///
    /// Shapes: `self` n×n, `right` n×n; it need not be symmetric.
    ///
    /// # Errors
    ///
    /// [`SteinNotUnique`] with a matrix X ≠ 0 such that X = D X Dᵀ.
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{Rational, ratio}};
    ///
    /// let half = Matrix::<Rational>::diagonal(&[ratio(1, 2)]);
    /// assert_eq!(half.stein_solution(&Matrix::identity(1))?, Matrix::diagonal(&[ratio(4, 3)]));
    /// # Ok::<(), exact_kalman::matrix::SteinNotUnique<Rational>>(())
    /// ```
    pub fn stein_solution(&self, right: &Self) -> Result<Self, SteinNotUnique<S>> {
        let n = self.rows();
        let square = Shape { rows: n, columns: n };
        assert!(self.shape() == square && right.shape() == square, "{} and {}", self.shape(), right.shape());
        // (D X Dᵀ)ᵢⱼ = Σ dᵢₖ xₖₗ dⱼₗ, with X read row by row.
        let entry = |row: usize, column: usize| {
            let product = self[(row / n, column / n)].times(&self[(row % n, column % n)]);
            if row == column { S::one().minus(&product) } else { product.negated() }
        };
        let system = Self::from_fn(n * n, n * n, entry);
        let folded = |column: &Self| Self::from_fn(n, n, |i, j| column[(i * n + j, 0)].clone());
        match system.solve(&Self::column(right.entries().to_vec())) {
            Ok(solution) => Ok(folded(&solution)),
            Err(SolveError::Singular { .. }) => {
                Err(SteinNotUnique { homogeneous: folded(&system.kernel().select_columns(&[0])) })
            }
            Err(SolveError::Undecided(undecided)) => unreachable!("a field decides zero, but {undecided}"),
        }
    }
}
