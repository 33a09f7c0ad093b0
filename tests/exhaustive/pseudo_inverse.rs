//! HV-L3 and CKS-L3-pinv against explicit formulas and enumeration; the pseudo-determinant against minors.

use exact_kalman::matrix::{Matrix, PseudoInverseError};
use exact_kalman::scalar::{Field, OrderedField, Rational, Residue, Scalar, ratio};

use crate::minors::{adjugate, determinant, principal, rank};
use crate::worlds::{matrices, residues, signs};

/// Which of the four equations of Penrose hold.
fn penrose<S: Field>(p: &Matrix<S>, x: &Matrix<S>) -> bool {
    p * x * p == *p && x * p * x == *x && (p * x).asymmetry().is_none() && (x * p).asymmetry().is_none()
}

/// The inverse by the adjugate.
fn inverse<S: Field>(a: &Matrix<S>) -> Matrix<S> {
    let determinant = determinant(a);
    adjugate(a).map(|entry| entry.over(&determinant).unwrap_or_else(|_| panic!("{a:?} is singular")))
}

/// The pseudo-inverse of a matrix with at most two rows or columns, by a formula for each rank.
fn explicit<S: OrderedField>(p: &Matrix<S>) -> Matrix<S> {
    let transposed = p.transpose();
    match rank(p) {
        0 => transposed,
        1 => {
            let squares = p.entries().iter().fold(S::zero(), |sum, entry| sum.plus(&entry.times(entry)));
            transposed.map(|entry| entry.over(&squares).unwrap_or_else(|_| panic!("{p:?} is not zero")))
        }
        r if r == p.rows() => &transposed * inverse(&(p * &transposed)),
        r => {
            assert_eq!(r, p.columns(), "a formula is missing");
            inverse(&(&transposed * p)) * transposed
        }
    }
}

#[test]
fn over_the_rationals_it_always_exists() {
    let mut counts = [0; 3];
    for (rows, columns) in [(2, 2), (2, 3), (3, 2)] {
        for p in matrices(rows, columns, &signs()) {
            let x = p.pseudo_inverse().unwrap_or_else(|error| panic!("{p}: {error}"));
            assert!(penrose(&p, &x), "{p} and {x}");
            assert_eq!(x, explicit(&p));
            assert_eq!(x.pseudo_inverse().as_ref(), Ok(&p));
            counts[rank(&p)] += 1;
        }
    }
    assert_eq!(counts, [3, 32 + 104 + 104, 48 + 624 + 624]);
}

/// CKS-L3-pinv, HV-L3: all 3×3 matrices of signs: the four equations, which have one solution at most.
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

/// All X are tried for every P: one obeys Penrose where the crate finds it, none where it finds none.
fn enumerated<const Q: u64>() -> [usize; 2] {
    let world: Vec<Matrix<Residue<Q>>> = matrices(2, 2, &residues::<Q>()).collect();
    let mut counts = [0; 2];
    for p in &world {
        let solutions: Vec<_> = world.iter().filter(|x| penrose(p, x)).collect();
        match p.pseudo_inverse() {
            Ok(x) => assert_eq!(solutions, [&x], "{p:?}"),
            Err(PseudoInverseError::DoesNotExist { .. }) => assert!(solutions.is_empty(), "{p:?} has {solutions:?}"),
            Err(error) => panic!("{p:?}: {error}"),
        }
        counts[solutions.len()] += 1;
    }
    counts
}

/// None exists for 4 of 16 matrices modulo 2, for none modulo 3, where no vector is orthogonal to itself.
#[test]
fn over_small_fields_it_is_the_only_one_or_there_is_none() {
    let [none, one] = enumerated::<2>();
    assert_eq!(none + one, 16);
    assert!(none > 0 && one > none);
    assert_eq!(enumerated::<3>(), [0, 81]);
    let [none, one] = enumerated::<5>();
    assert_eq!(none + one, 625);
    assert!(none > 0 && one > none);
}

/// It exists over a field iff P, PPᵀ and PᵀP have the same rank.
#[test]
fn three_by_three_modulo_two_exists_iff_ranks_agree() {
    let mut counts = [0; 2];
    for p in matrices(3, 3, &residues::<2>()) {
        let exists = [&p * p.transpose(), p.transpose() * &p].iter().all(|gram| rank(gram) == rank(&p));
        let found = p.pseudo_inverse();
        assert_eq!(found.is_ok(), exists, "{p:?}");
        assert!(found.is_ok_and(|x| penrose(&p, &x)) == exists);
        counts[usize::from(exists)] += 1;
    }
    assert_eq!(counts[0] + counts[1], 512);
    assert!(counts.iter().all(|&count| count > 100), "{counts:?}");
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

/// CKS-L3-pinv: of all X with PXP = P the one with X = UPᵀ = PᵀV, for all 2×2 matrices P and X of small numbers; the
/// first condition alone has other solutions.
#[test]
fn two_conditions_determine_it() {
    // X = UPᵀ if the rows of X lie in the row space of Pᵀ, X = PᵀV if its columns lie in the column space.
    let has_both = |x: &Matrix<Rational>, p: &Matrix<Rational>| {
        let t = p.transpose();
        t.above(x).rank() == t.rank() && t.beside(x).rank() == t.rank()
    };
    let (mut met, mut first_only) = (0, 0);
    for p in matrices(2, 2, &signs()) {
        let known = p.pseudo_inverse().unwrap_or_else(|error| panic!("{error}"));
        assert!(&p * &known * &p == p && has_both(&known, &p), "{p}");
        for x in matrices(2, 2, &[-2, -1, 0, 1, 2].map(|twice| ratio(twice, 2))) {
            if &p * &x * &p == p {
                assert_eq!(has_both(&x, &p), x == known, "{p} {x}");
                met += usize::from(x == known);
                first_only += usize::from(x != known);
            }
        }
    }
    assert!(met > 40 && first_only > 40, "{met} {first_only}");
    let (p, x) = (Matrix::from_integers(&[[1, 0], [0, 0]]), Matrix::<Rational>::from_integers(&[[1, 1], [1, 5]]));
    assert!(&p * &x * &p == p && !has_both(&x, &p));
}
