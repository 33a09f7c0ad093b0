//! Norms and the order of symmetric matrices (AK, section 2, notation).

use exact_kalman::matrix::{LdlError, Matrix};
use exact_kalman::scalar::{Rational, ratio};
use proptest::prelude::*;

use super::draws::{Q, integers, le, matrices, semidefinite};

fn trace(matrix: &Q) -> Rational {
    (0..matrix.rows()).fold(ratio(0, 1), |sum, i| sum + &matrix[(i, i)])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    /// AK-N.x, AK-N.G: the trace of GGᵀ, xᵀx for a column; ‖FG‖ ≤ ‖F‖‖G‖ and ‖abᵀ‖ = |a||b|.
    #[test]
    fn norms_are_those_of_the_paper(f in matrices(2, 3, 5), g in matrices(3, 2, 5), a in matrices(3, 1, 5), b in matrices(3, 1, 5)) {
        prop_assert_eq!(g.squared_norm(), trace(&(&g * g.transpose())));
        prop_assert_eq!(a.squared_norm(), trace(&(a.transpose() * &a)));
        prop_assert!((&f * &g).squared_norm() <= f.squared_norm() * g.squared_norm());
        prop_assert_eq!((&a * b.transpose()).squared_norm(), a.squared_norm() * b.squared_norm());
    }

    /// AK-Order: F ≥ G says xᵀFx ≥ xᵀGx for every x; where it fails, the witness is such an x.
    #[test]
    fn order_compares_the_quadratic_forms(f in semidefinite(3), g in semidefinite(3), x in matrices(3, 1, 5)) {
        let form = |p: &Q, x: &Q| {
            let places = (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
            places.fold(ratio(0, 1), |sum, (i, j)| sum + &x[(i, 0)] * &p[(i, j)] * &x[(j, 0)])
        };
        match g.loewner_le(&f) {
            Ok(()) => prop_assert!(form(&f, &x) >= form(&g, &x)),
            Err(LdlError::Indefinite(proof)) => prop_assert!(form(&f, &proof.witness) < form(&g, &proof.witness)),
            Err(LdlError::Asymmetric { .. }) => prop_assert!(false, "F and G are symmetric"),
        }
        prop_assert!(le(&g, &(&g + &f)), "G + F ≥ G for F ≥ 0");
    }
}

/// AK-N.G: ‖I‖ = √p, unlike the norm of an operator.
#[test]
fn identity_has_the_norm_root_p() {
    for p in 1..5_u8 {
        assert_eq!(Matrix::<Rational>::identity(usize::from(p)).squared_norm(), ratio(i64::from(p), 1));
    }
}

/// AK-Order: the order is partial.
#[test]
fn some_matrices_cannot_be_compared() {
    let (f, g) = (integers(&[[2, 0], [0, 1]]), integers(&[[1, 0], [0, 2]]));
    assert!(!le(&f, &g) && !le(&g, &f));
}
