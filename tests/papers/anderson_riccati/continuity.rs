//! Corollary 2.2: the fixed point is a continuous function of A, V and W, while V > 0.

use exact_kalman::matrix::Matrix;
use exact_kalman::riccati::{FixedPointEnclosure, FixedPointError};
use exact_kalman::scalar::{Rational, ratio};
use proptest::prelude::*;

use super::draws::{Constructed, Q, constructed, integers, inverse, le, map, matrices, number, scalar, semidefinite};

/// The fixed point of (A, V, W) within the given gap, or what a thousand steps reach.
fn enclosed(a: &Q, v: &Q, w: &Q, gap: &Rational) -> FixedPointEnclosure {
    match map(a, v, w).fixed_point(gap, 1000) {
        // What is reached is an enclosure as well, if a wider one.
        Ok(found) | Err(FixedPointError::TooFewSteps { reached: found }) => found,
        Err(error) => panic!("{error}"),
    }
}

fn distance(found: &FixedPointEnclosure, t: &Q) -> Rational {
    // ‖S − T‖ ≤ ‖lower − T‖ + ‖upper − lower‖, squared with 2(x² + y²) ≥ (x + y)².
    ratio(2, 1) * ((&found.lower - t).squared_norm() + found.squared_gap())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    /// AK-C2.2, AK-4.3: let (A, V, W) approach a map with known fixed point T along a line. Each S∞(n) is below A(n)W(n)A(n)ᵀ + V(n),
    /// above V(n), and comes within every ε of T; W may be singular at the limit and off it.
    #[test]
    fn fixed_points_follow_the_model(
        (Constructed { a, v, w, t }, da, dv, dw) in (1usize..=2).prop_flat_map(|n| (constructed(n), matrices(n, n, 3), semidefinite(n), semidefinite(n)))
    ) {
        let mut wanted = [ratio(1, 1), ratio(1, 100), ratio(1, 10_000)].into_iter().peekable();
        for n in 0..40_u32 {
            let share = ratio(1, 1 << n);
            let (a, v, w) = (&a + da.scaled(&share), &v + dv.scaled(&share), &w + dw.scaled(&share));
            let Some(epsilon) = wanted.peek() else { break };
            let found = enclosed(&a, &v, &w, &(epsilon / ratio(4, 1)));
            let bound = a.congruence(&w) + &v;
            prop_assert!(le(&v, &found.upper) && le(&found.lower, &bound));
            // The enclosure is inside the bounds of AK-4.3 but for its gap.
            if distance(&found, &t) <= epsilon * epsilon {
                wanted.next();
            }
        }
        prop_assume!(map(&a, &v, &w).closed_loop(&t).spectral_radius_lt(&ratio(9, 10)) || wanted.peek().is_none());
        prop_assert_eq!(wanted.next(), None, "S∞(n) stays away from S∞");
    }

    /// AK-C2.2: with more noise, V + εE and W + εF for E, F ≥ 0, the fixed point moves from T up by at most εX, where
    /// X − DXDᵀ = E + KFKᵀ with the loop D of T and K = AT(T + W)⁻¹: φ is monotone and concave in S, V and W together, so
    /// that it lies below its tangent. Enclosures see it at every ε.
    #[test]
    fn more_noise_moves_the_fixed_point_by_a_stein_solution(
        (Constructed { a, v, w, t }, e, f) in (1usize..=2).prop_flat_map(|n| (constructed(n), semidefinite(n), semidefinite(n)))
    ) {
        let d = map(&a, &v, &w).closed_loop(&t);
        let k = &a * &t * inverse(&(&t + &w));
        let x = d.stein_solution(&(&e + k.congruence(&f))).unwrap_or_else(|error| panic!("ρ(D) < 1, but {error}"));
        for epsilon in [ratio(1, 1), ratio(1, 1 << 10), ratio(1, 1 << 30)] {
            let (v, w) = (&v + e.scaled(&epsilon), &w + f.scaled(&epsilon));
            let found = enclosed(&a, &v, &w, &(&epsilon / ratio(1000, 1)));
            prop_assert!(le(&t, &found.upper));
            prop_assert!(le(&found.lower, &(&t + x.scaled(&epsilon))));
        }
    }
}

/// Erratum AK-4.3: printed, a limit point of S₀, which is one matrix. Of the sequence it is meant: A(n) = 1, W(n) = 2,
/// V(n) = T²/(T + 2) with T = S∞(n) = 2 + 1/n has the limit point 2, which solves the limit's equation; one matrix, S∞(1) = 3
/// for instance, has no limit point, and does not solve it.
#[test]
fn the_sequence_has_a_limit_point() {
    let fixed = |n: i64| ratio(2, 1) + ratio(1, n);
    let (one, two) = (integers(&[[1]]), integers(&[[2]]));
    let limit = map(&one, &one, &two);
    for n in [1, 2, 5, 10, 100, 1000] {
        let t = fixed(n);
        let v = &t * &t / (&t + ratio(2, 1));
        let map = map(&one, &scalar(v), &two);
        let t = scalar(t);
        assert_eq!(map.image(&t), t);
        assert!(le(&t, &map.upper_bound()) && le(map.state_noise(), &t));
    }
    // Every neighbourhood of 2 holds all but finitely many; none of 3 holds another than the first.
    for epsilon in [ratio(1, 10), ratio(1, 1000)] {
        let near = |centre: i64, n: i64| {
            let error = fixed(n) - ratio(centre, 1);
            -&epsilon < error && error < epsilon
        };
        assert!((1001..1100).all(|n| near(2, n)));
        assert!((2..1100).all(|n| !near(3, n)));
    }
    assert_eq!(limit.image(&two), two);
    assert_ne!(limit.image(&scalar(fixed(1))), scalar(fixed(1)));
}

/// AK-4.3: a limit point is positive definite since S∞(n) ≥ V(n) → V > 0; without that it may be 0: V(n) = 1/n², A = 1, W = 1
/// has S∞(n) < 2/n.
#[test]
fn limit_points_are_definite_because_the_noise_is() {
    let one = integers(&[[1]]);
    for n in [2, 10, 100] {
        let v = scalar(ratio(1, n * n));
        let found = enclosed(&one, &v, &one, &ratio(1, 10 * n * n));
        assert!(le(&v, &found.upper));
        assert!(number(&found.upper) < ratio(2, n));
    }
}

/// AK-C2.2: V > 0 is needed: W = 1 and V → 0 has S∞ → 3 for A = 2, though 0 is fixed too for V = 0, and S∞ → 0 for A = 1/2,
/// where no positive matrix is fixed.
#[test]
fn without_state_noise_there_is_nothing_to_be_continuous() {
    let one = integers(&[[1]]);
    for power in [4, 10, 20] {
        let v = scalar(ratio(1, 1 << power));
        for (a, limit) in [(ratio(2, 1), 3), (ratio(1, 2), 0)] {
            let found = enclosed(&scalar(a), &v, &one, &ratio(1, 1 << power));
            // S² + (1 − A² − V)S = V: within 4V of the limit.
            let bound = ratio(8, 1 << power);
            for end in [&found.lower, &found.upper] {
                let error = number(end) - ratio(limit, 1);
                assert!(error < bound && -error < bound);
            }
        }
    }
    let still = map(&integers(&[[2]]), &integers(&[[0]]), &one);
    assert_eq!(still.image(&integers(&[[0]])), Matrix::zeros(1, 1));
}
