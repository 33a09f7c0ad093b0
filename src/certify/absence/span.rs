//! Spaces of rows that grow, and what is orthogonal to them.

use crate::matrix::Matrix;
use crate::scalar::Field;

/// The span of rows in reduced echelon form; a row may carry entries on its right, which take part and are never pivots.
pub(super) struct Span<F> {
    width: usize,
    rows: Vec<Vec<F>>,
    pivots: Vec<usize>,
}

impl<F: Field> Span<F> {
    /// The span of nothing, with pivots among the first `width` entries.
    pub(super) fn new(width: usize) -> Self {
        Self { width, rows: Vec::new(), pivots: Vec::new() }
    }

    /// The span of the rows of a matrix.
    pub(super) fn of(matrix: &Matrix<F>, width: usize) -> Self {
        let mut span = Self::new(width);
        for i in 0..matrix.rows() {
            // A row of the span adds nothing.
            let _ = span.insert(matrix.row(i));
        }
        span
    }

    /// The number of independent rows.
    pub(super) fn dimension(&self) -> usize {
        self.rows.len()
    }

    /// The columns where one row has a one and the others zeros.
    pub(super) fn pivots(&self) -> &[usize] {
        &self.pivots
    }

    /// The columns without a pivot, in increasing order.
    pub(super) fn free(&self) -> Vec<usize> {
        (0..self.width).filter(|j| !self.pivots.contains(j)).collect()
    }

    /// The row less a combination of the span that makes it zero at all pivots.
    pub(super) fn reduced(&self, row: &[F]) -> Vec<F> {
        let mut rest = row.to_vec();
        for (known, &pivot) in self.rows.iter().zip(&self.pivots) {
            subtract(&mut rest, known, pivot);
        }
        rest
    }

    /// Takes in a row; the row that is new in the span, or what is left on the right where none is.
    pub(super) fn insert(&mut self, row: &[F]) -> Result<&[F], Vec<F>> {
        let mut rest = self.reduced(row);
        let Some(pivot) = rest[..self.width].iter().position(|entry| !entry.is_zero()) else {
            return Err(rest.split_off(self.width));
        };
        let Ok(inverse) = F::one().over(&rest[pivot]) else { unreachable!("the pivot is not zero") };
        let rest: Vec<F> = rest.iter().map(|entry| entry.times(&inverse)).collect();
        for known in &mut self.rows {
            subtract(known, &rest, pivot);
        }
        self.rows.push(rest);
        self.pivots.push(pivot);
        Ok(self.rows.last().map_or(&[], Vec::as_slice))
    }

    /// The rows, in the order of their pivots' arrival.
    pub(super) fn basis(&self) -> Matrix<F> {
        let length = self.rows.first().map_or(self.width, Vec::len);
        Matrix::from_fn(self.rows.len(), length, |i, j| self.rows[i][j].clone())
    }

    /// The rows x with x v = 0 for every v of the span (without what it carries), with the identity at the columns that are no pivots.
    pub(super) fn annihilator(&self) -> Matrix<F> {
        let free = self.free();
        let mut rows = Matrix::zeros(free.len(), self.width);
        for (k, &column) in free.iter().enumerate() {
            rows[(k, column)] = F::one();
            for (known, &pivot) in self.rows.iter().zip(&self.pivots) {
                rows[(k, pivot)] = known[column].negated();
            }
        }
        rows
    }
}

/// Subtracts the multiple of a row with a one at the pivot that makes the other zero there.
fn subtract<F: Field>(row: &mut [F], known: &[F], pivot: usize) {
    let factor = row[pivot].clone();
    if factor.is_zero() {
        return;
    }
    for (entry, other) in row.iter_mut().zip(known) {
        if !other.is_zero() {
            *entry = entry.minus(&factor.times(other));
        }
    }
}

/// The rows of a matrix with every row's combination carried along.
pub(super) struct Combinations<F> {
    span: Span<F>,
    count: usize,
    /// The combinations of rows that vanish.
    pub(super) relations: Vec<Vec<F>>,
}

impl<F: Field> Combinations<F> {
    /// Of the rows of a matrix.
    pub(super) fn of(matrix: &Matrix<F>) -> Self {
        let (count, width) = (matrix.rows(), matrix.columns());
        let mut span = Span::new(width);
        let mut relations = Vec::new();
        let numbered = matrix.beside(&Matrix::identity(count));
        for i in 0..count {
            if let Err(relation) = span.insert(numbered.row(i)) {
                relations.push(relation);
            }
        }
        Self { span, count, relations }
    }

    /// X with `X · matrix = rows`, if there is one.
    pub(super) fn solve(&self, rows: &Matrix<F>) -> Option<Matrix<F>> {
        let width = rows.columns();
        let mut solution = Matrix::zeros(rows.rows(), self.count);
        let numbered = rows.beside(&Matrix::zeros(rows.rows(), self.count));
        for i in 0..rows.rows() {
            let rest = self.span.reduced(numbered.row(i));
            if rest[..width].iter().any(|entry| !entry.is_zero()) {
                return None;
            }
            for (j, entry) in rest[width..].iter().enumerate() {
                solution[(i, j)] = entry.negated();
            }
        }
        Some(solution)
    }
}
