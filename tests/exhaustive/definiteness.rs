//! LDLᵀ and the Loewner order against the signs of all principal minors.

use exact_kalman::matrix::{LdlError, Matrix};
use exact_kalman::scalar::{Rational, Scalar, ratio};

use crate::minors::{is_semidefinite, rank};
use crate::worlds::{integers, matrices, signs, symmetric};

/// Positive semidefinite: all roots of the characteristic polynomial are real, and none is negative iff the signs of its
/// coefficients alternate (Descartes).
fn has_alternating_signs(p: &Matrix<Rational>) -> bool {
    let zero = ratio(0, 1);
    let coefficients = p.characteristic_polynomial().into_iter().rev().enumerate();
    coefficients
        .into_iter()
        .all(|(place, coefficient)| if place % 2 == 0 { coefficient >= zero } else { coefficient <= zero })
}

/// vᵀPv, term by term.
fn value(p: &Matrix<Rational>, v: &Matrix<Rational>) -> Rational {
    let terms = (0..p.rows()).flat_map(|i| (0..p.rows()).map(move |j| (i, j)));
    terms.fold(ratio(0, 1), |sum, (i, j)| sum + &v[(i, 0)] * &p[(i, j)] * &v[(j, 0)])
}

/// Checks one symmetric matrix; whether it is positive semidefinite.
fn checked(p: &Matrix<Rational>) -> bool {
    assert_eq!(is_semidefinite(p), has_alternating_signs(p), "{p}");
    match p.ldl() {
        Ok(ldl) => {
            assert!(is_semidefinite(p), "{p} is not positive semidefinite");
            let n = p.rows();
            assert_eq!(ldl.lower.congruence(&Matrix::diagonal(&ldl.pivots)), *p);
            for (i, j) in (0..n).flat_map(|i| (i..n).map(move |j| (i, j))) {
                assert_eq!(ldl.lower[(i, j)], ratio(i64::from(i == j), 1), "L of {p} is unit lower triangular");
            }
            assert!(ldl.pivots.iter().all(|pivot| *pivot >= ratio(0, 1)));
            assert_eq!(ldl.rank(), rank(p));
            assert_eq!(ldl.is_positive_definite(), rank(p) == n);
            true
        }
        Err(LdlError::Indefinite(proof)) => {
            assert!(!is_semidefinite(p), "{p} is positive semidefinite");
            assert_eq!((proof.witness.rows(), proof.witness.columns()), (p.rows(), 1));
            assert_eq!(value(p, &proof.witness), proof.value);
            assert!(proof.value < ratio(0, 1), "{p}: {proof:?}");
            false
        }
        Err(LdlError::Asymmetric { .. }) => panic!("{p} is symmetric"),
    }
}

/// AK-Order, for G = 0: F ≥ 0 iff all principal minors are, iff the characteristic polynomial alternates; else a vector v with
/// vᵀFv < 0. Where it is, LDLᵀ = F with as many pivots as the rank.
///
/// Domain: all symmetric matrices of order 1, 2 and 3 over {−2, …, 2} and of order 4 over {−1, 0, 1}.
#[test]
fn verdicts_on_all_small_symmetric_matrices() {
    let mut counts = [0; 2];
    for (n, bound) in [(1, 2), (2, 2), (3, 2), (4, 1)] {
        for p in symmetric(n, &integers(bound)) {
            counts[usize::from(checked(&p))] += 1;
        }
    }
    assert_eq!(counts[0] + counts[1], 5 + 125 + 15_625 + 59_049);
    assert!(counts[1] > 300, "{counts:?}");
}

/// L Lᵀ for all L of one or two columns of signs, and what is below them.
#[test]
fn verdicts_on_gram_matrices_and_just_below() {
    let mut counts = [0; 2];
    for columns in 1..=2 {
        for factor in matrices(3, columns, &signs()) {
            let p = &factor * factor.transpose();
            assert!(checked(&p));
            counts[1] += 1;
            // Singular, as L has fewer columns than rows: often outside if an entry of the diagonal is less.
            let mut below = p;
            below[(1, 1)] = below[(1, 1)].minus(&ratio(1, 3));
            counts[0] += usize::from(!checked(&below));
        }
    }
    assert_eq!(counts[1], 27 + 729);
    assert!(counts[0] > 400, "{counts:?}");
}

#[test]
fn asymmetry_is_found_where_it_is() {
    let mut count = 0;
    for p in matrices(3, 3, &signs()) {
        let differs = |i: usize, j: usize| p[(i, j)] != p[(j, i)];
        if let Some((row, column)) = [(0, 1), (0, 2), (1, 2)].into_iter().find(|&(i, j)| differs(i, j)) {
            assert_eq!(p.ldl(), Err(LdlError::Asymmetric { row, column }));
            count += 1;
        }
    }
    assert_eq!(count, 19_683 - 729);
}

/// AK-Order: F ≥ G iff all principal minors of F − G are nonnegative, else some vᵀ(F − G)v < 0; it is antisymmetric.
///
/// Domain: all pairs of symmetric 2×2 matrices over {−2, …, 2}.
#[test]
fn loewner_order_is_that_of_the_difference() {
    let world: Vec<_> = symmetric(2, &integers(2)).collect();
    let mut counts = [0; 2];
    for a in &world {
        for b in &world {
            let verdict = a.loewner_le(b);
            let below = verdict.is_ok();
            assert_eq!(below, is_semidefinite(&(b - a)), "{a} and {b}");
            if let Err(error) = verdict {
                let LdlError::Indefinite(proof) = error else { panic!("{a} and {b} are symmetric") };
                assert!(value(&(b - a), &proof.witness) < ratio(0, 1), "{a} and {b}: {proof:?}");
            }
            assert!(!(below && b.loewner_le(a).is_ok()) || a == b, "the order is antisymmetric");
            counts[usize::from(below)] += 1;
        }
    }
    assert_eq!(counts[0] + counts[1], 125 * 125);
    assert!(counts[1] > 100, "{counts:?}");
}
