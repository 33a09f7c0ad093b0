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
fn sequences<S: Clone>(length: usize, entries: &[S]) -> impl Iterator<Item = Vec<S>> {
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

/// One matrix for all that differ in the order and the signs of their rows alone, and how many these are; the entries are closed
/// under negation.
pub fn classes<S: Scalar + PartialEq>(rows: usize, columns: usize, entries: &[S]) -> Vec<(Matrix<S>, usize)> {
    let all: Vec<Vec<S>> = sequences(columns, entries).collect();
    let place = |row: &Vec<S>| all.iter().position(|other| other == row);
    let negated = |row: &Vec<S>| row.iter().map(|entry| S::zero().minus(entry)).collect();
    // One of each row and its negative, and whether these are two.
    let half = (0..all.len()).filter_map(|k| {
        let other = place(&negated(&all[k])).unwrap_or_else(|| panic!("no negative"));
        (k <= other).then_some((k, 1 + usize::from(k < other)))
    });
    let half: Vec<(usize, usize)> = half.collect();
    let ordered = sequences(rows, &half).filter(|chosen| chosen.is_sorted());
    let class = |chosen: Vec<(usize, usize)>| {
        // n!/∏ kᵢ!, one factor for each row: its number over how often it was there.
        let orders = (0..rows).fold(1, |orders, i| {
            let same = chosen[..=i].iter().filter(|row| **row == chosen[i]).count();
            orders * (i + 1) / same
        });
        let signs: usize = chosen.iter().map(|(_, count)| count).product();
        (Matrix::from_fn(rows, columns, |i, j| all[chosen[i].0][j].clone()), orders * signs)
    };
    ordered.map(class).collect()
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

/// Each matrix is some rows of one class, in some order and with some signs, and each class has as many as it says.
#[test]
fn classes_cover_their_world() {
    use std::collections::HashMap;
    let sorted = |matrix: &Matrix<Rational>| {
        let rows = (0..matrix.rows()).map(|i| {
            let row: Vec<Rational> = (0..matrix.columns()).map(|j| matrix[(i, j)].clone()).collect();
            let negated = row.iter().map(|entry| -entry).collect();
            row.max(negated)
        });
        let mut rows: Vec<_> = rows.collect();
        rows.sort();
        rows
    };
    for (rows, columns) in [(1, 2), (2, 2), (3, 2)] {
        let mut counts = HashMap::new();
        for matrix in matrices(rows, columns, &integers(2)) {
            *counts.entry(sorted(&matrix)).or_insert(0) += 1;
        }
        let found = classes(rows, columns, &integers(2));
        assert_eq!(found.len(), counts.len());
        for (matrix, count) in found {
            assert_eq!(counts.remove(&sorted(&matrix)), Some(count), "{matrix}");
        }
    }
}
