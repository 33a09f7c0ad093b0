//! Rank, determinant, kernel, solutions and factors, against minors.

use exact_kalman::matrix::{Echelon, Matrix, SolveError};
use exact_kalman::scalar::Field;

use crate::minors::{adjugate, determinant, rank};
use crate::worlds::{matrices, residues, signs};

/// Checks one matrix; its rank.
fn checked<S: Field>(a: &Matrix<S>) -> usize {
    let (rows, columns, r) = (a.rows(), a.columns(), rank(a));
    assert_eq!(a.rank(), r, "{a:?}");
    let kernel = a.kernel();
    assert!((a * &kernel).is_zero(), "{a:?}");
    assert_eq!((kernel.rows(), kernel.columns(), rank(&kernel)), (columns, columns - r, columns - r), "{a:?}");

    let factors = a.full_rank_factorisation().unwrap_or_else(|error| panic!("a field decides: {error}"));
    assert_eq!(&factors.left * &factors.right, *a);
    assert_eq!((factors.left.columns(), factors.right.rows()), (r, r));
    assert_eq!((rank(&factors.left), rank(&factors.right)), (r, r), "{a:?}");

    let echelon = Echelon::of(a, columns).unwrap_or_else(|error| panic!("a field decides: {error}"));
    let pivots = echelon.pivots();
    assert!(pivots.is_sorted_by(|left, right| left < right) && pivots.len() == r);
    let reduced = echelon.reduced().unwrap_or_else(|error| panic!("a field decides: {error}"));
    assert_eq!(reduced.select_columns(pivots), Matrix::identity(r), "{a:?}");
    // The rows span the rows of A: stacked below A they add no rank.
    assert_eq!(rank(&a.above(&reduced)), r);
    // The columns before a pivot depend on the earlier pivots alone: the echelon's stairs.
    for (row, &pivot) in pivots.iter().enumerate() {
        assert!(reduced.block(row..row + 1, 0..pivot).is_zero(), "{a:?}");
    }
    if rows == columns {
        square(a, r);
    }
    r
}

/// Determinant, inverse and solutions.
fn square<S: Field>(a: &Matrix<S>, r: usize) {
    let n = a.rows();
    let expected = determinant(a);
    assert_eq!(a.determinant(), Ok(expected.clone()), "{a:?}");
    // Right sides with a zero, a repetition and a sum.
    let right = Matrix::from_fn(n, 3, |i, j| S::from_integer([1, 0, 2][(i + j) % 3]));
    if r < n {
        let singular = SolveError::Singular { rank: r, order: n };
        assert_eq!((a.inverse(), a.solve(&right)), (Err(singular), Err(singular)), "{a:?}");
        return;
    }
    let (Ok(inverse), Ok(solution)) = (a.inverse(), a.solve(&right)) else { panic!("{a:?} is regular") };
    assert_eq!(inverse.scaled(&expected), adjugate(a));
    assert_eq!(solution.scaled(&expected), adjugate(a) * &right);
    assert_eq!(a * solution, right);
}

/// How many matrices of each rank a world has.
fn census<S: Field>(rows: usize, columns: usize, entries: &[S]) -> Vec<usize> {
    let mut counts = vec![0; rows.min(columns) + 1];
    for a in matrices(rows, columns, entries) {
        counts[checked(&a)] += 1;
    }
    counts
}

/// Over a field of q elements there are known numbers of matrices of each rank: (q² − 1)(q² − q) regular 2×2 ones.
#[test]
fn all_two_by_two_over_small_fields() {
    assert_eq!(census(2, 2, &residues::<2>()), [1, 9, 6]);
    assert_eq!(census(2, 2, &residues::<3>()), [1, 32, 48]);
    assert_eq!(census(2, 2, &residues::<5>()), [1, 144, 480]);
}

/// 168 = (8 − 1)(8 − 2)(8 − 4) regular ones.
#[test]
fn all_three_by_three_modulo_two() {
    assert_eq!(census(3, 3, &residues::<2>()), [1, 49, 294, 168]);
}

#[test]
fn all_small_matrices_of_signs() {
    // A 2×k matrix of rank 1 has rows that are multiples of each other by 0, 1 or −1.
    assert_eq!(census(2, 2, &signs()), [1, 32, 48]);
    assert_eq!(census(2, 3, &signs()), [1, 104, 624]);
    assert_eq!(census(3, 2, &signs()), [1, 104, 624]);
}

#[test]
fn all_three_by_three_of_signs() {
    let counts = census(3, 3, &signs());
    assert_eq!(counts.iter().sum::<usize>(), 19_683);
    assert_eq!((counts[0], counts[1]), (1, 338));
}
