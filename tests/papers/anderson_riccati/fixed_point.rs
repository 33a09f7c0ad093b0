//! Theorem 2.3 and Corollary 2.1: existence, uniqueness, uniform convergence, by certified enclosures.

use exact_kalman::matrix::Matrix;
use exact_kalman::riccati::{FixedPointEnclosure, FixedPointError};
use exact_kalman::scalar::{Rational, ratio};
use proptest::prelude::*;

use super::draws::{
    Constructed, Q, constructed, definite, integers, inverse, is_definite, le, map, matrices, number, scalar,
    semidefinite, shorted,
};

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

fn small() -> Rational {
    ratio(1, 1_000_000_000)
}

proptest! {
    #![proptest_config(config(120))]

    /// AK-T2.3, AK-4.2-sandwich: a fixed point known by construction lies in every sandwich, and in the enclosure; the
    /// enclosure reaches the gap asked for unless the loop hardly contracts.
    #[test]
    fn known_fixed_points_are_enclosed(Constructed { a, v, w, t } in (1usize..=3).prop_flat_map(constructed)) {
        let map = map(&a, &v, &w);
        prop_assert_eq!(&(a.congruence(&shorted(&t, &w)) + &v), &t);
        let (mut low, mut high) = (v, map.upper_bound());
        for _ in 0..4 {
            prop_assert!(le(&low, &t) && le(&t, &high));
            (low, high) = (map.image(&low), map.image(&high));
        }
        // A loop that hardly contracts needs thousands of steps; what is reached before is an enclosure as well.
        let found = match map.fixed_point(&small(), 400) {
            Ok(found) => {
                prop_assert!(found.squared_gap() <= small() * small());
                found
            }
            Err(FixedPointError::TooFewSteps { reached }) => {
                prop_assert!(reached.steps == 400 && reached.squared_gap() > small() * small());
                prop_assert!(!map.closed_loop(&t).spectral_radius_lt(&ratio(9, 10)));
                reached
            }
            Err(error) => panic!("{error}"),
        };
        prop_assert!(le(&found.lower, &t) && le(&t, &found.upper) && is_definite(&found.lower));
        // Δ∞ and P∞ of AK-C2.1.
        let (total, identity) = (inverse(&(&t + &w)), Matrix::identity(t.rows()));
        let (after, gain) = (&t - &t * &total * &t, &t * total);
        let (low, high) = map.filtered_limit(&found);
        prop_assert!(le(&low, &after) && le(&after, &high));
        prop_assert_eq!(after, (identity - &gain) * &t);
        let limit = map.gain_limit(&found);
        for (place, (centre, radius)) in limit.centre.entries().iter().zip(limit.radius.entries()).enumerate() {
            let error = &gain.entries()[place] - centre;
            prop_assert!(&error <= radius && -error <= *radius);
        }
        // The radius is no larger than the gap makes it: (L + W)⁻¹ − (U + W)⁻¹ = (L + W)⁻¹(U − L)(U + W)⁻¹, and
        // norms of products are at most products of norms.
        let [low, high] = [&found.lower, &found.upper].map(|bound| inverse(&(bound + &w)).squared_norm());
        let share = w.squared_norm() + ratio(1, 1);
        let most = &share * &share * low * high * found.squared_gap();
        for radius in limit.radius.entries() {
            prop_assert!(radius * radius * ratio(4, 1) <= most, "{radius}");
        }
    }

    /// AK-4.2-sandwich: the rounded bounds are outside the exact iterates, step by step.
    #[test]
    fn rounding_goes_outwards((a, v, w) in (1usize..=3).prop_flat_map(|n| (matrices(n, n, 4), definite(n), semidefinite(n)))) {
        let map = map(&a, &v, &w);
        // Nothing reaches this gap in so few steps, so the bounds after exactly `steps` steps are handed out.
        for steps in 0..=4 {
            let found = match map.fixed_point(&ratio(1, 1 << 20), steps) {
                Err(FixedPointError::TooFewSteps { reached }) | Ok(reached) => reached,
                Err(error) => panic!("{error}"),
            };
            prop_assert!(found.steps <= steps);
            let (low, high) = (map.iterate(&v, found.steps), map.iterate(&map.upper_bound(), found.steps));
            prop_assert!(le(&found.lower, &low), "{} not below {low}", found.lower);
            prop_assert!(le(&high, &found.upper), "{} not above {high}", found.upper);
        }
    }

    /// AK-T2.3: from any two starts, however small or large, iterates end within the same gap: uniform convergence, and
    /// so one fixed point only. The number of steps is that of the enclosure, which knows neither start.
    #[test]
    fn all_starts_converge_together(
        (a, v, w, s) in (1usize..=2).prop_flat_map(|n| (matrices(n, n, 3), definite(n), semidefinite(n), definite(n)))
    ) {
        let map = map(&a, &v, &w);
        let gap = ratio(1, 1000);
        let Ok(found) = map.fixed_point(&gap, 24) else { return Err(TestCaseError::reject("slow")) };
        let n = a.rows();
        let identity: Q = Matrix::identity(n);
        for start in [s, identity.scaled(&ratio(1, 1_000_000)), identity.scaled(&ratio(1_000_000, 1))] {
            let image = map.iterate(&start, found.steps + 1);
            prop_assert!(le(&found.lower, &image) && le(&image, &found.upper));
            // 0 ≤ image − lower ≤ upper − lower bounds the norms.
            prop_assert!((image - &found.lower).squared_norm() <= &gap * &gap);
        }
    }

    /// AK-C2.1: from any P(0) the filter's S(k), Δ(k), P(k) come as near to the limits as the enclosure of S∞ says.
    #[test]
    fn the_filter_reaches_its_limits(
        (Constructed { a, v, w, t }, p) in (1usize..=2).prop_flat_map(|n| (constructed(n), semidefinite(n)))
    ) {
        let map = map(&a, &v, &w);
        let gap = ratio(1, 1000);
        let Ok(found) = map.fixed_point(&gap, 24) else { return Err(TestCaseError::reject("slow")) };
        let mut step = map.step(&p);
        for _ in 0..=found.steps {
            step = map.step(&step.filtered);
        }
        prop_assert!((&step.predicted - &t).squared_norm() <= &gap * &gap);
        let total = inverse(&(&t + &w));
        // P(k) and P∞ lie between the same bounds L:W and U:W, which are nearer than X(U − L)Xᵀ, X = W(L + W)⁻¹.
        let after = &t - &t * &total * &t;
        let (low, high) = map.filtered_limit(&found);
        prop_assert!((&step.filtered - after).squared_norm() <= (&high - &low).squared_norm());
        let x = &w * inverse(&(&found.lower + &w));
        prop_assert!(le(&(high - low), &x.congruence(&(&found.upper - &found.lower))));
        // Δ(k) and Δ∞ are both within the radius of the centre.
        let limit = map.gain_limit(&found);
        let difference = &step.gain - &t * total;
        for (entry, radius) in difference.entries().iter().zip(limit.radius.entries()) {
            let twice = radius * ratio(2, 1);
            prop_assert!(entry <= &twice && -entry <= twice);
        }
    }
}

/// AK-C2.1: A = I, V = diag(2⁻³⁴, 1), W = diag(0, 100), where rounding for a gap of 1/2 would make the first entry of the
/// lower bound 0 and its sum with W singular. The bound stays positive definite, the radius is not negative, and the gains
/// of exact iterates from small and large starts lie within it.
#[test]
fn bounds_stay_definite_beside_singular_noise() {
    let w = integers(&[[0, 0], [0, 100]]);
    let v = Matrix::diagonal(&[ratio(1, 1 << 34), ratio(1, 1)]);
    let map = map(&Matrix::identity(2), &v, &w);
    let found = map.fixed_point(&ratio(1, 2), 100).unwrap_or_else(|error| panic!("{error}"));
    assert!(found.steps > 0 && is_definite(&found.lower));
    assert!(le(&found.lower, &map.iterate(&v, found.steps)));
    let limit = map.gain_limit(&found);
    assert!(limit.radius.entries().iter().all(|radius| *radius >= ratio(0, 1)), "{}", limit.radius);
    for scale in [ratio(1, 1_000_000), ratio(1, 1), ratio(1_000_000, 1)] {
        let mut s = map.iterate(&Matrix::identity(2).scaled(&scale), found.steps + 1);
        for _ in 0..10 {
            let error = &s * inverse(&(&s + &w)) - &limit.centre;
            for (entry, radius) in error.entries().iter().zip(limit.radius.entries()) {
                assert!(entry <= radius && -entry <= *radius, "{entry} beyond {radius}");
            }
            s = map.image(&s);
        }
    }
}

/// AK-C2.1: an enclosure made by hand whose lower bound is singular together with W bounds no gain, and is not taken for one.
#[test]
#[should_panic(expected = "L + W is not positive definite")]
fn singular_bounds_give_no_gain() {
    let map = map(&Matrix::identity(2), &Matrix::identity(2), &integers(&[[0, 0], [0, 100]]));
    let lower = integers(&[[0, 0], [0, 1]]);
    map.gain_limit(&FixedPointEnclosure { lower, upper: map.upper_bound(), steps: 0 });
}

/// AK-T2.3: two fixed points T₁, T₂ satisfy T₁ − T₂ = D₁(T₁ − T₂)D₂ᵀ, and X = D₁XD₂ᵀ has only X = 0 where ρ(D₁), ρ(D₂) < 1:
/// here for three chosen matrices with ρ < 1, taken in pairs as D₁ and D₂ (they are no loops of given maps), whose blocks
/// make one D.
#[test]
fn stable_loops_keep_no_difference() {
    let loops = [
        integers(&[[1, 1], [0, 1]]).scaled(&ratio(3, 4)),
        integers(&[[0, 2], [-1, 0]]).scaled(&ratio(1, 2)),
        integers(&[[3, 4], [-4, 3]]).scaled(&ratio(19, 100)),
    ];
    for d1 in &loops {
        for d2 in &loops {
            let both = d1.block_diagonal(d2);
            assert!(both.spectral_radius_lt(&ratio(1, 1)));
            // The corner of the equation for diag(D₁, D₂) is X = D₁XD₂ᵀ: unique solvability with 0 on the right.
            assert_eq!(both.stein_solution(&Matrix::zeros(4, 4)), Ok(Matrix::zeros(4, 4)));
        }
    }
    // D₁ = 2 and D₂ = 1/2, the loops of A = 2, V = 0, W = 1, keep every difference.
    let both = Matrix::diagonal(&[ratio(2, 1), ratio(1, 2)]);
    let Err(error) = both.stein_solution(&Matrix::zeros(2, 2)) else { panic!("2·(1/2) = 1") };
    assert_eq!(both.congruence(&error.homogeneous), error.homogeneous);
}

/// AK-C2.1: for A = V = 1, W = 2 the limits are S∞ = 2, Δ∞ = 1/2, P∞ = 1 from every start, whatever P(0) is: the limit
/// that the paper calls P₀ is not the P₀ of (1.4).
#[test]
fn limits_are_not_what_the_filter_starts_with() {
    let map = map(&integers(&[[1]]), &integers(&[[1]]), &integers(&[[2]]));
    assert_eq!(number(&map.image(&integers(&[[2]]))), ratio(2, 1));
    for start in [0, 1, 7] {
        let start = scalar(ratio(start, 1));
        let mut step = map.step(&start);
        for _ in 0..20 {
            step = map.step(&step.filtered);
        }
        let near = |found: &Q, limit: Rational| {
            let error = number(found) - limit;
            &error * &error < ratio(1, 1_000_000_000)
        };
        assert!(
            near(&step.predicted, ratio(2, 1)) && near(&step.gain, ratio(1, 2)) && near(&step.filtered, ratio(1, 1))
        );
        assert_eq!(near(&step.filtered, number(&start)), start == integers(&[[1]]), "P(k) → P(0)");
    }
}

/// AK-T2.3, AK-4.2-sandwich: what is not enclosed, and why.
#[test]
fn refusals_say_why() {
    let (a, w) = (integers(&[[2, 0], [0, 2]]), integers(&[[1, 0], [0, 0]]));
    let singular = integers(&[[1, 1], [1, 1]]);
    match map(&a, &singular, &w).fixed_point(&small(), 10) {
        Err(error @ FixedPointError::StateNoiseSingular { .. }) => {
            assert!(error.to_string().contains("A = 2, V = 0, W = 1"));
            let FixedPointError::StateNoiseSingular { direction } = error else { unreachable!() };
            assert!((singular * &direction).is_zero() && !direction.is_zero());
        }
        other => panic!("{other:?}"),
    }
    let map = map(&a, &Matrix::identity(2), &w);
    match map.fixed_point(&small(), 3) {
        Err(FixedPointError::TooFewSteps { reached }) => {
            assert_eq!(reached.steps, 3);
            assert!(le(&reached.lower, &reached.upper) && reached.squared_gap() > small());
        }
        other => panic!("{other:?}"),
    }
    // A gap below zero counts as zero, which is reached only where nothing moves.
    assert!(matches!(map.fixed_point(&ratio(-1, 1), 2), Err(FixedPointError::TooFewSteps { .. })));
    let still = super::draws::map(&Matrix::zeros(2, 2), &Matrix::identity(2), &w);
    let found = still.fixed_point(&ratio(0, 1), 0).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(found, FixedPointEnclosure { lower: Matrix::identity(2), upper: Matrix::identity(2), steps: 0 });
    assert_eq!(still.fixed_point(&ratio(-1, 1), 0), Ok(found));
}

/// AK-4.2-sandwich: long runs have short entries: a loop that contracts by 0.998 a step needs thousands of steps.
#[test]
fn slow_loops_are_enclosed_with_short_numbers() {
    let map = map(&integers(&[[1]]), &scalar(ratio(1, 1_000_000)), &integers(&[[1]]));
    let gap = ratio(1, 1 << 30);
    let found = map.fixed_point(&gap, 20_000).unwrap_or_else(|error| panic!("{error}"));
    assert!(found.steps > 3000, "{}", found.steps);
    assert!(is_definite(&found.lower));
    // S = S/(S + 1) + V, that is S² = V(S + 1).
    let sign = |s: &Q| number(s) * number(s) - ratio(1, 1_000_000) * (number(s) + ratio(1, 1));
    assert!(sign(&found.lower) < ratio(0, 1) && sign(&found.upper) > ratio(0, 1));
    assert!(found.lower.entries()[0].denom().bits() < 100);
}
