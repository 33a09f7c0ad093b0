//! The map φ: its bounds, its closed loop, the difference of two fixed points.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use proptest::collection::vec;
use proptest::prelude::*;

use super::draws::{
    Constructed, Q, constructed, definite, integers, inverse, is_definite, is_semidefinite, le, map, matrices, number,
    power, scalar, semidefinite, shorted,
};

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

/// A, V, W and S, with any ranks.
fn models() -> impl Strategy<Value = (Q, Q, Q, Q)> {
    (1usize..=3).prop_flat_map(|n| (matrices(n, n, 4), semidefinite(n), semidefinite(n), semidefinite(n)))
}

proptest! {
    #![proptest_config(config(300))]

    /// AK-2.5, AK-4.2: φ(S) by elimination, by the form with W, and V ≤ φ(S) ≤ AWAᵀ + V, singular matrices included.
    #[test]
    fn images_stay_between_the_bounds((a, v, w, s) in models()) {
        let map = map(&a, &v, &w);
        let image = map.image(&s);
        prop_assert_eq!(&image, &(a.congruence(&shorted(&s, &w)) + &v));
        let inverse = (&s + &w).pseudo_inverse().unwrap_or_else(|error| panic!("{error}"));
        prop_assert_eq!(&image, &(a.congruence(&(&w - &w * inverse * &w)) + &v));
        prop_assert!(le(&v, &image));
        prop_assert!(le(&image, &(a.congruence(&w) + &v)));
        prop_assert_eq!(map.upper_bound(), a.congruence(&w) + &v);
    }

    /// AK-4.2-up, AK-4.2-down, AK-4.2-sandwich, AK-4.2: the iterates of V rise, those of AWAᵀ + V fall, and those of any
    /// S ≥ 0 lie between, for n = 0 to 3.
    #[test]
    fn iterates_of_the_bounds_close_in((a, v, w, s) in models()) {
        let map = map(&a, &v, &w);
        let (mut low, mut high, mut between) = (v.clone(), map.upper_bound(), map.image(&s));
        for n in 0..=3 {
            prop_assert_eq!(&low, &map.iterate(&v, n));
            prop_assert!(le(&low, &between) && le(&between, &high));
            let (next_low, next_high) = (map.image(&low), map.image(&high));
            prop_assert!(le(&low, &next_low) && le(&next_low, &map.upper_bound()));
            prop_assert!(le(&next_high, &high));
            (low, high, between) = (next_low, next_high, map.image(&between));
        }
    }

    /// AK-T2.3-diff: the middle equality holds for any T₁, T₂ with T + W > 0.
    #[test]
    fn differences_pass_through_both_loops(
        (a, v, w, t1, t2) in (1usize..=3).prop_flat_map(|n| (matrices(n, n, 4), semidefinite(n), semidefinite(n), semidefinite(n), semidefinite(n)))
    ) {
        prop_assume!(is_definite(&(&t1 + &w)) && is_definite(&(&t2 + &w)));
        let map = map(&a, &v, &w);
        let (d1, d2) = (map.closed_loop(&t1), map.closed_loop(&t2));
        // AK-D
        prop_assert_eq!(&d1, &(&a * &w * inverse(&(&t1 + &w))));
        let difference = a.congruence(&(shorted(&t1, &w) - shorted(&t2, &w)));
        prop_assert_eq!(&difference, &(&d1 * (&t1 - &t2) * d2.transpose()));
        prop_assert_eq!(difference, map.image(&t1) - map.image(&t2));
    }

    /// AK-T2.3-diff: with V = 0 several fixed points exist, and their differences are preserved by any number of loops:
    /// T = B diag(tᵢ)Bᵀ with tᵢ = 0 or wᵢ(aᵢ² − 1), A = B diag(aᵢ)B⁻¹, W = B diag(wᵢ)Bᵀ.
    #[test]
    fn two_fixed_points_differ_by_what_the_loops_keep(
        basis in matrices(2, 2, 3), gains in vec((2i64..5, 1i64..4), 2), picked in vec(any::<bool>(), 4)
    ) {
        prop_assume!(basis.rank() == 2);
        let diagonal = |entry: &dyn Fn(usize) -> Rational| Matrix::diagonal(&[entry(0), entry(1)]);
        let a = &basis * diagonal(&|i| ratio(gains[i].0, 1)) * inverse(&basis);
        let w = basis.congruence(&diagonal(&|i| ratio(gains[i].1, 1)));
        let fixed = |picked: &[bool]| {
            let value = |i: usize| if picked[i] { gains[i].1 * (gains[i].0 * gains[i].0 - 1) } else { 0 };
            basis.congruence(&diagonal(&|i| ratio(value(i), 1)))
        };
        let map = map(&a, &Matrix::zeros(2, 2), &w);
        let (t1, t2) = (fixed(&picked[..2]), fixed(&picked[2..]));
        prop_assert_eq!((&map.image(&t1), &map.image(&t2)), (&t1, &t2));
        let (d1, d2) = (map.closed_loop(&t1), map.closed_loop(&t2));
        for n in 1..=3 {
            prop_assert_eq!(&(power(&d1, n) * (&t1 - &t2) * power(&d2, n).transpose()), &(&t1 - &t2));
        }
        // Only the greatest of them has a stable loop.
        prop_assert_eq!(d1.spectral_radius_lt(&ratio(1, 1)), picked[0] && picked[1]);
    }

    /// AK-L4.3, AK-L4.3-id, AK-D: at a fixed point T − DTDᵀ is what the paper says, and ρ(D) < 1, by the characteristic
    /// polynomial and by Lemma 4.2 with F = T for Dᵀ.
    #[test]
    fn closed_loops_are_stable(Constructed { a, v, w, t } in (1usize..=3).prop_flat_map(constructed)) {
        let map = map(&a, &v, &w);
        prop_assert_eq!(&map.image(&t), &t);
        let d = map.closed_loop(&t);
        let total = inverse(&(&t + &w));
        prop_assert_eq!(&d, &(&a * &w * &total));
        let stein = &t - d.congruence(&t);
        prop_assert_eq!(&stein, &((&a * &t * &total).congruence(&w) + &v));
        prop_assert!(is_definite(&stein) && le(&v, &stein));
        prop_assert!(d.spectral_radius_lt(&ratio(1, 1)));
        // AK-5-rho needs W(T + W)⁻¹A: the characteristic polynomials of XY and YX agree.
        prop_assert_eq!((&w * &total * &a).characteristic_polynomial(), d.characteristic_polynomial());
    }

    /// AK-L4.1iii: φ is monotone.
    #[test]
    fn the_map_is_monotone((a, v, w, s) in models(), more in matrices(3, 3, 3)) {
        let map = map(&a, &v, &w);
        let more = (&more * more.transpose()).block(0..a.rows(), 0..a.rows());
        prop_assert!(le(&map.image(&s), &map.image(&(&s + more))));
    }
}

/// AK-L4.3, AK-D: V > 0 is needed: A = 2, W = 1, V = 0, T = 0 has D = 2; the other fixed point T = 3 has D = 1/2.
#[test]
fn a_loop_without_state_noise_may_be_unstable() {
    let map = map(&integers(&[[2]]), &integers(&[[0]]), &integers(&[[1]]));
    for (t, d, stable) in [(0, ratio(2, 1), false), (3, ratio(1, 2), true)] {
        let t = scalar(ratio(t, 1));
        assert_eq!(map.image(&t), t);
        assert_eq!(number(&map.closed_loop(&t)), d);
        assert_eq!(map.closed_loop(&t).spectral_radius_lt(&ratio(1, 1)), stable);
    }
}

/// AK-Ex4: among V + tW exactly t = 0 and t = 3 are fixed, and among all S ≥ 0 with halves up to 4 there is no other; only
/// V + 3W > 0, and iterates from S > 0 go there. All S + W that occur are regular.
#[test]
fn the_papers_example_has_two_fixed_points() {
    let (v, w) = (integers(&[[0, 0], [0, 1]]), integers(&[[1, 0], [0, 0]]));
    let map = map(&integers(&[[2, 0], [0, 2]]), &v, &w);
    let fixed = [v.clone(), &v + w.scaled(&ratio(3, 1))];
    for t in &fixed {
        assert_eq!(map.image(t), *t);
        assert_eq!(t, &(shorted(t, &w).scaled(&ratio(4, 1)) + &v));
        assert!(is_definite(&(t + &w)));
    }
    assert_eq!(fixed.each_ref().map(is_definite), [false, true]);
    for t in 0..=40 {
        let s = &v + w.scaled(&ratio(t, 8));
        assert_eq!(map.image(&s) == s, t == 0 || t == 24, "t = {t}/8");
    }
    let mut count = 0;
    for (a, b, c) in (0..=8).flat_map(|a| (-8..=8).flat_map(move |b| (0..=8).map(move |c| (a, b, c)))) {
        let s = integers(&[[a, b], [b, c]]).scaled(&ratio(1, 2));
        if is_semidefinite(&s) {
            assert_eq!(map.image(&s) == s, fixed.contains(&s), "{s}");
            count += 1;
        }
    }
    assert!(count > 400, "{count}");
    let near = map.iterate(&integers(&[[1, 0], [0, 1]]), 30) - &fixed[1];
    assert!(near.squared_norm() < ratio(1, 1 << 60));
}

/// AK-T2.3: V > 0 is needed. With V = 0 and W = 1, A = 1/2 has no positive fixed point: φ(S) = S/(4S + 4) < S. A = 2 has 0 and
/// 3, and near 0 convergence to 3 takes any number of steps: φⁿ(4⁻²ⁿ) ≤ 4⁻ⁿ.
#[test]
fn without_state_noise_the_theorem_fails() {
    let (zero, one) = (scalar(ratio(0, 1)), scalar(ratio(1, 1)));
    let shrinking = map(&scalar(ratio(1, 2)), &zero, &one);
    for s in 1..200 {
        let s = scalar(ratio(s, 20));
        assert!(number(&shrinking.image(&s)) < number(&s));
    }
    let growing = map(&scalar(ratio(2, 1)), &zero, &one);
    for n in 1..=12_usize {
        let start = scalar(ratio(1, 1 << (4 * n)));
        assert!(number(&growing.iterate(&start, n)) <= ratio(1, 1 << (2 * n)));
    }
    let late = number(&growing.iterate(&scalar(ratio(1, 1 << 20)), 40)) - ratio(3, 1);
    assert!(&late * &late < ratio(1, 1 << 30));
}

/// AK-L4.3: the draws of constructed fixed points reach unstable A, singular W, and loops that hardly contract.
#[test]
fn constructed_fixed_points_reach_the_corners() {
    use proptest::strategy::ValueTree as _;
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let (mut unstable, mut singular, mut slow) = (0, 0, 0);
    for _ in 0..200 {
        let tree = constructed(2).new_tree(&mut runner).unwrap_or_else(|error| panic!("{error}"));
        let Constructed { a, v, w, t } = tree.current();
        unstable += usize::from(!a.spectral_radius_lt(&ratio(1, 1)));
        singular += usize::from(w.rank() < 2);
        slow += usize::from(!map(&a, &v, &w).closed_loop(&t).spectral_radius_lt(&ratio(3, 4)));
    }
    assert!(unstable >= 40 && singular >= 40 && slow >= 5, "{unstable}, {singular}, {slow}");
    // Definite draws are used for the formulas with inverses.
    assert!(is_definite(&definite(2).new_tree(&mut runner).unwrap_or_else(|error| panic!("{error}")).current()));
}
