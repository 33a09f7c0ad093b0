//! HV-L3 and CKS-L3-pinv against explicit formulas and enumeration; the pseudo-determinant against minors.

use exact_kalman::matrix::{Matrix, PseudoInverseError};
use exact_kalman::scalar::{Field, Rational, Residue, Scalar, ratio};

use crate::minors::{principal, pseudo_inverse, rank};
use crate::worlds::{classes, integers, matrices, residues, signs};

/// Whether the four equations of Penrose hold.
fn penrose<S: Field>(p: &Matrix<S>, x: &Matrix<S>) -> bool {
    p * x * p == *p && x * p * x == *x && (p * x).asymmetry().is_none() && (x * p).asymmetry().is_none()
}

/// HV-L3, CKS-L3-pinv: it exists, obeys the four equations, is what a formula for each rank says, and P is its pseudo-inverse.
///
/// Domain: all 2×2, 2×3 and 3×2 matrices over {−2, …, 2}.
#[test]
fn over_the_rationals_it_always_exists() {
    let mut counts = [0; 3];
    for (rows, columns) in [(2, 2), (2, 3), (3, 2)] {
        for p in matrices(rows, columns, &integers(2)) {
            let x = p.pseudo_inverse().unwrap_or_else(|error| panic!("{p}: {error}"));
            assert!(penrose(&p, &x), "{p} and {x}");
            assert_eq!(x, pseudo_inverse(&p));
            assert_eq!(x.pseudo_inverse().as_ref(), Ok(&p));
            counts[rank(&p)] += 1;
        }
    }
    assert_eq!(counts.iter().sum::<usize>(), 625 + 2 * 15_625);
    assert!(counts[0] == 3 && counts[1] > 500, "{counts:?}");
}

/// CKS-L3-pinv, HV-L3: the four equations, which have one solution at most.
///
/// Domain: all 3×3 matrices over {−1, 0, 1}.
#[test]
fn three_by_three_obeys_penrose() {
    let mut count = 0;
    for p in matrices(3, 3, &signs()) {
        let x = p.pseudo_inverse().unwrap_or_else(|error| panic!("{p}: {error}"));
        assert!(penrose(&p, &x), "{p} and {x}");
        count += 1;
    }
    assert_eq!(count, 19_683);
}

/// Whether there is one: rank P = rank PPᵀ = rank PᵀP, by minors.
fn exists<S: Field>(p: &Matrix<S>) -> bool {
    [p * p.transpose(), p.transpose() * p].iter().all(|gram| rank(gram) == rank(p))
}

/// All X are tried for every m×n matrix P: one obeys Penrose where the crate finds it, none where it finds none. How many
/// have none, and one.
fn enumerated<const Q: u64>(rows: usize, columns: usize) -> [usize; 2] {
    let candidates: Vec<Matrix<Residue<Q>>> = matrices(columns, rows, &residues::<Q>()).collect();
    let mut counts = [0; 2];
    for p in matrices(rows, columns, &residues::<Q>()) {
        let solutions: Vec<_> = candidates.iter().filter(|x| penrose(&p, x)).collect();
        match p.pseudo_inverse() {
            Ok(x) => assert_eq!(solutions, [&x], "{p:?}"),
            Err(PseudoInverseError::DoesNotExist { .. }) => assert!(solutions.is_empty(), "{p:?} has {solutions:?}"),
            Err(error) => panic!("{p:?}: {error}"),
        }
        assert_eq!(solutions.len(), usize::from(exists(&p)), "{p:?}");
        counts[solutions.len()] += 1;
    }
    counts
}

/// HV-L3, CKS-L3-pinv over fields: every X is tried for every P. There is one that obeys the four equations iff
/// rank P = rank PPᵀ = rank PᵀP, then only one, and it is the one that is found.
///
/// Domain: all pairs P, X of 2×2 matrices modulo 2, 3, 5 and 7, of 2×3 and 3×2 matrices modulo 2 and 3.
#[test]
fn over_small_fields_it_is_the_only_one_or_there_is_none() {
    // Modulo 2 of rank 1 are uvᵀ with u, v ≠ 0, and (1, 1) is orthogonal to itself: 3 + 3 − 1 have none. Modulo 3 and 7 no vector of two entries is orthogonal to itself.
    assert_eq!(enumerated::<2>(2, 2), [5, 11]);
    assert_eq!(enumerated::<3>(2, 2), [0, 81]);
    // Modulo 5 two of the six lines are, (1, 2) and (1, 3): 4 (6² − 4²).
    assert_eq!(enumerated::<5>(2, 2), [80, 545]);
    assert_eq!(enumerated::<7>(2, 2), [0, 2401]);
    for (rows, columns) in [(2, 3), (3, 2)] {
        let [none, one] = enumerated::<2>(rows, columns);
        assert!(none + one == 64 && none > 20 && one > 20, "{none} {one}");
        let [none, one] = enumerated::<3>(rows, columns);
        assert!(none + one == 729 && none > 100 && one > 100, "{none} {one}");
    }
}

/// How many matrices have none, and one: it exists iff the ranks agree, obeys the four equations, and P is its pseudo-inverse.
fn by_ranks<const Q: u64>(rows: usize, columns: usize) -> [usize; 2] {
    by_ranks_among(matrices(rows, columns, &residues::<Q>()).map(|p| (p, 1)))
}

/// The same for matrices that stand for so many each.
fn by_ranks_among<S: Field>(world: impl IntoIterator<Item = (Matrix<S>, usize)>) -> [usize; 2] {
    let mut counts = [0; 2];
    for (p, count) in world {
        let (exists, found) = (exists(&p), p.pseudo_inverse());
        assert_eq!(found.is_ok(), exists, "{p:?}");
        if let Ok(x) = found {
            assert!(penrose(&p, &x), "{p:?}");
            assert_eq!(x.pseudo_inverse().as_ref(), Ok(&p));
        }
        counts[usize::from(exists)] += count;
    }
    counts
}

/// HV-L3, CKS-L3-pinv over fields: it exists iff rank P = rank PPᵀ = rank PᵀP, obeys the four equations, and leads back to P.
///
/// Domain: all 2×3 and 3×2 matrices modulo 5, all 3×3 matrices modulo 2 and 3.
#[test]
fn over_fields_it_exists_iff_ranks_agree() {
    let mut count = 0;
    for [none, one] in [by_ranks::<5>(2, 3), by_ranks::<5>(3, 2), by_ranks::<2>(3, 3), by_ranks::<3>(3, 3)] {
        assert!(none > 100 && one > 100, "{none} {one}");
        count += none + one;
    }
    assert_eq!(count, 2 * 15_625 + 512 + 19_683);
}

/// HV-L3, CKS-L3-pinv over fields, larger.
///
/// Domain: all 2×3 matrices modulo 7, all 3×3 matrices modulo 5, one for those that differ in the order and the signs of their rows alone.
#[test]
fn over_larger_fields_it_exists_iff_ranks_agree() {
    let plane = by_ranks_among(classes(2, 3, &residues::<7>()));
    let space = by_ranks_among(classes(3, 3, &residues::<5>()));
    assert_eq!([plane, space].map(|[none, one]| none + one), [117_649, 1_953_125]);
    assert!(plane[0] > 10_000 && space[0] > 100_000, "{plane:?} {space:?}");
}

/// The product of the nonzero eigenvalues is the coefficient of the characteristic polynomial at the rank: the sum of
/// the principal minors of that order.
#[test]
fn pseudo_determinant_is_a_sum_of_minors() {
    let mut counts = [0; 4];
    for n in 1..=3 {
        for p in matrices(n, n, &signs()) {
            let r = rank(&p);
            let expected: Rational = principal(&p, r).iter().fold(Scalar::zero(), |sum, minor| sum.plus(minor));
            assert_eq!(p.pseudo_determinant(), Ok(expected), "{p}");
            counts[r] += 1;
        }
    }
    assert_eq!(counts.iter().sum::<i32>(), 3 + 81 + 19_683);
    assert!(counts[1] > 300 && counts[2] > 1000 && counts[3] > 1000, "{counts:?}");
}

/// CKS-L3-pinv: of all X with PXP = P the one with X = UPᵀ = PᵀV; the first condition alone has other solutions.
///
/// Domain: all 2×2 matrices P over {−1, 0, 1} and X over {−1, −1/2, 0, 1/2, 1}.
#[test]
fn two_conditions_determine_it() {
    // X = UPᵀ if the rows of X lie in the row space of Pᵀ, X = PᵀV if its columns lie in the column space.
    let has_both = |x: &Matrix<Rational>, p: &Matrix<Rational>| {
        let t = p.transpose();
        rank(&t.above(x)) == rank(&t) && rank(&t.beside(x)) == rank(&t)
    };
    let (mut met, mut first_only, mut count) = (0, 0, 0);
    for p in matrices(2, 2, &signs()) {
        let known = p.pseudo_inverse().unwrap_or_else(|error| panic!("{error}"));
        assert!(&p * &known * &p == p && has_both(&known, &p), "{p}");
        for x in matrices(2, 2, &[-2, -1, 0, 1, 2].map(|twice| ratio(twice, 2))) {
            count += 1;
            if &p * &x * &p == p {
                assert_eq!(has_both(&x, &p), x == known, "{p} {x}");
                met += usize::from(x == known);
                first_only += usize::from(x != known);
            }
        }
    }
    assert_eq!(count, 81 * 625);
    assert!(met > 40 && first_only > 40, "{met} {first_only}");
    let (p, x) = (Matrix::from_integers(&[[1, 0], [0, 0]]), Matrix::<Rational>::from_integers(&[[1, 1], [1, 5]]));
    assert!(&p * &x * &p == p && !has_both(&x, &p));
}
