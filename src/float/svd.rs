//! The spectral form: P = V D² Vᵀ.

use nalgebra::{DMatrix, DVector};

use super::error::Obstacle;
use super::factor::Factor;
use super::factored::{Conditioned, Factored, Reduction, Stage};
use super::rank::{is_rounding, rounded_off};
use super::square_root::triangularise;

/// Orthogonal V and diagonal D with `P = V D² Vᵀ`, by one-sided rotations.
///
/// ```text
/// (C W  F) = Y = V_S D_S Zᵀ      K̄ = X Z D_S⁻¹ V_Sᵀ      x̂ + K̄ ν      X − K̄ Y = V' D' Z'ᵀ
/// ```
///
/// X stands for the other rows of the array. Source: Wang, Libert and Manneback (1992) for the time update; the update without inverses
/// of P and R, and with the rows of X − K̄Y for the form of Joseph, after Kulikova and Tsyganova (2017). Singular values of the readings
/// that are nothing but rounding are left out, after each reading was scaled by a power of two to a deviation near one.
///
/// Good where one wants to see in which directions nothing is known. The rotations are Jacobi's and act on columns, so states in units
/// of their own do no harm: `DMatrix::svd` would mix them, and loses digits besides (see [`pseudo_inverse`](super::pseudo_inverse)). It
/// needs covariances that have factors, so none that is indefinite.
pub(super) struct Rotations;

/// The SVD form.
pub(super) type Svd = Factored<Rotations>;

/// Far above the five to ten sweeps that it takes.
const SWEEPS: usize = 60;

impl Reduction for Rotations {
    const NAME: &'static str = "svd";
    const DESCRIPTION: &'static str = "P = VDDV', singular values by one-sided rotations, inverse of no covariance";

    fn compressed(factor: Factor) -> Result<Factor, Obstacle> {
        let mut rows = factor.of_unit_weights();
        let n = rows.nrows();
        // First to no more columns than there can be directions.
        let terms = rows.abs();
        let rank = triangularise(&mut rows, terms, n, 0).iter().flatten().count();
        let mut rows = rows.columns(0, rank).into_owned();
        orthogonalise(&mut rows, None);
        // V and D apart: V = (X Z) D⁻¹.
        let mut kept: Vec<(f64, usize)> = rows
            .column_iter()
            .map(|column| column.norm_squared())
            .zip(0..)
            .filter(|(square, _)| *square > 0.0)
            .collect();
        kept.sort_by(|(one, _), (other, _)| other.total_cmp(one));
        let vectors = DMatrix::from_fn(n, kept.len(), |i, k| rows[(i, kept[k].1)] / kept[k].0.sqrt());
        Ok(Factor {
            rows: vectors,
            weights: DVector::from_iterator(kept.len(), kept.iter().map(|(square, _)| *square)),
        })
    }

    fn conditioned(stage: &Stage<'_>, innovation: &DVector<f64>) -> Result<Conditioned, Obstacle> {
        let unit = |rows| Factor { rows, weights: stage.weights.clone() }.of_unit_weights();
        let (readings, rows) =
            (unit(stage.readings().entries), unit(stage.others(&stage.state, stage.process.as_ref()).entries));
        let m = readings.nrows();
        // Each reading in units of its deviation, to a power of two.
        let units = DVector::from_fn(m, |i, _| power_of_two(readings.row(i).norm()));
        let scaled = DMatrix::from_fn(m, readings.ncols(), |i, j| readings[(i, j)] * units[i]);
        // Columns of Yᵀ turned until they are orthogonal: Yᵀ V_S = Z D_S.
        let (mut turned, mut vectors) = (scaled.transpose(), DMatrix::identity(m, m));
        orthogonalise(&mut turned, Some(&mut vectors));
        let values: Vec<f64> = turned.column_iter().map(|column| column.norm()).collect();
        let largest = values.iter().copied().fold(0.0, f64::max);
        let kept: Vec<usize> = (0..m).filter(|&k| !is_rounding(values[k], largest, m)).collect();
        let mut gain = DMatrix::zeros(rows.nrows(), m);
        let (mut along, mut correction) = (DMatrix::zeros(rows.nrows(), m), DVector::zeros(rows.nrows()));
        for &k in &kept {
            let cross = &rows * turned.column(k) / (values[k] * values[k]);
            let share: f64 = (0..m).map(|i| vectors[(i, k)] * units[i] * innovation[i]).sum();
            correction += &cross * share;
            gain += &cross * DVector::from_fn(m, |i, _| vectors[(i, k)] * units[i]).transpose();
            along.set_column(k, &cross);
        }
        let rest = DMatrix::from_fn(rows.nrows(), rows.ncols(), |i, j| {
            let (mut sum, mut terms) = (rows[(i, j)], rows[(i, j)].abs());
            for &k in &kept {
                let part = along[(i, k)] * turned[(j, k)];
                sum -= part;
                terms += part.abs();
            }
            rounded_off(sum, terms, rows.ncols() + m)
        });
        let weights = DVector::repeat(rest.ncols(), 1.0);
        Ok(Conditioned { rest: Factor { rows: rest, weights }, correction, gain: (kept.len() == m).then_some(gain) })
    }
}

/// Turns pairs of columns until all are orthogonal, and those of `vectors` with them (Jacobi, one-sided: Hestenes 1958).
fn orthogonalise(columns: &mut DMatrix<f64>, mut vectors: Option<&mut DMatrix<f64>>) {
    for _ in 0..SWEEPS {
        let mut turned = false;
        for p in 0..columns.ncols() {
            for q in p + 1..columns.ncols() {
                turned |= turn(columns, p, q, &mut vectors);
            }
        }
        if !turned {
            return;
        }
    }
}

/// Turns two columns until they are orthogonal; whether they were not.
fn turn(columns: &mut DMatrix<f64>, p: usize, q: usize, vectors: &mut Option<&mut DMatrix<f64>>) -> bool {
    let [first, second] = [p, q].map(|k| columns.column(k).norm_squared());
    let product = columns.column(p).dot(&columns.column(q));
    if product == 0.0 || product.abs() <= f64::EPSILON * first.sqrt() * second.sqrt() || !product.is_finite() {
        return false;
    }
    let ratio = (second - first) / (2.0 * product);
    let tangent = ratio.signum() / (ratio.abs() + ratio.hypot(1.0));
    let cosine = tangent.hypot(1.0).recip();
    let sine = cosine * tangent;
    for matrix in [Some(columns), vectors.as_deref_mut()].into_iter().flatten() {
        for i in 0..matrix.nrows() {
            let (x, y) = (matrix[(i, p)], matrix[(i, q)]);
            matrix[(i, p)] = rounded_off(cosine * x - sine * y, (cosine * x).abs() + (sine * y).abs(), 2);
            matrix[(i, q)] = rounded_off(sine * x + cosine * y, (sine * x).abs() + (cosine * y).abs(), 2);
        }
    }
    true
}

/// A power of two that brings a number between 1/2 and 1, or one.
fn power_of_two(length: f64) -> f64 {
    if length > 0.0 && length.is_finite() { (-(length.log2().floor() + 1.0)).exp2() } else { 1.0 }
}
