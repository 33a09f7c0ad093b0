//! Matrices of fixed-point numbers: integers over 2^places. Nothing that is proved depends on them.

use num_bigint::BigInt;
use num_traits::{One, Zero};
use rayon::prelude::*;

use crate::matrix::Matrix;
use crate::scalar::Rational;

/// Rows, each of the same length.
pub(super) type Rows = Vec<Vec<BigInt>>;

/// Below so many products, threads cost more than they gain.
const FEW: usize = 4096;

/// A fraction times 2^(places + more).
pub(super) fn fixed(value: &Rational, places: u64, more: i64) -> BigInt {
    let shift = i64::try_from(places).unwrap_or(i64::MAX).saturating_add(more);
    if shift >= 0 {
        (value.numer() << shift) / value.denom()
    } else {
        value.numer() / (value.denom() << shift.unsigned_abs())
    }
}

/// The rows of a matrix whose coordinates are in units: `2^(right[j] − left[i]) entry(i, j)`.
pub(super) fn in_units(matrix: &Matrix<Rational>, left: &[i64], right: &[i64], places: u64) -> Rows {
    let row = |i: usize| {
        (0..matrix.columns()).map(|j| fixed(&matrix[(i, j)], places, right[j] - left[i])).collect::<Vec<_>>()
    };
    (0..matrix.rows()).map(row).collect()
}

pub(super) fn identity(n: usize, places: u64) -> Rows {
    let entry = |i, j| if i == j { BigInt::one() << places } else { BigInt::zero() };
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

pub(super) fn transposed(rows: &Rows, columns: usize) -> Rows {
    (0..columns).map(|j| rows.iter().map(|row| row[j].clone()).collect()).collect()
}

fn inner(one: &[BigInt], other: &[BigInt]) -> BigInt {
    one.iter().zip(other).fold(BigInt::zero(), |sum, (a, b)| if a.is_zero() || b.is_zero() { sum } else { sum + a * b })
}

/// `left · rightᵀ`
pub(super) fn times_transposed(left: &Rows, right: &Rows, places: u64) -> Rows {
    let row = |row: &Vec<BigInt>| right.iter().map(|other| inner(row, other) >> places).collect::<Vec<_>>();
    if left.len() * right.len() * right.first().map_or(0, Vec::len) < FEW {
        left.iter().map(row).collect()
    } else {
        left.par_iter().map(row).collect()
    }
}

/// `left · right`, which has so many columns.
pub(super) fn times(left: &Rows, right: &Rows, columns: usize, places: u64) -> Rows {
    times_transposed(left, &transposed(right, columns), places)
}

/// `left · rightᵀ` where that is symmetric: the lower triangle is computed.
pub(super) fn symmetric_product(left: &Rows, right: &Rows, places: u64) -> Rows {
    let row = |i: usize| (0..=i).map(|j| inner(&left[i], &right[j]) >> places).collect::<Vec<_>>();
    let lower: Rows = if left.len() * left.len() * right.first().map_or(0, Vec::len) < FEW {
        (0..left.len()).map(row).collect()
    } else {
        (0..left.len()).into_par_iter().map(row).collect()
    };
    let n = left.len();
    (0..n).map(|i| (0..n).map(|j| lower[i.max(j)][i.min(j)].clone()).collect()).collect()
}

pub(super) fn plus(left: &Rows, right: &Rows) -> Rows {
    left.iter().zip(right).map(|(a, b)| a.iter().zip(b).map(|(a, b)| a + b).collect()).collect()
}

pub(super) fn minus(left: &Rows, right: &Rows) -> Rows {
    left.iter().zip(right).map(|(a, b)| a.iter().zip(b).map(|(a, b)| a - b).collect()).collect()
}

/// The bits of the largest integer.
pub(super) fn most_bits(rows: &Rows) -> u64 {
    rows.iter().flatten().map(BigInt::bits).max().unwrap_or(0)
}

/// The columns x with `matrix · x = right`, by elimination with the largest pivot of a column; nothing if one has no more than so
/// many bits.
pub(super) fn solved(matrix: &Rows, right: &Rows, places: u64, least: u64) -> Option<Rows> {
    let n = matrix.len();
    let columns = right.first().map_or(0, Vec::len);
    let mut rows: Rows = matrix.iter().zip(right).map(|(a, b)| a.iter().chain(b).cloned().collect()).collect();
    let one = BigInt::one() << (2 * places);
    let mut inverses = Vec::with_capacity(n);
    for j in 0..n {
        let pivot = (j..n).max_by_key(|&i| rows[i][j].magnitude().clone())?;
        rows.swap(j, pivot);
        if rows[j][j].bits() <= least {
            return None;
        }
        let inverse = &one / &rows[j][j];
        let (above, below) = rows.split_at_mut(j + 1);
        let own = &above[j];
        let eliminate = |row: &mut Vec<BigInt>| {
            let factor = (&row[j] * &inverse) >> places;
            if !factor.is_zero() {
                for (entry, other) in row.iter_mut().zip(own).skip(j + 1) {
                    *entry -= (&factor * other) >> places;
                }
            }
        };
        if below.len() * (n + columns) < FEW {
            below.iter_mut().for_each(eliminate);
        } else {
            below.par_iter_mut().for_each(eliminate);
        }
        inverses.push(inverse);
    }
    // Each column on its own, from below.
    let column = |c: usize| {
        let mut x = vec![BigInt::zero(); n];
        for j in (0..n).rev() {
            let taken = inner(&rows[j][j + 1..n], &x[j + 1..]) >> places;
            x[j] = ((&rows[j][n + c] - taken) * &inverses[j]) >> places;
        }
        x
    };
    let all: Rows = if n * n * columns < FEW {
        (0..columns).map(column).collect()
    } else {
        (0..columns).into_par_iter().map(column).collect()
    };
    Some(transposed(&all, n))
}
