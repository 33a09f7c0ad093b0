//! Fraction-free (Bareiss) Gauss–Jordan elimination: rank, kernel, determinant.

use super::Matrix;
use crate::scalar::{Field, Scalar, ZeroTest};

/// No entry of a column is certainly nonzero, and some may be: the pivot cannot be chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("whether column {column} has a nonzero pivot is undecided")]
pub struct Undecided {
    /// The column, counted from 0.
    pub column: usize,
}

/// The result of an elimination: row i has the entry `divisor` in column `pivots[i]`, where every other
/// row has zero; the rows below the rank are zero in the columns searched.
///
/// Every entry is a minor of the original matrix (Bareiss 1968), so on integers no fraction ever appears.
#[derive(Clone, Debug)]
pub struct Echelon<S> {
    rows: Matrix<S>,
    pivots: Vec<usize>,
    divisor: S,
    odd_swaps: bool,
}

impl<S: Scalar> Echelon<S> {
    /// Eliminates with pivots from the first `columns` columns; the others are carried along.
    ///
    /// The pivot is the first entry that is certainly nonzero: no magnitudes are compared.
    ///
    /// # Errors
    ///
    /// [`Undecided`] if a column has no certain pivot and an entry that may be nonzero.
    pub fn of(matrix: &Matrix<S>, columns: usize) -> Result<Self, Undecided> {
        let mut echelon = Self { rows: matrix.clone(), pivots: Vec::new(), divisor: S::one(), odd_swaps: false };
        for column in 0..columns {
            if let Some(row) = echelon.pivot_row(column)? {
                echelon.clear(row, column)?;
            }
        }
        Ok(echelon)
    }

    fn pivot_row(&self, column: usize) -> Result<Option<usize>, Undecided> {
        let mut undecided = false;
        for row in self.pivots.len()..self.rows.rows() {
            match self.rows[(row, column)].zero_test() {
                ZeroTest::Nonzero => return Ok(Some(row)),
                ZeroTest::Undecided => undecided = true,
                ZeroTest::Zero => {}
            }
        }
        if undecided { Err(Undecided { column }) } else { Ok(None) }
    }

    /// Brings the pivot in place and clears its column in all other rows.
    fn clear(&mut self, row: usize, column: usize) -> Result<(), Undecided> {
        let place = self.pivots.len();
        if row != place {
            for j in 0..self.rows.columns() {
                let moved = self.rows[(row, j)].clone();
                self.rows[(row, j)] = std::mem::replace(&mut self.rows[(place, j)], moved);
            }
            self.odd_swaps = !self.odd_swaps;
        }
        let pivot = self.rows[(place, column)].clone();
        for i in (0..self.rows.rows()).filter(|&i| i != place) {
            let factor = self.rows[(i, column)].clone();
            for j in 0..self.rows.columns() {
                let minor = pivot.times(&self.rows[(i, j)]).minus(&factor.times(&self.rows[(place, j)]));
                // Exact by Sylvester's identity; the divisor is an earlier pivot, certainly nonzero.
                self.rows[(i, j)] = minor.over(&self.divisor).map_err(|_| Undecided { column })?;
            }
        }
        self.divisor = pivot;
        self.pivots.push(column);
        Ok(())
    }

    /// The number of pivots.
    pub fn rank(&self) -> usize {
        self.pivots.len()
    }

    /// The columns that hold the pivots, in increasing order.
    pub fn pivots(&self) -> &[usize] {
        &self.pivots
    }

    /// The common value of all pivots: up to sign, the minor of the pivot rows and columns.
    pub fn divisor(&self) -> &S {
        &self.divisor
    }

    /// The eliminated rows, still to be divided by [`Echelon::divisor`].
    pub fn undivided(&self) -> &Matrix<S> {
        &self.rows
    }

    /// The rows that hold a pivot, divided: the nonzero rows of the reduced echelon form.
    ///
    /// # Errors
    ///
    /// [`Undecided`] never on a field: the divisor is certainly nonzero.
    pub fn reduced(&self) -> Result<Matrix<S>, Undecided> {
        let rows = self.rows.block(0..self.rank(), 0..self.rows.columns());
        let column = self.pivots.last().copied().unwrap_or(0);
        rows.try_map(|entry| entry.over(&self.divisor).map_err(|_| Undecided { column }))
    }

    /// The determinant of the columns searched, if they form a square matrix.
    pub(super) fn determinant(&self) -> S {
        if self.rank() < self.rows.rows() {
            S::zero()
        } else if self.odd_swaps {
            self.divisor.negated()
        } else {
            self.divisor.clone()
        }
    }
}

impl<S: Scalar> Matrix<S> {
    /// The determinant, by fraction-free elimination; that of the 0×0 matrix is one.
    ///
    /// # Errors
    ///
    /// [`Undecided`] if a pivot cannot be chosen; never on a field.
    ///
    /// # Panics
    ///
    /// If the matrix is not square.
    pub fn determinant(&self) -> Result<S, Undecided> {
        assert!(self.is_square(), "a {} matrix has no determinant", self.shape());
        Ok(Echelon::of(self, self.columns())?.determinant())
    }
}

impl<S: Field> Matrix<S> {
    /// The echelon form; a field always decides it.
    pub(super) fn echelon(&self) -> Echelon<S> {
        match Echelon::of(self, self.columns()) {
            Ok(echelon) => echelon,
            Err(undecided) => unreachable!("a field decides zero, but {undecided}"),
        }
    }

    /// The rank.
    pub fn rank(&self) -> usize {
        self.echelon().rank()
    }

    /// Whether every entry is zero.
    pub fn is_zero(&self) -> bool {
        self.entries().iter().all(S::is_zero)
    }

    /// A basis of the kernel {v : self · v = 0}, as the columns of a matrix.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::Rational};
    ///
    /// let a = Matrix::<Rational>::from_integers(&[[1, 2, 3], [2, 4, 6]]);
    /// assert_eq!(a.kernel().columns(), 2);
    /// assert!((&a * a.kernel()).is_zero());
    /// ```
    pub fn kernel(&self) -> Self {
        let echelon = self.echelon();
        let free: Vec<usize> = (0..self.columns()).filter(|j| !echelon.pivots().contains(j)).collect();
        let mut basis = Self::zeros(self.columns(), free.len());
        for (k, &column) in free.iter().enumerate() {
            // Scaled by the divisor, so that a kernel over the integers has integer entries.
            basis[(column, k)] = echelon.divisor().clone();
            for (row, &pivot) in echelon.pivots().iter().enumerate() {
                basis[(pivot, k)] = echelon.undivided()[(row, column)].negated();
            }
        }
        basis
    }
}
