//! Floor 1 · Dense algebra over any scalar.
//!
//! Holds the matrix, its products, fraction-free elimination and what follows from it (solve, inverse,
//! determinant, rank, kernel, full-rank factorisation, pseudo-inverse, parallel sum), LDLᵀ with witnesses and the
//! Loewner order, the characteristic polynomial with what it decides, symmetric powers, and Stein's equation. Holds no probability and
//! no model.
//!
//! What may be asked depends on the scalar: products and elimination need a
//! [`Scalar`] and may answer *undecided*, rank and kernel need a
//! [`Field`](crate::scalar::Field), definiteness an [`OrderedField`](crate::scalar::OrderedField).
//!
//! Shapes are checked once, where data enter (the model, the protocol). The operators here assert them
//! and panic with both shapes: a disagreement inside the library is an error of the program.

mod arithmetic;
mod blocks;
mod characteristic_polynomial;
mod definiteness;
mod elimination;
mod fractions;
mod lowest_terms;
mod norm;
mod parallel_sum;
mod pseudo_inverse;
mod solve;
mod spectral_radius;
mod stein;
mod symmetric_power;

use std::fmt;
use std::ops::{Index, IndexMut};

pub use definiteness::{Indefinite, Ldl, LdlError};
pub use elimination::{Echelon, Undecided};
pub use fractions::Fractions;
pub(crate) use fractions::least_common_multiple;
pub use pseudo_inverse::{FullRank, PseudoInverseError};
pub use solve::SolveError;
pub use stein::SteinNotUnique;

use crate::scalar::Scalar;

/// Rows and columns, in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Shape {
    /// The number of rows.
    pub rows: usize,
    /// The number of columns.
    pub columns: usize,
}

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}×{}", self.rows, self.columns)
    }
}

/// Rows of unequal length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("row {row} has {found} entries where row 0 has {expected}")]
pub struct RaggedRows {
    /// The first row that differs, counted from 0.
    pub row: usize,
    /// The length of row 0.
    pub expected: usize,
    /// The length of that row.
    pub found: usize,
}

/// A dense matrix; a vector is a matrix of one column.
///
/// # Examples
///
/// ```
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::scalar::ratio;
///
/// let a = Matrix::from_rows(vec![vec![ratio(1, 1), ratio(1, 2)], vec![ratio(0, 1), ratio(1, 3)]])?;
/// assert_eq!((&a * a.transpose())[(0, 1)], ratio(1, 6));
/// # Ok::<(), exact_kalman::matrix::RaggedRows>(())
/// ```
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Matrix<T> {
    shape: Shape,
    /// Row by row.
    entries: Vec<T>,
}

impl<T> Matrix<T> {
    /// The matrix whose entry in row i, column j is `entry(i, j)`.
    pub fn from_fn(rows: usize, columns: usize, mut entry: impl FnMut(usize, usize) -> T) -> Self {
        let entries = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j))).map(|(i, j)| entry(i, j)).collect();
        Self { shape: Shape { rows, columns }, entries }
    }

    /// The matrix with the given rows; no rows give the 0×0 matrix.
    ///
    /// # Errors
    ///
    /// [`RaggedRows`] if the rows differ in length.
    pub fn from_rows(rows: Vec<Vec<T>>) -> Result<Self, RaggedRows> {
        let columns = rows.first().map_or(0, Vec::len);
        if let Some((row, found)) = rows.iter().map(Vec::len).enumerate().find(|(_, length)| *length != columns) {
            return Err(RaggedRows { row, expected: columns, found });
        }
        Ok(Self { shape: Shape { rows: rows.len(), columns }, entries: rows.into_iter().flatten().collect() })
    }

    /// The matrix of one column.
    pub fn column(entries: Vec<T>) -> Self {
        Self { shape: Shape { rows: entries.len(), columns: 1 }, entries }
    }

    /// Rows and columns.
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.shape.rows
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.shape.columns
    }

    /// Whether there are as many rows as columns.
    pub fn is_square(&self) -> bool {
        self.rows() == self.columns()
    }

    /// All entries, row by row.
    pub fn entries(&self) -> &[T] {
        &self.entries
    }

    /// The entries of one row.
    pub fn row(&self, row: usize) -> &[T] {
        &self.entries[row * self.columns()..(row + 1) * self.columns()]
    }

    /// The matrix of the images of the entries.
    pub fn map<U>(&self, image: impl FnMut(&T) -> U) -> Matrix<U> {
        Matrix { shape: self.shape, entries: self.entries.iter().map(image).collect() }
    }

    /// The matrix of the images of the entries, or the first failure.
    ///
    /// # Errors
    ///
    /// What `image` returns.
    pub fn try_map<U, E>(&self, image: impl FnMut(&T) -> Result<U, E>) -> Result<Matrix<U>, E> {
        Ok(Matrix { shape: self.shape, entries: self.entries.iter().map(image).collect::<Result<_, _>>()? })
    }
}

impl<T: Clone> Matrix<T> {
    /// The transpose.
    pub fn transpose(&self) -> Self {
        Self::from_fn(self.columns(), self.rows(), |i, j| self[(j, i)].clone())
    }
}

impl<T: PartialEq> Matrix<T> {
    /// The first place (i, j), i < j, whose entry differs from that of (j, i); nothing if the matrix is
    /// symmetric. A matrix that is not square counts as asymmetric at (0, 0).
    pub fn asymmetry(&self) -> Option<(usize, usize)> {
        if !self.is_square() {
            return Some((0, 0));
        }
        let places = (0..self.rows()).flat_map(|i| (i + 1..self.rows()).map(move |j| (i, j)));
        places.into_iter().find(|&(i, j)| self[(i, j)] != self[(j, i)])
    }
}

impl<S: Scalar> Matrix<S> {
    /// The matrix of zeros.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self::from_fn(rows, columns, |_, _| S::zero())
    }

    /// The identity matrix of order n.
    pub fn identity(n: usize) -> Self {
        Self::from_fn(n, n, |i, j| if i == j { S::one() } else { S::zero() })
    }

    /// The square matrix with the given diagonal and zeros elsewhere.
    pub fn diagonal(entries: &[S]) -> Self {
        Self::from_fn(entries.len(), entries.len(), |i, j| if i == j { entries[i].clone() } else { S::zero() })
    }

    /// The matrix of small integers.
    ///
    pub fn from_integers<const C: usize>(rows: &[[i64; C]]) -> Self {
        Self::from_fn(rows.len(), C, |i, j| S::from_integer(rows[i][j]))
    }
}

impl<T> Index<(usize, usize)> for Matrix<T> {
    type Output = T;

    fn index(&self, (row, column): (usize, usize)) -> &T {
        assert!(row < self.rows() && column < self.columns(), "no entry ({row}, {column}) in a {} matrix", self.shape);
        &self.entries[row * self.columns() + column]
    }
}

impl<T> IndexMut<(usize, usize)> for Matrix<T> {
    fn index_mut(&mut self, (row, column): (usize, usize)) -> &mut T {
        assert!(row < self.rows() && column < self.columns(), "no entry ({row}, {column}) in a {} matrix", self.shape);
        let columns = self.columns();
        &mut self.entries[row * columns + column]
    }
}

impl<T: fmt::Debug> fmt::Debug for Matrix<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ", self.shape)?;
        f.debug_list().entries((0..self.rows()).map(|i| self.row(i))).finish()
    }
}

impl<T: fmt::Display> fmt::Display for Matrix<T> {
    /// Rows in brackets: `[[1, 1/2], [0, 1/3]]`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("[")?;
        for i in 0..self.rows() {
            f.write_str(if i == 0 { "[" } else { ", [" })?;
            for (j, entry) in self.row(i).iter().enumerate() {
                write!(f, "{}{entry}", if j == 0 { "" } else { ", " })?;
            }
            f.write_str("]")?;
        }
        f.write_str("]")
    }
}
