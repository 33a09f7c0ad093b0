//! Parts of a matrix, and matrices made of parts.

use std::ops::Range;

use super::Matrix;
use crate::scalar::Scalar;

impl<T: Clone> Matrix<T> {
    /// The block of the given rows and columns.
    pub fn block(&self, rows: Range<usize>, columns: Range<usize>) -> Self {
        Self::from_fn(rows.len(), columns.len(), |i, j| self[(rows.start + i, columns.start + j)].clone())
    }

    /// The matrix of the chosen rows and columns, in the order given.
    pub fn select(&self, rows: &[usize], columns: &[usize]) -> Self {
        Self::from_fn(rows.len(), columns.len(), |i, j| self[(rows[i], columns[j])].clone())
    }

    /// The matrix of the chosen rows, in the order given.
    pub fn select_rows(&self, rows: &[usize]) -> Self {
        Self::from_fn(rows.len(), self.columns(), |i, j| self[(rows[i], j)].clone())
    }

    /// The matrix of the chosen columns, in the order given.
    pub fn select_columns(&self, columns: &[usize]) -> Self {
        Self::from_fn(self.rows(), columns.len(), |i, j| self[(i, columns[j])].clone())
    }

    /// `[self right]`
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    pub fn beside(&self, right: &Self) -> Self {
        assert!(self.rows() == right.rows(), "cannot put a {} beside a {} matrix", self.shape(), right.shape());
        Self::from_fn(self.rows(), self.columns() + right.columns(), |i, j| {
            if j < self.columns() { self[(i, j)].clone() } else { right[(i, j - self.columns())].clone() }
        })
    }

    /// `[self; below]`
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    pub fn above(&self, below: &Self) -> Self {
        assert!(self.columns() == below.columns(), "cannot put a {} above a {} matrix", self.shape(), below.shape());
        Self::from_fn(self.rows() + below.rows(), self.columns(), |i, j| {
            if i < self.rows() { self[(i, j)].clone() } else { below[(i - self.rows(), j)].clone() }
        })
    }
}

impl<S: Scalar> Matrix<S> {
    /// `[self 0; 0 other]`
    pub fn block_diagonal(&self, other: &Self) -> Self {
        let upper = self.beside(&Self::zeros(self.rows(), other.columns()));
        upper.above(&Self::zeros(other.rows(), self.columns()).beside(other))
    }
}
