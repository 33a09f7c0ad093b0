//! Stein's lemma and the lagged moments of Anderson and others without each hypothesis.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::ratio;
use proptest::prelude::*;

use super::models::{Q, definite, is_definite, is_semidefinite, matrices, power, semidefinite};
use super::search::{counterexample, holds_where};

fn is_stable(d: &Q) -> bool {
    d.spectral_radius_lt(&ratio(1, 1))
}

fn difference(f: &Q, d: &Q) -> Q {
    f - d.transpose().congruence(f)
}

/// F, and a D that is often small enough for F − DᵀFD > 0.
fn with_loops(f: impl Fn(usize) -> BoxedStrategy<Q> + Copy) -> impl Strategy<Value = (Q, Q)> {
    let scaled = |(f, d, parts): (Q, Q, i64)| (f, d.scaled(&ratio(1, parts)));
    (1_usize..=2).prop_flat_map(move |n| (f(n), matrices(n, n, 2), 1_i64..4)).prop_map(scaled)
}

/// AK-L4.2: without F > 0, and without strictness, ρ(D) < 1 does not follow.
#[test]
fn the_easy_half_of_stein_needs_both_signs() {
    let is_strict = |(f, d): &(Q, Q)| is_definite(&difference(f, d));
    let has_stable_loop = |(_, d): &(Q, Q)| is_stable(d);
    holds_where(with_loops(|n| definite(n).boxed()), is_strict, has_stable_loop);
    // F ≥ 0 only: then F > 0 follows from F ≥ F − DᵀFD > 0, so semidefiniteness is enough.
    holds_where(with_loops(|n| semidefinite(n).boxed()), is_strict, has_stable_loop);
    let (f, d) = counterexample(with_loops(|n| matrices(n, n, 3).prop_map(|a| &a + a.transpose()).boxed()), |model| {
        !is_strict(model) || has_stable_loop(model)
    });
    assert!(!is_semidefinite(&f) && !is_stable(&d), "{f}, {d}");
    let (f, d) = counterexample(with_loops(|n| definite(n).boxed()), |(f, d)| {
        !is_semidefinite(&difference(f, d)) || is_stable(d)
    });
    assert!(is_definite(&f) && !is_definite(&difference(&f, &d)));
}

/// A with ρ(A) < 1, and a V.
fn noisy(v: impl Fn(usize) -> BoxedStrategy<Q> + Copy) -> impl Strategy<Value = (Q, Q)> {
    (1_usize..=2).prop_flat_map(move |n| (matrices(n, n, 2), v(n), 2_i64..5)).prop_filter_map(
        "ρ(A) < 1",
        |(a, v, scale)| {
            let a = a.scaled(&ratio(1, scale));
            is_stable(&a).then_some((a, v))
        },
    )
}

/// Aⁱ(Φ − W), i = 0, 1, 2, for the stationary Φ − W = A(Φ − W)Aᵀ + V.
fn are_nonsingular(a: &Q, v: &Q) -> bool {
    let stationary = a.stein_solution(v).expect("ρ(A) < 1");
    (0..3).all(|i| (power(a, i) * &stationary).rank() == a.rows())
}

proptest! {
    /// AK-L3.1-nonsingular: with A and V nonsingular no lagged moment is singular.
    #[test]
    fn lagged_moments_are_nonsingular((a, v) in noisy(|n| definite(n).boxed())) {
        prop_assume!(a.rank() == a.rows());
        prop_assert!(are_nonsingular(&a, &v));
    }

    /// AK-L3.1ii: the lagged products of a long sum of sources are those of the formula, up to what ρ(A)ⁿ leaves: for
    /// nilpotent A exactly.
    #[test]
    fn lagged_moments_of_short_memories(above in -4_i64..5, v in semidefinite(2), lag in 0_usize..3) {
        let a = Matrix::from_fn(2, 2, |i, j| ratio(if i < j { above } else { 0 }, 1));
        let direct = (0..3).fold(Matrix::zeros(2, 2), |sum: Q, k| sum + power(&a, k + lag) * &v * power(&a, k).transpose());
        prop_assert_eq!(direct, power(&a, lag) * a.stein_solution(&v).expect("nilpotent"));
    }
}

/// AK-L3.1-nonsingular: without a nonsingular A, and without a nonsingular V, some moment is singular.
#[test]
fn lagged_moments_need_nonsingular_matrices() {
    let (a, v) = counterexample(noisy(|n| definite(n).boxed()), |(a, v)| are_nonsingular(a, v));
    assert!(a.rank() < a.rows() && is_definite(&v));
    let (a, v) =
        counterexample(noisy(|n| semidefinite(n).boxed()), |(a, v)| a.rank() < a.rows() || are_nonsingular(a, v));
    assert!(a.rank() == a.rows() && !is_definite(&v));
}

/// AK-L3.1ii, AK-L3.2: without ρ(A) < 1 the formula has nothing to stand for: the equation of the stationary covariance has no
/// solution, or one that is no covariance.
#[test]
fn stationary_moments_need_stability() {
    let models = (1_usize..=2).prop_flat_map(|n| (matrices(n, n, 2), definite(n)));
    let (a, _) = counterexample(models, |(a, v)| a.stein_solution(v).is_ok_and(|x| is_semidefinite(&x)));
    assert!(!is_stable(&a));
}
