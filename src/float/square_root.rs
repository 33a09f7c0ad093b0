//! The array form: a square root of P, by reflections.

use nalgebra::{DMatrix, DVector, RowDVector};

use super::error::Obstacle;
use super::factor::Factor;
use super::factored::{Conditioned, Factored, Reduction, Stage};
use super::rank::rounded_off;

/// A triangular L with `P = L Lᵀ`, and the pre-array brought to triangular form by Householder reflections of its columns.
///
/// ```text
/// ( C L   F )        ( S^½       0  )       S^½ e = ν,   x̂ + K̄ e,   x̂₊ = A x̂ + B u + K̄₊ e
/// (  L    0 )  Θ  =  ( K̄         L' )
/// ( A L   D )        ( K̄₊        L₊ )
/// ```
///
/// Source: Kailath, Sayed and Hassibi, *Linear Estimation*, ch. 12, with the process noise in the array, so that D and F may be
/// correlated. No covariance is formed, so condition numbers enter by their roots; P is semidefinite by its making. A row of the
/// readings of which nothing is left is passed over: plain triangularisation would divide by the rounding errors in its
/// place, or by zero. It needs covariances that have factors, so none that is indefinite.
pub(super) struct Reflections;

/// The square-root form.
pub(super) type SquareRoot = Factored<Reflections>;

impl Reduction for Reflections {
    const NAME: &'static str = "square-root";
    const DESCRIPTION: &'static str = "P = LL', array brought to triangular form by reflections, cross noise inside";

    fn compressed(factor: Factor) -> Result<Factor, Obstacle> {
        let mut rows = factor.of_unit_weights();
        let terms = rows.abs();
        let pivots = triangularise(&mut rows, terms, factor.rows.nrows(), 0);
        let rank = pivots.iter().flatten().count();
        Ok(Factor { rows: rows.columns(0, rank).into_owned(), weights: DVector::repeat(rank, 1.0) })
    }

    fn conditioned(stage: &Stage<'_>, innovation: &DVector<f64>) -> Result<Conditioned, Obstacle> {
        let others = stage.others(&stage.state, stage.process.as_ref());
        let (m, count) = (stage.noise.entries.nrows(), others.entries.nrows());
        let rows = stage.readings().above(&others);
        let unit = |rows| Factor { rows, weights: stage.weights.clone() }.of_unit_weights();
        let (mut array, terms) = (unit(rows.entries), unit(rows.terms));
        let pivots = triangularise(&mut array, terms, m, m);
        let rank = pivots.iter().flatten().count();
        let cross = array.view((m, 0), (count, rank));
        // S^½ e = ν, and S^½ X = I for the gain, by forward substitution in the rows that have a pivot.
        let solved = |right: &dyn Fn(usize) -> f64| {
            let mut e = DVector::zeros(rank);
            for (i, column) in pivots.iter().enumerate().filter_map(|(i, pivot)| Some((i, (*pivot)?))) {
                let known: f64 = (0..column).map(|j| array[(i, j)] * e[j]).sum();
                e[column] = (right(i) - known) / array[(i, column)];
            }
            e
        };
        let correction = cross * solved(&|i| innovation[i]);
        let gain = (rank == m).then(|| {
            let columns: Vec<_> = (0..m).map(|k| cross * solved(&|i| if i == k { 1.0 } else { 0.0 })).collect();
            DMatrix::from_fn(count, m, |i, k| columns[k][i])
        });
        let rest = array.view((m, rank), (count, array.ncols() - rank)).into_owned();
        let weights = DVector::repeat(rest.ncols(), 1.0);
        Ok(Conditioned { rest: Factor { rows: rest, weights }, correction, gain })
    }
}

/// Makes the first `count` rows lower triangular by reflections of the columns; for each of them the column of its pivot, or
/// nothing if nothing is left of it. `terms` are the magnitudes of what each entry was computed from.
/// The first `readings` rows are those.
pub(super) fn triangularise(
    array: &mut DMatrix<f64>,
    mut terms: DMatrix<f64>,
    count: usize,
    readings: usize,
) -> Vec<Option<usize>> {
    let (mut pivots, mut column) = (Vec::with_capacity(count), 0);
    // A chain of reflections rounds a row by no more than its length, however long the chain of bounds. In the rows that are made
    // triangular it is the bounds that count: what is left of a row that repeats others is amplified by how nearly those do.
    let most: Vec<f64> =
        (0..array.nrows()).map(|i| if i < readings { f64::INFINITY } else { terms.row(i).norm() }).collect();
    for i in 0..count {
        let length = length(&array.view((i, column), (1, array.ncols() - column)).row(0).into_owned());
        if length == 0.0 {
            pivots.push(None);
            continue;
        }
        reflect(array, &mut terms, &most, (i, column), length);
        pivots.push(Some(column));
        column += 1;
    }
    pivots
}

/// The length of a row, free of overflow.
fn length(row: &RowDVector<f64>) -> f64 {
    let largest = row.amax();
    if largest > 0.0 { largest * (row / largest).norm() } else { 0.0 }
}

/// Turns row i, from the column on, into (length, 0, …, 0), and the rows below with it.
fn reflect(array: &mut DMatrix<f64>, terms: &mut DMatrix<f64>, most: &[f64], (i, column): (usize, usize), length: f64) {
    let width = array.ncols() - column;
    if width == 1 {
        return;
    }
    // The direction of the reflection for a row of length one; its first entry does not cancel.
    let mut v: Vec<f64> = (0..width).map(|j| array[(i, column + j)] / length).collect();
    let of_v: Vec<f64> = (0..width).map(|j| terms[(i, column + j)] / length).collect();
    let sign = if v[0] < 0.0 { -1.0 } else { 1.0 };
    let scale = 1.0 + v[0].abs();
    v[0] += sign;
    for k in i + 1..array.nrows() {
        let along: f64 = (0..width).map(|j| array[(k, column + j)] * v[j]).sum::<f64>() / scale;
        // What the terms of the row and those of v make of it.
        let of_along: f64 = (0..width)
            .map(|j| terms[(k, column + j)] * v[j].abs() + array[(k, column + j)].abs() * of_v[j])
            .sum::<f64>()
            / scale;
        for j in 0..width {
            let place = (k, column + j);
            terms[place] += of_along * v[j].abs() + along.abs() * of_v[j];
            array[place] = rounded_off(array[place] - along * v[j], terms[place].min(most[k]), width + 1);
        }
    }
    array[(i, column)] = -sign * length;
    for j in 1..width {
        array[(i, column + j)] = 0.0;
    }
}
