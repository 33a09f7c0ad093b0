//! The matrices of a small world, one after the other.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, Residue, Scalar, ratio};

use crate::minors::is_semidefinite;

/// −1, 0 and 1.
pub fn signs() -> Vec<Rational> {
    vec![ratio(-1, 1), ratio(0, 1), ratio(1, 1)]
}

/// The integers up to a bound, with both signs.
pub fn integers(bound: i64) -> Vec<Rational> {
    (-bound..=bound).map(|entry| ratio(entry, 1)).collect()
}

/// The positive semidefinite matrices of an order with integer entries up to a bound.
pub fn covariances(n: usize, bound: i64) -> Vec<Matrix<Rational>> {
    symmetric(n, &integers(bound)).filter(is_semidefinite).collect()
}

/// Every residue.
pub fn residues<const P: u64>() -> Vec<Residue<P>> {
    (0..P).map(Residue::new).collect()
}

/// Every sequence of the given length.
fn sequences<S: Scalar>(length: usize, entries: &[S]) -> impl Iterator<Item = Vec<S>> {
    let count = (0..length).fold(1, |count, _| count * entries.len());
    (0..count).map(move |code| {
        let digit = |(rest, mut taken): (usize, Vec<S>), _| {
            taken.push(entries[rest % entries.len()].clone());
            (rest / entries.len(), taken)
        };
        (0..length).fold((code, Vec::with_capacity(length)), digit).1
    })
}

/// Every matrix with these entries.
pub fn matrices<S: Scalar>(rows: usize, columns: usize, entries: &[S]) -> impl Iterator<Item = Matrix<S>> {
    sequences(rows * columns, entries)
        .map(move |sequence| Matrix::from_fn(rows, columns, |i, j| sequence[i * columns + j].clone()))
}

/// Every symmetric matrix with these entries.
pub fn symmetric<S: Scalar>(n: usize, entries: &[S]) -> impl Iterator<Item = Matrix<S>> {
    // The place of (i, j), j ≤ i, in the lower triangle read row by row.
    let place = |i: usize, j: usize| i * (i + 1) / 2 + j;
    sequences(n * (n + 1) / 2, entries)
        .map(move |sequence| Matrix::from_fn(n, n, |i, j| sequence[place(i.max(j), i.min(j))].clone()))
}

#[test]
fn worlds_have_no_repetition() {
    use std::collections::HashSet;
    assert_eq!(matrices(2, 2, &signs()).collect::<HashSet<_>>().len(), 81);
    assert_eq!(symmetric(3, &signs()).collect::<HashSet<_>>().len(), 729);
    assert!(symmetric(3, &signs()).all(|matrix| matrix == matrix.transpose()));
}
