//! Rank, determinant, kernel, solutions and factors, against minors.

use exact_kalman::matrix::{Echelon, Matrix, SolveError};
use exact_kalman::scalar::Field;

use crate::minors::{adjugate, determinant, rank};
use crate::worlds::{classes, integers, matrices, residues, signs};

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
    // Each row is (1, 0, 2), turned by one place.
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

/// How many m×n matrices of rank r there are over q elements: `∏ (qᵐ − qⁱ)(qⁿ − qⁱ)/(qʳ − qⁱ)`, i below r.
fn number_of_rank(q: u64, rows: usize, columns: usize) -> Vec<usize> {
    let power = |exponent: usize| (0..exponent).fold(1, |power: u64, _| power * q);
    let number = |r: usize| {
        let product = |size: usize| (0..r).map(|i| power(size) - power(i)).product::<u64>();
        usize::try_from(product(rows) * product(columns) / product(r)).unwrap_or(usize::MAX)
    };
    (0..=rows.min(columns)).map(number).collect()
}

/// HV-L3, its hypothesis: P = UV with factors of full rank, and the rank, the kernel, the echelon, the determinant, the inverse
/// and solutions; against minors, and against the numbers of matrices of each rank that are known.
///
/// Domain: all 2×2 matrices modulo 2, 3, 5, 7, all 2×3 and 3×2 ones modulo 3 and 5, all 3×3 ones modulo 2 and 3.
#[test]
fn eliminations_over_fields_meet_every_rank_as_often_as_they_should() {
    let mut count = 0;
    let mut check = |counts: Vec<usize>, expected: Vec<usize>| {
        assert_eq!(counts, expected);
        count += counts.iter().sum::<usize>();
    };
    check(census(2, 2, &residues::<2>()), number_of_rank(2, 2, 2));
    check(census(2, 2, &residues::<3>()), number_of_rank(3, 2, 2));
    check(census(2, 2, &residues::<5>()), number_of_rank(5, 2, 2));
    check(census(2, 2, &residues::<7>()), number_of_rank(7, 2, 2));
    for (rows, columns) in [(2, 3), (3, 2)] {
        check(census(rows, columns, &residues::<3>()), number_of_rank(3, rows, columns));
        check(census(rows, columns, &residues::<5>()), number_of_rank(5, rows, columns));
    }
    check(census(3, 3, &residues::<2>()), number_of_rank(2, 3, 3));
    check(census(3, 3, &residues::<3>()), number_of_rank(3, 3, 3));
    assert_eq!(count, 16 + 81 + 625 + 2401 + 2 * (729 + 15_625) + 512 + 19_683);
}

/// HV-L3, its hypothesis: as over fields, on small integers.
///
/// Domain: all 2×2, 2×3 and 3×2 matrices over {−2, …, 2}, all 3×3 ones over {−1, 0, 1}.
#[test]
fn eliminations_over_the_rationals() {
    let mut counts = [0; 4];
    let worlds = [(2, 2, 2), (2, 3, 2), (3, 2, 2), (3, 3, 1)];
    for (rows, columns, bound) in worlds {
        for (rank, count) in census(rows, columns, &integers(bound)).into_iter().enumerate() {
            counts[rank] += count;
        }
    }
    assert_eq!(counts.iter().sum::<usize>(), 625 + 2 * 15_625 + 19_683);
    assert!(counts[0] == 4 && counts[1] > 1000 && counts[2] > 30_000 && counts[3] > 8000, "{counts:?}");
}

/// How many matrices of each rank a world has, of which one of each class is looked at.
fn census_of_classes<S: Field>(rows: usize, columns: usize, entries: &[S]) -> Vec<usize> {
    let mut counts = vec![0; rows.min(columns) + 1];
    for (a, count) in classes(rows, columns, entries) {
        counts[checked(&a)] += count;
    }
    counts
}

/// HV-L3, its hypothesis: as above.
///
/// Domain: all 3×3 matrices over {−2, …, 2} and modulo 5, one for those that differ in the order and the signs of their rows alone.
#[test]
fn eliminations_of_order_three() {
    assert_eq!(census_of_classes(3, 3, &integers(2)).iter().sum::<usize>(), 1_953_125);
    assert_eq!(census_of_classes(3, 3, &residues::<5>()), number_of_rank(5, 3, 3));
}

#[test]
fn numbers_of_matrices_by_hand() {
    // 168 = (8 − 1)(8 − 2)(8 − 4) regular ones.
    assert_eq!(number_of_rank(2, 3, 3), [1, 49, 294, 168]);
    // (q² − 1)(q² − q) regular 2×2 ones.
    assert_eq!(number_of_rank(5, 2, 2), [1, 144, 480]);
    // A 2×k matrix of signs of rank 1 has rows that are multiples of each other by 0, 1 or −1.
    assert_eq!(census(2, 3, &signs()), [1, 104, 624]);
}
