//! The joint covariance of observed entries and targets modulo one prime, and its elimination.

use super::image::{CoefficientForms, Shape};
use crate::modular::PrimeField;

/// The joint covariance of observed entries and targets, its lower triangle, and the column `constant − E x`.
///
/// One of these serves many primes in turn: a step is so little work that its memory would cost more.
#[derive(Clone, Debug, Default)]
pub(super) struct Joint {
    /// The constants of an affine map.
    constant: Vec<u64>,
    /// `M P` for a matrix M.
    moved: Vec<u64>,
    rows: Vec<u64>,
    column: Vec<u64>,
    /// The column of the pivot.
    factors: Vec<u64>,
}

/// What the elimination of the observed entries found.
pub(super) struct Elimination {
    /// Whether the rows of those without a pivot vanish.
    pub(super) settled: bool,
    /// The product of all pivots as they were met.
    pub(super) total: u64,
    /// The product of the values of `total` before each pivot.
    pub(super) product_of_totals: u64,
}

impl Joint {
    /// Where the constants of the next operation are put.
    pub(super) fn constant(&mut self) -> &mut Vec<u64> {
        self.constant.clear();
        &mut self.constant
    }

    /// `x ↦ A x − constant`, `P ↦ A P Aᵀ + Q`.
    pub(super) fn propagate(&mut self, field: &PrimeField, a: &[u64], q: &[u64], p: &mut [u64], x: &mut Vec<u64>) {
        let n = x.len();
        self.column.clear();
        let rows = a.chunks_exact(n).zip(&self.constant);
        self.column.extend(rows.map(|(row, constant)| field.difference(field.inner_product(row, x), *constant)));
        std::mem::swap(x, &mut self.column);
        self.move_by(field, a, p, n);
        for i in 0..n {
            for j in 0..=i {
                let entry = field.inner_product(&self.moved[i * n..][..n], &a[j * n..][..n]);
                let entry = field.sum(entry, q[i * n + j]);
                p[i * n + j] = entry;
                p[j * n + i] = entry;
            }
        }
    }

    /// `M P`, P symmetric.
    fn move_by(&mut self, field: &PrimeField, m: &[u64], p: &[u64], n: usize) {
        self.moved.clear();
        let entries =
            m.chunks_exact(n).flat_map(|row| p.chunks_exact(n).map(|column| field.inner_product(row, column)));
        self.moved.extend(entries);
    }

    /// `E P Eᵀ + noise`, and the column `constant − E x`.
    pub(super) fn assemble(
        &mut self,
        field: &PrimeField,
        coefficients: &CoefficientForms,
        p: &[u64],
        x: &[u64],
        shape: Shape,
    ) {
        let (n, m, size) = (shape.states, shape.observed, shape.size());
        let CoefficientForms { map, noise, .. } = coefficients;
        // For the rows of C and of the second target; the map to the first one is the identity.
        self.move_by(field, map, p, n);
        let place = |row: usize| if row < m { Some(row) } else { row.checked_sub(m + n).map(|row| m + row) };
        self.rows.resize(size * size, 0);
        for i in 0..size {
            for j in 0..=i {
                let entry = match (place(i), place(j)) {
                    (Some(i), Some(j)) => field.inner_product(&self.moved[i * n..][..n], &map[j * n..][..n]),
                    (None, Some(j)) => self.moved[j * n + i - m],
                    (None, None) => p[(i - m) * n + j - m],
                    // Between the two targets: not needed.
                    (Some(_), None) => continue,
                };
                self.rows[i * size + j] = field.sum(entry, noise[i * size + j]);
            }
        }
        let expected = |row: usize| match place(row) {
            Some(place) => field.inner_product(&map[place * n..][..n], x),
            None => x[row - m],
        };
        self.column.clear();
        self.column.extend((0..size).map(|row| field.difference(self.constant[row], expected(row))));
    }

    /// Eliminates the observed entries without a division: `a ↦ pivot · a − b c`, so that all is multiplied by each pivot.
    ///
    /// `pivots` tells in the end which of them have pivots.
    pub(super) fn eliminate(&mut self, field: &PrimeField, shape: Shape, pivots: &mut Vec<bool>) -> Elimination {
        let size = shape.size();
        pivots.clear();
        pivots.resize(shape.observed, false);
        let (mut total, mut product_of_totals) = (field.one(), field.one());
        let mut settled = true;
        for (row, is_pivot) in pivots.iter_mut().enumerate() {
            let pivot = self.rows[row * size + row];
            if pivot == 0 {
                let below = row + 1..size;
                settled &= self.column[row] == 0 && below.into_iter().all(|i| self.rows[i * size + row] == 0);
            } else {
                *is_pivot = true;
                self.eliminate_row(field, row, pivot, shape);
                product_of_totals = field.product(product_of_totals, total);
                total = field.product(total, pivot);
            }
        }
        Elimination { settled, total, product_of_totals }
    }

    fn eliminate_row(&mut self, field: &PrimeField, row: usize, pivot: u64, shape: Shape) {
        let (size, observed) = (shape.size(), shape.observed);
        self.factors.clear();
        self.factors.extend((0..size).map(|i| self.rows[i * size + row]));
        let head = self.column[row];
        for i in row + 1..size {
            let factor = self.factors[i];
            // The row of a target: the observed entries, then its own target's.
            let own = i.checked_sub(observed).map_or(i + 1, |place| observed + place / shape.states * shape.states);
            for columns in [row + 1..observed.min(i + 1), own.max(row + 1)..i + 1] {
                let entries = &mut self.rows[i * size..][columns.clone()];
                for (entry, other) in entries.iter_mut().zip(&self.factors[columns]) {
                    *entry = field.minor(pivot, *entry, factor, *other);
                }
            }
            self.column[i] = field.minor(pivot, self.column[i], factor, head);
        }
    }

    /// Mean and covariance of a target, once `inverse` has taken all pivots out.
    pub(super) fn hand_out(
        &self,
        field: &PrimeField,
        target: usize,
        shape: Shape,
        inverse: u64,
        covariance: &mut [u64],
        mean: &mut [u64],
    ) {
        let (n, first) = (shape.states, shape.observed + target * shape.states);
        let minus = field.negative(inverse);
        for (mean, entry) in mean.iter_mut().zip(&self.column[first..]) {
            *mean = field.product(*entry, minus);
        }
        for i in 0..n {
            for j in 0..=i {
                let entry = field.product(self.rows[(first + i) * shape.size() + first + j], inverse);
                covariance[i * n + j] = entry;
                covariance[j * n + i] = entry;
            }
        }
    }
}
