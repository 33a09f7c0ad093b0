//! The form of Bierman and Thornton: P = U D Uᵀ.

use nalgebra::{DMatrix, DVector};

use super::error::Obstacle;
use super::factor::Factor;
use super::factored::{Conditioned, Factored, Reduction, Stage};
use super::rank::{Computed, rounded_off};

/// U unit upper triangular and D diagonal with `P = U D Uᵀ`: no square root is drawn anywhere.
///
/// Rows are made triangular by Thornton's modified weighted Gram–Schmidt. A reading is taken entry by entry by Bierman's update, for
/// the joint state (v, w, x) with the noise in front, which is then his update with r = d₁ where the noise is independent, and
/// right where it is shared. With f = Uᵀh, j upwards from α = 0, b = 0:
///
/// ```text
/// v = dⱼfⱼ,   α' = α + fⱼv,   dⱼ ← dⱼ α/α',   (uᵢⱼ, bᵢ) ← (uᵢⱼ − bᵢ fⱼ/α, bᵢ + uᵢⱼ v) for i < j,   bⱼ = v;     at last k = b/α
/// ```
///
/// Source: Bierman, *Factorization Methods for Discrete Sequential Estimation*, ch. V and VI. As good as square roots: α is a sum of what
/// is not negative, so no variance cancels: of one state and one reading `P(R/S)` is left, between 0 and P (`proofs/smt/float/ud-between.smt2`).
/// A reading of which nothing is left has α = 0 and is passed over. It needs
/// covariances that have factors, so none that is indefinite.
pub(super) struct GramSchmidt;

/// The UD form.
pub(super) type Ud = Factored<GramSchmidt>;

impl Reduction for GramSchmidt {
    const NAME: &'static str = "ud";
    const DESCRIPTION: &'static str = "P = UDU', scalar readings by Bierman, transitions by Thornton, no square roots";

    fn compressed(factor: Factor) -> Result<Factor, Obstacle> {
        let Triangular { upper, variances, .. } = Triangular::of(factor.rows.into(), factor.weights);
        let kept: Vec<usize> = (0..variances.len()).filter(|&j| variances[j] != 0.0).collect();
        Ok(Factor { rows: upper.select_columns(&kept), weights: variances.select_rows(&kept) })
    }

    fn conditioned(stage: &Stage<'_>, innovation: &DVector<f64>) -> Result<Conditioned, Obstacle> {
        let (n, m) = (stage.state.entries.nrows(), stage.noise.entries.nrows());
        let noise = stage.process.as_ref().map_or_else(|| stage.noise.clone(), |process| stage.noise.above(process));
        let first = noise.entries.nrows();
        let mut joint = Triangular::of(noise.above(&stage.state), stage.weights.clone());
        let (mut shift, mut gain) = (DVector::zeros(first + n), DMatrix::zeros(first + n, m));
        let mut regular = true;
        for i in 0..m {
            let mut h = DVector::zeros(first + n);
            h[i] = 1.0;
            h.rows_mut(first, n).copy_from(&stage.observation.row(i).transpose());
            let Some(k) = joint.take(&h) else {
                regular = false;
                continue;
            };
            shift += &k * (innovation[i] - h.dot(&shift));
            let mut own = -(h.transpose() * &gain);
            own[i] += 1.0;
            gain += k * own;
        }
        let departs = stage.process.is_some();
        let of_others = |rows: &DMatrix<f64>| {
            let ahead = departs.then(|| rows.rows(m, n).into_owned().into());
            stage.others(&rows.rows(first, n).into_owned().into(), ahead.as_ref()).entries
        };
        let rest = Factor { rows: of_others(&joint.upper), weights: joint.variances };
        let correction = of_others(&DMatrix::from_column_slice(first + n, 1, shift.as_slice())).column(0).into_owned();
        Ok(Conditioned { rest, correction, gain: regular.then(|| of_others(&gain)) })
    }
}

/// `U D Uᵀ`, where variances may be zero.
struct Triangular {
    upper: DMatrix<f64>,
    variances: DVector<f64>,
    /// The magnitudes of what the entries of U were computed from.
    terms: DMatrix<f64>,
    /// The deviations of the rows at first: no chain of steps rounds by more.
    most: DVector<f64>,
}

impl Triangular {
    /// The rows made orthogonal in the weights of the columns, from the last one on.
    fn of(rows: Computed, weights: DVector<f64>) -> Self {
        let Computed { entries: rows, terms } = rows;
        let n = rows.nrows();
        let deviation =
            |i: usize| terms.row(i).iter().zip(&weights).map(|(term, weight)| weight * term * term).sum::<f64>();
        let most = (0..n).map(|i| deviation(i).sqrt()).collect();
        let mut rest = Rest { rows, weights, terms, most };
        let (mut upper, mut variances, mut terms) = (DMatrix::identity(n, n), DVector::zeros(n), DMatrix::zeros(n, n));
        for j in (0..n).rev() {
            variances[j] = rest.square(j);
            if variances[j] != 0.0 {
                for i in 0..j {
                    (upper[(i, j)], terms[(i, j)]) = rest.orthogonalise(i, j, variances[j]);
                }
            }
        }
        Self { upper, variances, terms, most: DVector::from_vec(rest.most) }
    }

    /// Takes a reading h x without noise, and hands out its gain; nothing if it says nothing.
    fn take(&mut self, h: &DVector<f64>) -> Option<DVector<f64>> {
        let Self { upper, variances, terms, most } = self;
        let n = h.len();
        let (mut alpha, mut b, mut of_b) = (0.0, DVector::zeros(n), DVector::zeros(n));
        for j in 0..n {
            let sum: f64 = (0..=j).map(|i| upper[(i, j)] * h[i]).sum();
            let of_f: f64 = (0..=j).map(|i| (upper[(i, j)].abs() + terms[(i, j)]) * h[i].abs()).sum();
            let of_f = of_f.min(h.abs().dot(most) / variances[j].sqrt());
            let f = rounded_off(sum, of_f, j + 1);
            let v = variances[j] * f;
            let of_v = variances[j] * of_f;
            let raised = alpha + f * v;
            if v == 0.0 || raised == 0.0 {
                continue;
            }
            variances[j] *= alpha / raised;
            for i in 0..j {
                let entry = upper[(i, j)];
                let of_entry = entry.abs() + terms[(i, j)];
                if alpha != 0.0 {
                    terms[(i, j)] += of_b[i] * (f / alpha).abs() + f64::abs(b[i]) * (of_f / alpha);
                    let of_changed = (entry.abs() + terms[(i, j)]).min(most[i] / variances[j].sqrt());
                    upper[(i, j)] = rounded_off(entry - b[i] * (f / alpha), of_changed, 2);
                }
                b[i] += entry * v;
                of_b[i] += of_entry * v.abs() + entry.abs() * of_v;
            }
            (b[j], of_b[j]) = (v, of_v);
            alpha = raised;
        }
        (alpha != 0.0).then(|| b / alpha)
    }
}

/// Rows while they are made orthogonal.
struct Rest {
    rows: DMatrix<f64>,
    weights: DVector<f64>,
    /// The magnitudes of what each entry was computed from.
    terms: DMatrix<f64>,
    /// The lengths of the rows at first: no chain of steps rounds by more.
    most: Vec<f64>,
}

impl Rest {
    /// Σ λⱼ xⱼ²
    fn square(&self, x: usize) -> f64 {
        (0..self.weights.len()).map(|j| self.weights[j] * self.rows[(x, j)] * self.rows[(x, j)]).sum()
    }

    /// Takes from row x what it has along row y: how many times y that is, and what this was computed from.
    fn orthogonalise(&mut self, x: usize, y: usize, variance: f64) -> (f64, f64) {
        let Self { rows, weights, terms, most } = self;
        let columns = weights.len();
        let k = (0..columns).map(|j| weights[j] * rows[(x, j)] * rows[(y, j)]).sum::<f64>() / variance;
        let of_k = (0..columns)
            .map(|j| weights[j] * (terms[(x, j)] * rows[(y, j)].abs() + rows[(x, j)].abs() * terms[(y, j)]))
            .sum::<f64>()
            / variance;
        for j in 0..columns {
            terms[(x, j)] += of_k * rows[(y, j)].abs() + k.abs() * terms[(y, j)];
            let most = most[x] / weights[j].sqrt();
            rows[(x, j)] = rounded_off(rows[(x, j)] - k * rows[(y, j)], terms[(x, j)].min(most), columns + 1);
        }
        (k, of_k)
    }
}
