//! Theorem 2.3, its corollaries and Lemma 4.3 of Anderson and others, on fixed points known by construction.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use proptest::prelude::*;

use super::models::{
    Constructed, Q, constructed, definite, inverse, is_definite, is_semidefinite, le, map, matrices, number, scalar,
    semidefinite, shorted,
};
use super::search::{counterexample, holds_without};

/// A scalar model with two numbers for which fixed points are looked for.
type Numbers = (i64, i64, i64, i64, i64);

/// φ(S) = A (S:W) A + V, with the sum by hand so that no sign is asked for.
fn image(a: i64, v: i64, w: i64, s: i64) -> Option<Rational> {
    let sum = ratio(s + w, 1);
    (s + w != 0).then(|| ratio(a * a * s * w, 1) / sum + ratio(v, 1))
}

fn is_fixed(a: i64, v: i64, w: i64, s: i64) -> bool {
    image(a, v, w, s) == Some(ratio(s, 1))
}

fn numbers(
    v: std::ops::Range<i64>,
    w: std::ops::Range<i64>,
    t: std::ops::Range<i64>,
) -> impl Strategy<Value = Numbers> {
    (-3_i64..4, v, w, t.clone(), t)
}

proptest! {
    /// AK-T2.3: for V > 0 and W ≥ 0 the enclosure of the fixed point holds the one that was constructed, and every start is after
    /// two steps between the first iterates of both bounds.
    #[test]
    fn the_fixed_point_is_one(model in (1_usize..=2).prop_flat_map(constructed), start in (1_usize..=2).prop_flat_map(definite)) {
        let Constructed { a, v, w, t } = &model;
        let phi = map(a, v, w);
        let found = phi.fixed_point(&ratio(1, 1000), 10_000).map_err(|error| TestCaseError::fail(error.to_string()))?;
        prop_assert!(le(&found.lower, t) && le(t, &found.upper));
        prop_assume!(start.shape() == t.shape());
        // V ≤ φ(S) ≤ AWAᵀ + V for every S.
        let two = phi.iterate(&start, 2);
        prop_assert!(le(&phi.image(v), &two) && le(&two, &phi.image(&phi.upper_bound())));
    }

    /// AK-T2.3: for V > 0 and W ≥ 0 a scalar map has one fixed point that is not negative. The equation is quadratic,
    /// `T² − (A²W + V − W)T − VW = 0`, so its roots are T and −VW/T.
    #[test]
    fn fixed_points_of_scalars_are_one(a in -3_i64..4, w in 0_i64..20, t in 1_i64..40) {
        let (a, w, t) = (ratio(a, 2), ratio(w, 1), ratio(t, 3));
        let v = &t - &a * &a * &t * &w / (&t + &w);
        prop_assume!(v > ratio(0, 1));
        let phi = map(&scalar(a.clone()), &scalar(v.clone()), &scalar(w.clone()));
        prop_assert_eq!(phi.image(&scalar(t.clone())), scalar(t.clone()));
        let other = -(&v * &w) / &t;
        prop_assert_eq!(&other * &other, (&a * &a * &w + &v - &w) * &other + &v * &w);
        // Negative, or 0 for W = 0, where the equation was multiplied by T + W = 0.
        prop_assert!(other < ratio(0, 1) || phi.image(&scalar(ratio(0, 1))) != scalar(ratio(0, 1)));
    }

    /// AK-L4.3, AK-L4.3-id: T − DTDᵀ is what the lemma says, at least V, and D is stable.
    #[test]
    fn closed_loops_obey_stein(model in (1_usize..=3).prop_flat_map(constructed)) {
        prop_assert!(is_stein(&model) && has_stable_loop(&model));
    }
}

/// AK-T2.3, AK-C2.1: without V > 0 there may be two fixed points, and the filter's limit depends on P(0).
#[test]
fn without_state_noise_there_are_two_fixed_points() {
    let is_one = |&(a, v, w, s, t): &Numbers| s == t || !is_fixed(a, v, w, s) || !is_fixed(a, v, w, t);
    let (a, v, w, s, t) = counterexample(numbers(0..1, 1..6, 0..40), is_one);
    assert_eq!((v, s.min(t)), (0, 0));
    assert_eq!(s.max(t), (a * a - 1) * w, "the other one");
    // Both are limits: the filter that starts there stays there, with different gains.
    let phi = map(&scalar(ratio(a, 1)), &scalar(ratio(v, 1)), &scalar(ratio(w, 1)));
    let limits = [s, t].map(|start| phi.iterate(&scalar(ratio(start, 1)), 5));
    assert_ne!(phi.gain(&limits[0]), phi.gain(&limits[1]));
}

/// AK-T2.3: without W ≥ 0 there may be two positive fixed points.
#[test]
fn without_a_sign_of_the_observation_noise_there_are_two_fixed_points() {
    let is_one = |&(a, v, w, s, t): &Numbers| s == t || !is_fixed(a, v, w, s) || !is_fixed(a, v, w, t);
    let (_, v, w, s, t) = counterexample(numbers(1..10, -3..0, 1..7), is_one);
    assert!(v > 0 && w < 0 && s > 0 && t > 0 && s != t);
}

fn loop_of(model: &Constructed) -> Q {
    &model.a * &model.w * inverse(&(&model.t + &model.w))
}

/// T − DTDᵀ = AT(T + W)⁻¹W(T + W)⁻¹TAᵀ + V
fn is_stein(model: &Constructed) -> bool {
    let Constructed { a, v, w, t } = model;
    let d = loop_of(model);
    let outer = a * t * inverse(&(t + w));
    t - d.congruence(t) == outer.congruence(w) + v
}

fn has_stable_loop(model: &Constructed) -> bool {
    loop_of(model).spectral_radius_lt(&ratio(1, 1))
}

/// V = T − A(T:W)Aᵀ ≥ 0 instead of > 0, and T ≥ 0 with T + W > 0.
fn with_any_noise(n: usize) -> impl Strategy<Value = Constructed> {
    let entries =
        move || prop_oneof![matrices(n, n, 2), (-3_i64..4).prop_map(move |c| Matrix::identity(n).scaled(&ratio(c, 1)))];
    (entries(), semidefinite(n), semidefinite(n)).prop_filter_map("V ≥ 0", |(a, w, t)| {
        let v = &t - a.congruence(&shorted(&t, &w));
        (is_semidefinite(&v) && is_definite(&(&t + &w))).then_some(Constructed { a, v, w, t })
    })
}

/// T, V > 0, W chosen freely: T need be no fixed point.
fn without_fixed_point(n: usize) -> impl Strategy<Value = Constructed> {
    (matrices(n, n, 3), definite(n), semidefinite(n), definite(n)).prop_map(|(a, v, w, t)| Constructed { a, v, w, t })
}

/// AK-L4.3: without V > 0 the loop need not be stable; without T = φ(T) neither.
#[test]
fn stable_loops_need_state_noise_and_a_fixed_point() {
    let model = counterexample((1_usize..=2).prop_flat_map(with_any_noise), has_stable_loop);
    assert!(!is_definite(&model.v), "{model:?}");
    let model = counterexample((1_usize..=2).prop_flat_map(without_fixed_point), has_stable_loop);
    assert!(is_definite(&model.v) && !is_fixed_point(&model), "{model:?}");
}

/// T = φ(T)
fn is_fixed_point(model: &Constructed) -> bool {
    let Constructed { a, v, w, t } = model;
    *t == v + a.congruence(&shorted(t, w))
}

/// AK-L4.3-id: the identity needs no V > 0, and it does need T = φ(T).
#[test]
fn the_stein_identity_needs_a_fixed_point_only() {
    holds_without((1_usize..=2).prop_flat_map(with_any_noise), is_stein);
    let model = counterexample((1_usize..=2).prop_flat_map(without_fixed_point), is_stein);
    assert!(!is_fixed_point(&model));
}

/// A, W > 0, and any two T₁, T₂ ≥ 0.
fn two() -> impl Strategy<Value = (Q, Q, Q, Q)> {
    (1_usize..=2).prop_flat_map(|n| (matrices(n, n, 3), definite(n), semidefinite(n), semidefinite(n)))
}

/// AK-T2.3-diff: the middle equality holds for any two matrices, the outer ones for fixed points only.
#[test]
fn differences_of_fixed_points_need_fixed_points() {
    let sides = |(a, w, one, two): &(Q, Q, Q, Q)| {
        let d = |t: &Q| a * w * inverse(&(t + w));
        let through = a.congruence(&(shorted(one, w) - shorted(two, w)));
        (one - two, through, d(one) * (one - two) * d(two).transpose())
    };
    holds_without(two(), |model| {
        let (_, middle, right) = sides(model);
        middle == right
    });
    counterexample(two(), |model| {
        let (left, middle, _) = sides(model);
        left == middle
    });
}

/// AK-C2.2: with V → 0 there is no limit: the fixed points for V = e tend to one that is not the only one for V = 0.
#[test]
fn fixed_points_jump_where_the_state_noise_vanishes() {
    // T = (A² − 1)W + e' is fixed for the V that makes it so, and V → 0 with e' → 0.
    let (a, w) = (ratio(2, 1), ratio(1, 1));
    for power in 1..30 {
        let t = ratio(3, 1) + ratio(1, 1 << power);
        let v = &t - &a * &a * &t * &w / (&t + &w);
        assert!(v > ratio(0, 1) && v < ratio(1, 1 << power));
        assert_eq!(map(&scalar(a.clone()), &scalar(v), &scalar(w.clone())).image(&scalar(t.clone())), scalar(t));
    }
    let limit = map(&scalar(a), &scalar(ratio(0, 1)), &scalar(w));
    assert_eq!([0, 3].map(|s| number(&limit.image(&scalar(ratio(s, 1))))), [ratio(0, 1), ratio(3, 1)]);
}
