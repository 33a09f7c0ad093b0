//! The characteristic polynomial without a division.

use super::Matrix;
use crate::scalar::Scalar;

impl<S: Scalar> Matrix<S> {
    /// The coefficients of `det(λI − A)` from the constant term to the leading one, which is one.
    ///
    /// No division is made, so this works over any scalar: integers, residues, enclosures. The polynomial of each
    /// leading block follows from that of the block before (Samuelson 1942, Berkowitz 1984): with
    /// `[[B, c], [r, a]]` it is the product of that of B with the Toeplitz matrix whose first column is
    /// `1, −a, −rc, −rBc, −rB²c, …`.
    ///
    /// Shapes: `self` n×n; n + 1 coefficients.
    ///
    /// # Panics
    ///
    /// If the matrix is not square.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{Rational, ratio}};
    ///
    /// // λ² − 5λ − 2
    /// let a = Matrix::<Rational>::from_integers(&[[1, 2], [3, 4]]);
    /// assert_eq!(a.characteristic_polynomial(), [-2, -5, 1].map(|c| ratio(c, 1)));
    /// ```
    pub fn characteristic_polynomial(&self) -> Vec<S> {
        assert!(self.is_square(), "a {} matrix has no characteristic polynomial", self.shape());
        // From the leading coefficient down, as the Toeplitz matrices want it.
        let mut polynomial = vec![S::one()];
        for order in 0..self.rows() {
            let column = self.toeplitz_column(order);
            let product = |i: usize| {
                let terms = (0..polynomial.len().min(i + 1)).map(|j| column[i - j].times(&polynomial[j]));
                terms.reduce(|sum, term| sum.plus(&term)).unwrap_or_else(S::zero)
            };
            polynomial = (0..order + 2).map(product).collect();
        }
        polynomial.reverse();
        polynomial
    }

    /// `1, −a, −rc, −rBc, …` for the leading block B of the given order, bordered by the next column c, row r and a.
    fn toeplitz_column(&self, order: usize) -> Vec<S> {
        let block = self.block(0..order, 0..order);
        let row = self.block(order..order + 1, 0..order);
        let mut column = self.block(0..order, order..order + 1);
        let mut entries = vec![S::one(), self[(order, order)].negated()];
        for _ in 0..order {
            entries.push((&row * &column)[(0, 0)].negated());
            column = &block * column;
        }
        entries
    }
}
