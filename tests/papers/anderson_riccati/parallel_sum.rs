//! Lemma 4.1 for all positive semidefinite pairs, singular ones included.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::ratio;
use proptest::prelude::*;

use super::draws::{Q, definite, integers, inverse, is_definite, le, matrices, parallel_sum, semidefinite, shorted};

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

fn pairs() -> impl Strategy<Value = (Q, Q)> {
    (1usize..=3).prop_flat_map(|n| (semidefinite(n), semidefinite(n)))
}

proptest! {
    #![proptest_config(config(400))]

    /// AK-Par, AK-L4.1ii, AK-L4.1iv: two formulas and elimination agree, the sum is symmetric in F and G, psd, and below both.
    #[test]
    fn three_routes_to_the_parallel_sum((f, g) in pairs()) {
        let sum = parallel_sum(&f, &g);
        prop_assert_eq!(&sum, &shorted(&f, &g));
        prop_assert_eq!(&sum, &parallel_sum(&g, &f));
        let inverse = (&f + &g).pseudo_inverse().unwrap_or_else(|error| panic!("{error}"));
        prop_assert_eq!(&sum, &(&f - &f * &inverse * &f));
        prop_assert_eq!(&sum, &(&g - &g * &inverse * &g));
        prop_assert!(le(&Matrix::zeros(f.rows(), f.rows()), &sum));
        prop_assert!(le(&sum, &f) && le(&sum, &g));
    }

    /// AK-Par: the kernel of F:G is the sum of the kernels.
    #[test]
    fn kernels_add((f, g) in pairs()) {
        let sum = parallel_sum(&f, &g);
        let kernels = f.kernel().beside(&g.kernel());
        prop_assert!((&sum * &kernels).is_zero());
        prop_assert_eq!(kernels.rank(), f.rows() - sum.rank());
    }

    /// AK-L4.1iii: more in parallel is more, with a singular F, H and G too.
    #[test]
    fn parallel_sums_are_monotone((f, g, more) in (1usize..=3).prop_flat_map(|n| (semidefinite(n), semidefinite(n), semidefinite(n)))) {
        prop_assert!(le(&parallel_sum(&f, &g), &parallel_sum(&(&f + more), &g)));
    }

    /// AK-Par-inverse: where both are regular the inverses add.
    #[test]
    fn inverses_add((f, g) in (1usize..=4).prop_flat_map(|n| (definite(n), definite(n)))) {
        prop_assert_eq!(inverse(&parallel_sum(&f, &g)), inverse(&f) + inverse(&g));
    }

    /// AK-Par: xᵀ(F:G)x is below yᵀFy + (x − y)ᵀG(x − y) for every y, and the least such value.
    #[test]
    fn parallel_sum_is_the_least_value(
        (f, g, x, y) in (1usize..=3).prop_flat_map(|n| (semidefinite(n), semidefinite(n), matrices(n, 1, 4), matrices(n, 1, 4)))
    ) {
        let value = |y: &Q| y.transpose().congruence(&f) + (&x - y).transpose().congruence(&g);
        let sum = x.transpose().congruence(&parallel_sum(&f, &g));
        prop_assert!(le(&sum, &value(&y)));
        // Another formula for the least one: (F + G)y = Gx, from the normal equations of the square.
        let total = &f + &g;
        let square = &total * &total;
        let best = square.pseudo_inverse().unwrap_or_else(|error| panic!("{error}")) * &total * &g * &x;
        prop_assert_eq!(&total * &best, &g * &x);
        prop_assert_eq!(sum, value(&best));
    }

    /// AK-L4.1i, AK-L4.1: on 𝒢 the sum is continuous, with a modulus: moving F and G by less than εI moves F:G up by at most
    /// ε(GM²G + FM²F), M = (F + G)⁻¹ (the least y for F, G is taken for F + εI, G + εI), and down by at most the same
    /// expression at the moved pair.
    #[test]
    fn continuity_has_a_modulus_where_the_sum_is_regular(
        (f, g, move_f, move_g) in (1usize..=3).prop_flat_map(|n| (semidefinite(n), semidefinite(n), matrices(n, n, 3), matrices(n, n, 3))),
    ) {
        prop_assume!(is_definite(&(&f + &g)));
        let n = f.rows();
        let slope = |f: &Q, g: &Q| {
            let m = inverse(&(f + g));
            (g * &m).congruence(&Matrix::identity(n)) + (f * m).congruence(&Matrix::identity(n))
        };
        for epsilon in [ratio(1, 1), ratio(1, 100), ratio(1, 1_000_000)] {
            // A positive semidefinite F' with −εI ≤ F' − F ≤ εI: the multiples of MᵀM and of F in the mean.
            let moved = |f: &Q, by: &Q| {
                let by = by.transpose() * by;
                let scale = ratio(1, 1) + by.squared_norm() + f.squared_norm();
                let share = &epsilon / &scale;
                f.scaled(&(ratio(1, 1) - &share)) + by.scaled(&share)
            };
            let (f2, g2) = (moved(&f, &move_f), moved(&g, &move_g));
            let identity = Matrix::identity(n).scaled(&epsilon);
            for (old, new) in [(&f, &f2), (&g, &g2)] {
                prop_assert!(le(new, &(old + &identity)) && le(old, &(new + &identity)));
            }
            prop_assert!(is_definite(&(&f2 + &g2)));
            let (sum, sum2) = (parallel_sum(&f, &g), parallel_sum(&f2, &g2));
            prop_assert!(le(&sum2, &(&sum + slope(&f, &g).scaled(&epsilon))));
            prop_assert!(le(&sum, &(&sum2 + slope(&f2, &g2).scaled(&epsilon))));
        }
    }
}

/// AK-L4.1i: outside 𝒢 continuity fails: two lines that differ have nothing in common, however close.
#[test]
fn parallel_sum_jumps_where_the_sum_is_singular() {
    let g = integers(&[[1, 0], [0, 0]]);
    for power in 0..40 {
        let e = ratio(1, 1 << power);
        let v = Matrix::column(vec![ratio(1, 1), e]);
        assert_eq!(parallel_sum(&(&v * v.transpose()), &g), Matrix::zeros(2, 2));
    }
    let limit = Matrix::diagonal(&[ratio(1, 2), ratio(0, 1)]);
    assert_eq!(parallel_sum(&g, &g), limit);
    assert!(!is_definite(&(&g + &g)), "the limit lies outside 𝒢");
}

/// AK-L4.1: the hypothesis F, G ≥ 0 is needed: −1 and 2 have the parallel sum −2, which is not positive.
#[test]
fn indefinite_matrices_have_no_parallel_sum_worth_the_name() {
    assert_eq!(parallel_sum(&integers(&[[-1]]), &integers(&[[2]])), integers(&[[-2]]));
}
