//! Covariances as weighted sums of squares.

use nalgebra::{DMatrix, DVector};

use super::error::Obstacle;
use super::rank::{Computed, is_rounding, rounded_off};

/// `rows · diag(weights) · rowsᵀ`, one column for each independent source of unit weight.
#[derive(Clone, Debug)]
pub(super) struct Factor {
    /// n×k
    pub(super) rows: DMatrix<f64>,
    /// The variances of the k sources, positive.
    pub(super) weights: DVector<f64>,
}

impl Factor {
    /// `P = L D Lᵀ` with as many columns as P has rank: pivots are taken in the order of what is left of each variance,
    /// relative to that variance, and end where that is nothing but rounding ([`rank`](super::rank)). After r pivots what is left of a
    /// variance was computed from at most (r + 1)² times itself, unless some combination of the rows has coefficients above one, which
    /// this order of the pivots prevents nearly always (Higham, *Accuracy and Stability of Numerical Algorithms*, 10.3).
    ///
    /// # Errors
    ///
    /// [`Obstacle::NotFinite`]; [`Obstacle::Indefinite`] if a variance is negative, or what is left of one.
    pub(super) fn of(p: &DMatrix<f64>) -> Result<Self, Obstacle> {
        let (rows, weights) = Self::computed(p)?;
        Ok(Self { rows: rows.entries, weights })
    }

    /// The rows and the weights, with the terms of each entry of the rows: where a difference left nothing but rounding it is zero, and
    /// these say of what.
    ///
    /// # Errors
    ///
    /// As for [`of`](Self::of).
    pub(super) fn computed(p: &DMatrix<f64>) -> Result<(Computed, DVector<f64>), Obstacle> {
        let n = p.nrows();
        if !p.iter().all(|entry| entry.is_finite()) {
            return Err(Obstacle::NotFinite);
        }
        let (mut schur, mut columns, mut weights) = (p.clone(), Vec::new(), Vec::new());
        let mut terms = p.abs();
        let mut left: Vec<usize> = (0..n).filter(|&i| p[(i, i)] != 0.0).collect();
        let share = |schur: &DMatrix<f64>, i: usize| schur[(i, i)] / p[(i, i)];
        if left.iter().any(|&i| p[(i, i)] < 0.0) {
            return Err(Obstacle::Indefinite);
        }
        while let Some(place) = (0..left.len()).max_by(|&one, &other| {
            // Of equal ones the first.
            share(&schur, left[one]).total_cmp(&share(&schur, left[other])).then(other.cmp(&one))
        }) {
            let pivot = left[place];
            let variance = schur[(pivot, pivot)];
            if variance <= 0.0 || is_rounding(variance, bounded(&terms, p, pivot, columns.len()), n) {
                break;
            }
            left.remove(place);
            let mut column = DVector::zeros(n);
            column[pivot] = 1.0;
            let mut of_column = column.clone();
            for &i in &left {
                let entry = schur[(i, pivot)] / variance;
                of_column[i] = (terms[(i, pivot)] + entry.abs() * terms[(pivot, pivot)]) / variance;
                column[i] = rounded_off(entry, of_column[i], n);
            }
            for &i in &left {
                for &j in &left {
                    let [of_i, of_j] = [column[i], column[j]].map(f64::abs);
                    schur[(i, j)] -= column[i] * schur[(j, pivot)];
                    terms[(i, j)] +=
                        of_i * terms[(j, pivot)] + of_j * terms[(i, pivot)] + of_i * of_j * terms[(pivot, pivot)];
                }
            }
            columns.push((column, of_column));
            weights.push(variance);
        }
        if left
            .iter()
            .any(|&i| schur[(i, i)] < 0.0 && !is_rounding(schur[(i, i)], bounded(&terms, p, i, columns.len()), n))
        {
            return Err(Obstacle::Indefinite);
        }
        let rows = Computed {
            entries: DMatrix::from_fn(n, columns.len(), |i, j| columns[j].0[i]),
            terms: DMatrix::from_fn(n, columns.len(), |i, j| columns[j].1[i]),
        };
        Ok((rows, DVector::from_vec(weights)))
    }

    /// The rank that was found.
    pub(super) fn rank(&self) -> usize {
        self.weights.len()
    }

    /// The covariance; symmetric to the last bit.
    pub(super) fn covariance(&self) -> DMatrix<f64> {
        let Self { rows, weights } = self;
        let entry = |i: usize, j: usize| (0..weights.len()).map(|k| rows[(i, k)] * weights[k] * rows[(j, k)]).sum();
        DMatrix::from_fn(rows.nrows(), rows.nrows(), |i, j| entry(i.max(j), i.min(j)))
    }

    /// The same with all weights one.
    pub(super) fn of_unit_weights(&self) -> DMatrix<f64> {
        let mut rows = self.rows.clone();
        for (mut column, &weight) in rows.column_iter_mut().zip(&self.weights) {
            if weight.to_bits() != 1.0_f64.to_bits() {
                column *= weight.sqrt();
            }
        }
        rows
    }
}

/// What the variance left after some pivots was computed from, as far as that can be told from the terms and from their number.
fn bounded(terms: &DMatrix<f64>, p: &DMatrix<f64>, i: usize, pivots: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "no matrix has 2^53 rows")]
    let most = (pivots as f64 + 1.0) * (pivots as f64 + 1.0) * p[(i, i)];
    terms[(i, i)].min(most)
}
