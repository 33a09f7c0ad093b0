//! The form of Bierman and Thornton: P = U D Uᵀ.

use nalgebra::{DMatrix, DVector};

use super::error::Obstacle;
use super::factor::Factor;
use super::factored::{Conditioned, Factored, Reduction};
use super::rank::rounded_off;

/// U unit upper triangular and D diagonal with `P = U D Uᵀ`: no square root is drawn anywhere.
///
/// The rows of the array are orthogonalised in the weights of its columns, as in Thornton's time update (Bierman, *Factorization
/// Methods for Discrete Sequential Estimation*, ch. VI: modified weighted Gram–Schmidt), those of the readings first:
///
/// ```text
/// s = Σ λⱼ yⱼ²,   k = Σ λⱼ xⱼ yⱼ / s,   x ← x − k y     for each row x after y;     x̂ ← x̂ + k ν
/// ```
///
/// which for one reading with noise of its own is Bierman's measurement update in the array form of Jover and Kailath (1986).
/// As good as square roots, and exact where these have to round a root; a row of which nothing is left has d = 0 and is passed over.
/// It needs covariances that have factors, so none that is indefinite.
pub(super) struct GramSchmidt;

/// The UD form.
pub(super) type Ud = Factored<GramSchmidt>;

impl Reduction for GramSchmidt {
    const NAME: &'static str = "ud";
    const DESCRIPTION: &'static str = "P = UDU', weighted Gram-Schmidt, no square roots, cross noise inside";

    fn compressed(factor: Factor) -> Result<Factor, Obstacle> {
        let Factor { mut rows, weights } = factor;
        let n = rows.nrows();
        let (mut upper, mut variances) = (Vec::new(), Vec::new());
        for j in (0..n).rev() {
            let variance = square(&rows, j, &weights);
            if variance > 0.0 {
                let mut column = DVector::zeros(n);
                column[j] = 1.0;
                for i in 0..j {
                    column[i] = orthogonalise(&mut rows, i, j, variance, &weights);
                }
                upper.push(column);
                variances.push(variance);
            }
        }
        let rows = DMatrix::from_fn(n, upper.len(), |i, k| upper[k][i]);
        Ok(Factor { rows, weights: DVector::from_vec(variances) })
    }

    fn conditioned(readings: DMatrix<f64>, others: Factor, innovation: &DVector<f64>) -> Result<Conditioned, Obstacle> {
        let Factor { rows: other_rows, weights } = others;
        let (m, count) = (readings.nrows(), other_rows.nrows());
        let mut rows = DMatrix::zeros(m + count, readings.ncols());
        rows.rows_mut(0, m).copy_from(&readings);
        rows.rows_mut(m, count).copy_from(&other_rows);
        // What is left of the innovations, and of each of them as a function of all.
        let mut left = innovation.clone();
        let mut weight_of = DMatrix::<f64>::identity(m, m);
        let mut correction = DVector::zeros(count);
        let mut gain = DMatrix::zeros(count, m);
        let mut regular = true;
        for y in 0..m {
            let variance = square(&rows, y, &weights);
            if variance == 0.0 {
                regular = false;
                continue;
            }
            let own = weight_of.row(y).into_owned();
            for x in y + 1..m + count {
                let k = orthogonalise(&mut rows, x, y, variance, &weights);
                if x < m {
                    left[x] -= k * left[y];
                    let changed = weight_of.row(x) - &own * k;
                    weight_of.set_row(x, &changed);
                } else {
                    correction[x - m] += k * left[y];
                    let changed = gain.row(x - m) + &own * k;
                    gain.set_row(x - m, &changed);
                }
            }
        }
        let rest = Factor { rows: rows.rows(m, count).into_owned(), weights };
        Ok(Conditioned { rest, correction, gain: regular.then_some(gain) })
    }
}

/// Σ λⱼ xⱼ²
fn square(rows: &DMatrix<f64>, x: usize, weights: &DVector<f64>) -> f64 {
    (0..weights.len()).map(|j| weights[j] * rows[(x, j)] * rows[(x, j)]).sum()
}

/// Takes from row x what it has along row y, and says how many times y that is.
fn orthogonalise(rows: &mut DMatrix<f64>, x: usize, y: usize, variance: f64, weights: &DVector<f64>) -> f64 {
    let k = (0..weights.len()).map(|j| weights[j] * rows[(x, j)] * rows[(y, j)]).sum::<f64>() / variance;
    let magnitude = (0..weights.len()).map(|j| (weights[j] * rows[(x, j)] * rows[(y, j)]).abs()).sum::<f64>() / variance;
    for j in 0..weights.len() {
        let (entry, other) = (rows[(x, j)], rows[(y, j)]);
        rows[(x, j)] = rounded_off(entry - k * other, entry.abs() + magnitude * other.abs(), weights.len() + 1);
    }
    k
}
