//! The form of Bierman and Thornton: P = U D Uᵀ.

use nalgebra::{DMatrix, DVector};

use super::error::Obstacle;
use super::factor::Factor;
use super::factored::{Conditioned, Factored, Reduction, Stage, stacked};
use super::rank::rounded_off;

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
/// is not negative, so no variance cancels. A reading of which nothing is left has α = 0 and is passed over. It needs
/// covariances that have factors, so none that is indefinite.
pub(super) struct GramSchmidt;

/// The UD form.
pub(super) type Ud = Factored<GramSchmidt>;

impl Reduction for GramSchmidt {
    const NAME: &'static str = "ud";
    const DESCRIPTION: &'static str = "P = UDU', scalar readings by Bierman, transitions by Thornton, no square roots";

    fn compressed(factor: Factor) -> Result<Factor, Obstacle> {
        let Triangular { upper, variances } = Triangular::of(factor);
        let kept: Vec<usize> = (0..variances.len()).filter(|&j| variances[j] != 0.0).collect();
        Ok(Factor { rows: upper.select_columns(&kept), weights: variances.select_rows(&kept) })
    }

    fn conditioned(stage: &Stage<'_>, innovation: &DVector<f64>) -> Result<Conditioned, Obstacle> {
        let (n, m) = (stage.state.nrows(), stage.noise.nrows());
        let process =
            stage.process.as_ref().map_or_else(|| stage.noise.clone(), |process| stacked(&stage.noise, process));
        let rows = stacked(&process, &stage.state);
        let first = rows.nrows() - n;
        let mut joint = Triangular::of(Factor { rows, weights: stage.weights.clone() });
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
        let state = joint.upper.rows(first, n).into_owned();
        let departs = stage.process.is_some();
        let process = departs.then(|| joint.upper.rows(m, n).into_owned());
        let rest = Factor { rows: stage.others(&state, process.as_ref()), weights: joint.variances };
        let of_others = |rows: &DMatrix<f64>| {
            let ahead = departs.then(|| rows.rows(m, n).into_owned());
            stage.others(&rows.rows(first, n).into_owned(), ahead.as_ref())
        };
        let correction = of_others(&DMatrix::from_column_slice(first + n, 1, shift.as_slice())).column(0).into_owned();
        Ok(Conditioned { rest, correction, gain: regular.then(|| of_others(&gain)) })
    }
}

/// `U D Uᵀ`, where variances may be zero.
struct Triangular {
    upper: DMatrix<f64>,
    variances: DVector<f64>,
}

impl Triangular {
    /// The rows made orthogonal in the weights of the columns, from the last one on.
    fn of(factor: Factor) -> Self {
        let Factor { mut rows, weights } = factor;
        let n = rows.nrows();
        let (mut upper, mut variances) = (DMatrix::identity(n, n), DVector::zeros(n));
        for j in (0..n).rev() {
            variances[j] = (0..weights.len()).map(|k| weights[k] * rows[(j, k)] * rows[(j, k)]).sum();
            if variances[j] != 0.0 {
                for i in 0..j {
                    upper[(i, j)] = orthogonalise(&mut rows, i, j, variances[j], &weights);
                }
            }
        }
        Self { upper, variances }
    }

    /// Takes a reading h x without noise, and hands out its gain; nothing if it says nothing.
    fn take(&mut self, h: &DVector<f64>) -> Option<DVector<f64>> {
        let Self { upper, variances } = self;
        let n = h.len();
        let (mut alpha, mut b) = (0.0, DVector::zeros(n));
        for j in 0..n {
            let sum: f64 = (0..=j).map(|i| upper[(i, j)] * h[i]).sum();
            let terms: f64 = (0..=j).map(|i| (upper[(i, j)] * h[i]).abs()).sum();
            let f = rounded_off(sum, terms, j + 1);
            let v = variances[j] * f;
            let raised = alpha + f * v;
            if v == 0.0 || raised == 0.0 {
                continue;
            }
            variances[j] *= alpha / raised;
            for i in 0..j {
                let entry = upper[(i, j)];
                if alpha != 0.0 {
                    let change = b[i] * (f / alpha);
                    upper[(i, j)] = rounded_off(entry - change, entry.abs() + f64::abs(change), 2);
                }
                b[i] += entry * v;
            }
            b[j] = v;
            alpha = raised;
        }
        (alpha != 0.0).then(|| b / alpha)
    }
}

/// Takes from row x what it has along row y, and says how many times y that is.
fn orthogonalise(rows: &mut DMatrix<f64>, x: usize, y: usize, variance: f64, weights: &DVector<f64>) -> f64 {
    let terms = |j: usize| weights[j] * rows[(x, j)] * rows[(y, j)];
    let k = (0..weights.len()).map(terms).sum::<f64>() / variance;
    let magnitude = (0..weights.len()).map(|j| terms(j).abs()).sum::<f64>() / variance;
    for j in 0..weights.len() {
        let (entry, other) = (rows[(x, j)], rows[(y, j)]);
        rows[(x, j)] = rounded_off(entry - k * other, entry.abs() + magnitude * other.abs(), weights.len() + 1);
    }
    k
}
