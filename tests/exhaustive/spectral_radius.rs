//! The characteristic polynomial and what it decides, against minors, roots by radicals, and Stein's equation.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, Residue, Scalar, ratio};
use num_bigint::BigInt;

use crate::minors::{determinant, principal};
use crate::worlds::{matrices, residues, signs};

type Q = Matrix<Rational>;

/// det(λI − A) = Σ (−1)ᵏ λⁿ⁻ᵏ · (the sum of the principal minors of order k).
fn by_minors<S: Scalar>(a: &Matrix<S>) -> Vec<S> {
    let coefficient = |k: usize| {
        let sum = principal(a, k).iter().fold(S::zero(), |sum, minor| sum.plus(minor));
        if k.is_multiple_of(2) { sum } else { sum.negated() }
    };
    (0..=a.rows()).rev().map(coefficient).collect()
}

/// The value of the polynomial at a point equals det(λI − A) there.
fn assert_values(a: &Q) {
    let n = a.rows();
    let polynomial = a.characteristic_polynomial();
    for point in (0..).take(n + 1) {
        let point = ratio(point, 1);
        let value = polynomial.iter().rev().fold(ratio(0, 1), |value, coefficient| value * &point + coefficient);
        assert_eq!(value, determinant(&(Matrix::identity(n).scaled(&point) - a)), "{a} at {point}");
    }
}

#[test]
fn characteristic_polynomials_of_all_matrices_of_signs() {
    assert_eq!(Q::zeros(0, 0).characteristic_polynomial(), [ratio(1, 1)]);
    let mut count = 0;
    for n in 1..=3 {
        for a in matrices(n, n, &signs()) {
            assert_eq!(a.characteristic_polynomial(), by_minors(&a));
            count += 1;
        }
    }
    assert_eq!(count, 3 + 81 + 19_683);
    for a in matrices(2, 2, &signs()) {
        // A larger one: A ⊕ A coupled by the identity.
        let coupled = a.beside(&Matrix::identity(2)).above(&Matrix::identity(2).scaled(&ratio(2, 1)).beside(&a));
        assert_values(&coupled);
    }
}

#[test]
fn characteristic_polynomials_need_no_division() {
    for a in matrices(2, 2, &residues::<2>()).chain(matrices(3, 3, &residues::<2>())) {
        assert_eq!(a.characteristic_polynomial(), by_minors(&a));
    }
    for a in matrices(2, 2, &residues::<5>()) {
        assert_eq!(a.characteristic_polynomial(), by_minors(&a));
    }
    let a = Matrix::<BigInt>::from_integers(&[[3, -1, 4], [1, 5, -9], [2, 6, 5]]);
    assert_eq!(a.characteristic_polynomial(), by_minors(&a));
    assert_eq!(Matrix::<Residue<7>>::from_integers(&[[3]]).characteristic_polynomial(), [4, 1].map(Residue::<7>::new));
}

/// Whether both roots of λ² − tλ + d have modulus below 1, by the formula for roots: a complex pair has |λ|² = d; of two real
/// roots the larger modulus is (|t| + √(t² − 4d))/2.
fn by_radicals(a: &Q) -> bool {
    let (zero, two) = (ratio(0, 1), ratio(2, 1));
    let (t, d) = (&a[(0, 0)] + &a[(1, 1)], determinant(a));
    let discriminant = &t * &t - ratio(4, 1) * &d;
    if discriminant < zero {
        return d < ratio(1, 1);
    }
    let room = two - if t < zero { -t } else { t };
    room > zero && discriminant < &room * &room
}

/// AK-A.rho, AK-L4.2: the test of the polynomial, the roots themselves, and a definite solution of Stein's equation give one
/// verdict.
///
/// Domain: all 2×2 matrices over {−2, …, 2}, and their quarters.
#[test]
fn three_routes_to_stability() {
    let entries: Vec<_> = (-2..=2).map(|entry| ratio(entry, 1)).collect();
    let mut counts = [0; 2];
    for scale in [ratio(1, 1), ratio(1, 4)] {
        for a in matrices(2, 2, &entries).map(|a| a.scaled(&scale)) {
            let stable = a.spectral_radius_lt(&ratio(1, 1));
            assert_eq!(stable, by_radicals(&a), "{a}");
            let definite = a
                .stein_solution(&Matrix::identity(2))
                .is_ok_and(|x| (1..=2).all(|k| determinant(&x.block(0..k, 0..k)) > ratio(0, 1)));
            assert_eq!(stable, definite, "{a}");
            // A bound r is 1 after division by r.
            for bound in [ratio(1, 2), ratio(3, 1)] {
                assert_eq!(
                    a.spectral_radius_lt(&bound),
                    by_radicals(&a.scaled(&bound.clone().recip())),
                    "{a}, {bound}"
                );
            }
            counts[usize::from(stable)] += 1;
        }
    }
    assert_eq!(counts[0] + counts[1], 2 * 625);
    assert!(counts[0] > 300 && counts[1] > 300, "{counts:?}");
}

/// AK-A.rho: bounds that are not positive are above nothing; a matrix without rows has no eigenvalue.
#[test]
fn edges_of_the_test_of_stability() {
    let zero = Q::zeros(2, 2);
    assert!(zero.spectral_radius_lt(&ratio(1, 1_000_000)));
    assert!(!zero.spectral_radius_lt(&ratio(0, 1)) && !zero.spectral_radius_lt(&ratio(-1, 1)));
    assert!(Q::zeros(0, 0).spectral_radius_lt(&ratio(1, 1)));
}

/// AK-L4.2, AK-A.rho: a nilpotent part does not count, and D = I is refused with X = DXDᵀ.
#[test]
fn equations_without_a_solution_are_refused() {
    let Err(error) = Q::identity(2).stein_solution(&Matrix::identity(2)) else { panic!("X − X = I") };
    assert_ne!(error.homogeneous, Matrix::zeros(2, 2));
    let saddle = Matrix::diagonal(&[ratio(2, 1), ratio(1, 2)]);
    let Err(error) = saddle.stein_solution(&Matrix::identity(2)) else { panic!("2·(1/2) = 1") };
    assert_eq!(&saddle * &error.homogeneous * saddle.transpose(), error.homogeneous);
    let nilpotent = Q::from_integers(&[[0, 5], [0, 0]]);
    // I + DDᵀ
    assert_eq!(nilpotent.stein_solution(&Matrix::identity(2)), Ok(Matrix::diagonal(&[ratio(26, 1), ratio(1, 1)])));
    // Unstable, but solvable: X − 4X = Q, and a right side that is not symmetric.
    let twice = Q::identity(2).scaled(&ratio(2, 1));
    let right = Q::from_integers(&[[3, 6], [0, 9]]);
    assert_eq!(twice.stein_solution(&right), Ok(right.scaled(&ratio(-1, 3))));
}
