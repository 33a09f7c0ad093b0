//! Theorem 2.4 and its proof: deterministic sequences Â(n) → A, V̂(n) → V, Ŵ(n) → W, and exact iterates.

use exact_kalman::identify::{Belief, EstimatedModel, NoiseCovariances};
use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};

use super::numbers::{Draws, Q, integers, inverse, modulus, number, riccati};

/// A system whose fixed point is known and rational, with what its estimates are off by at n = 1.
pub struct Limit {
    pub a: Q,
    pub v: Q,
    pub w: Q,
    /// S∞
    pub s: Q,
    e: Q,
    f: Q,
    g: Q,
}

impl Limit {
    /// V is chosen such that S∞ = s: V = s − A(s:W)Aᵀ.
    fn with_fixed_point(a: Q, s: Q, w: Q, e: Q, f: Q, g: Q) -> Self {
        let zero = Matrix::zeros(a.rows(), a.rows());
        let v = &s - riccati(&a, &zero, &w, &s);
        assert!(v.ldl().is_ok_and(|ldl| ldl.is_positive_definite()), "V > 0: {v}");
        Self { a, v, w, s, e, f, g }
    }

    /// A stable scalar system, an unstable one, a stable one of order 2, and an unstable one with singular W.
    pub fn examples() -> Vec<Self> {
        let scalar = |a: Rational, s: i64, w: i64| {
            let [e, f, g] = [ratio(1, 2), ratio(3, 1), ratio(1, 1)].map(number);
            Self::with_fixed_point(number(a), integers(&[[s]]), integers(&[[w]]), e, f, g)
        };
        let two = |a: Q, s: Q, w: Q| {
            let e = integers(&[[1, -1], [0, 1]]).scaled(&ratio(1, 4));
            let (f, g) = (integers(&[[2, 1], [1, 1]]), integers(&[[1, 1], [1, 1]]));
            Self::with_fixed_point(a, s, w, e, f, g)
        };
        vec![
            scalar(ratio(1, 2), 4, 2),
            scalar(ratio(2, 1), 5, 1),
            two(
                integers(&[[1, 1], [-1, 1]]).scaled(&ratio(1, 2)),
                integers(&[[4, 1], [1, 3]]),
                integers(&[[2, 1], [1, 1]]),
            ),
            two(integers(&[[2, 0], [1, 1]]), integers(&[[9, 1], [1, 5]]), integers(&[[1, 0], [0, 0]])),
        ]
    }

    /// Â(n) = A + E/n, V̂(n) = V + F/n > 0, Ŵ(n) = W + G/n ≥ 0.
    pub fn estimate(&self, n: usize) -> EstimatedModel<Rational> {
        let share = ratio(1, i64::try_from(n).unwrap_or(i64::MAX));
        let near = |limit: &Q, off: &Q| limit + off.scaled(&share);
        let noise = NoiseCovariances { process: near(&self.v, &self.f), observation: near(&self.w, &self.g) };
        EstimatedModel { transition: near(&self.a, &self.e), noise }
    }

    pub fn truth(&self) -> EstimatedModel<Rational> {
        let noise = NoiseCovariances { process: self.v.clone(), observation: self.w.clone() };
        EstimatedModel { transition: self.a.clone(), noise }
    }

    /// Ŝ(k) and Δ̂(k), k = 1, …, n, by (2.3) from P̂(0).
    pub fn run(&self, n: usize, start: &Q, model: impl Fn(usize) -> EstimatedModel<Rational>) -> Vec<(Q, Q)> {
        let p = self.a.rows();
        let mut belief = Belief { mean: Matrix::zeros(p, 1), covariance: start.clone() };
        let step = |k: usize| {
            let (s, gain, next) =
                belief.advanced(&model(k), &Matrix::zeros(p, 1)).unwrap_or_else(|error| panic!("{error}"));
            belief = next;
            (s, gain)
        };
        (1..=n).map(step).collect()
    }

    fn p(&self) -> usize {
        self.a.rows()
    }
}

/// The largest modulus of an entry.
fn size(matrix: &Q) -> Rational {
    matrix.entries().iter().map(modulus).max().unwrap_or_default()
}

/// Whether low ≤ middle ≤ high in the Loewner order.
fn between(low: &Q, middle: &Q, high: &Q) -> bool {
    low.loewner_le(middle).is_ok() && middle.loewner_le(high).is_ok()
}

/// The fixed point that the examples are built on is the limit, by an enclosure of its own: φⁿ(V) ≤ S∞ ≤ φⁿ(AWAᵀ + V),
/// and the gap closes.
#[test]
fn the_fixed_points_are_enclosed() {
    for limit in Limit::examples() {
        let phi = |s: &Q| riccati(&limit.a, &limit.v, &limit.w, s);
        let (mut low, mut high) = (limit.v.clone(), limit.a.congruence(&limit.w) + &limit.v);
        for _ in 0..12 {
            assert!(between(&low, &limit.s, &high));
            (low, high) = (phi(&low), phi(&high));
        }
        assert!(size(&(high - low)) < ratio(1, 10));
        assert_eq!(phi(&limit.s), limit.s);
    }
}

/// Whether k·error(k) is the same at k = 20 and k = 40 to 5 %: the error falls like 1/k, to zero.
fn falls_like_the_estimates(run: &[Q], limit: &Q) -> bool {
    let [early, late] = [20, 40].map(|k: i64| {
        let place = usize::try_from(k).unwrap_or(1) - 1;
        size(&(&run[place] - limit)) * ratio(k, 1)
    });
    let slack = ratio(21, 20);
    early <= &late * &slack && late <= early * slack
}

/// AK-T2.4, AK-C2.3: Ŝ(k) → S∞ and Δ̂(k) → Δ∞ from several P̂(0), one of them zero, for stable and unstable A, and for singular
/// W. As the estimates are off by a multiple of 1/k, k times the error settles: at k = 20 and 40 it is the same to 5 %. For a
/// limit that is off by 1/20 in every entry it is not.
#[test]
fn estimated_covariances_converge() {
    for limit in Limit::examples() {
        let p = limit.p();
        let gain = &limit.s * inverse(&(&limit.s + &limit.w));
        for start in [Matrix::zeros(p, p), Matrix::identity(p).scaled(&ratio(1000, 1))] {
            let (covariances, gains): (Vec<Q>, Vec<Q>) =
                limit.run(40, &start, |n| limit.estimate(n)).into_iter().unzip();
            for (run, target) in [(covariances, &limit.s), (gains, &gain)] {
                assert!(falls_like_the_estimates(&run, target));
                for off in [ratio(1, 20), ratio(-1, 20)] {
                    assert!(!falls_like_the_estimates(&run, &target.map(|entry| entry + &off)), "{off}");
                }
            }
        }
    }
}

/// AK-T2.4 needs V̂(n) > 0: with V̂(n) = V = 0, A = 2, W = 1 the limit is 0 from Ŝ(1) = 0, and 3 from every Ŝ(1) > 0, as
/// 1/Ŝ(k) − 1/3 = (1/4)ᵏ⁻¹(1/Ŝ(1) − 1/3) exactly.
#[test]
fn without_process_noise_the_limit_depends_on_the_start() {
    let zero = Matrix::zeros(1, 1);
    let limit = |p0: Rational| {
        let unused = zero.clone();
        let limit = Limit {
            a: integers(&[[2]]),
            v: zero.clone(),
            w: integers(&[[1]]),
            s: unused.clone(),
            e: unused.clone(),
            f: unused.clone(),
            g: unused,
        };
        let run = limit.run(12, &number(p0), |_| limit.truth());
        run.into_iter().map(|(s, _)| s[(0, 0)].clone()).collect::<Vec<_>>()
    };
    assert!(limit(ratio(0, 1)).iter().all(|s| *s == ratio(0, 1)));
    for p0 in [ratio(1, 1000), ratio(1, 1), ratio(70, 1)] {
        let s = limit(p0);
        let gap = |k: usize| ratio(1, 1) / &s[k - 1] - ratio(1, 3);
        assert!((1..=12).all(|k| gap(k) == gap(1) / ratio(4_i64.pow(u32::try_from(k).unwrap_or(1) - 1), 1)));
    }
}

/// φ_n(S) = Â(n)(S:Ŵ(n−1))Â(n)ᵀ + V̂(n)
fn phi_n(limit: &Limit, n: usize, s: &Q) -> Q {
    let (model, before) = (limit.estimate(n), limit.estimate(n - 1));
    riccati(&model.transition, &model.noise.process, &before.noise.observation, s)
}

/// AK-5-phi, AK-5-comp: for n ≥ 2 the recursion (2.3) is φ_n, with the Ŵ of the step before, composed in this order.
#[test]
fn recursion_eq_composed_maps() {
    for limit in Limit::examples() {
        let run = limit.run(8, &Matrix::identity(limit.p()), |n| limit.estimate(n));
        let mut composed = run[0].0.clone();
        assert!(composed.ldl().is_ok_and(|ldl| ldl.is_positive_definite()), "Ŝ(1) > 0");
        for n in 2..=8 {
            assert_eq!(phi_n(&limit, n, &run[n - 2].0), run[n - 1].0);
            composed = phi_n(&limit, n, &composed);
            assert_eq!(composed, run[n - 1].0);
        }
    }
}

/// Erratum AK-5-phi: at n = 1, which is printed, φ_1 would need Ŵ(0). With Ŵ(1) in its place and P̂(0) for the covariance
/// before, Â = V̂ = Ŵ = P̂(0) = 1 gives 3/2, where (2.3) has Ŝ(1) = 2; at n = 2 all fits.
#[test]
fn the_maps_begin_at_two() {
    let one = number(ratio(1, 1));
    let zero = Matrix::zeros(1, 1);
    let limit = Limit {
        a: one.clone(),
        v: one.clone(),
        w: one.clone(),
        s: zero.clone(),
        e: zero.clone(),
        f: zero.clone(),
        g: zero,
    };
    let run = limit.run(2, &one, |_| limit.truth());
    assert_eq!(run[0].0, number(ratio(2, 1)));
    assert_eq!(riccati(&one, &one, &one, &one), number(ratio(3, 2)));
    assert_eq!(riccati(&one, &one, &one, &run[0].0), run[1].0);
}

/// AK-5-compact: V̂(n) ≤ φ_n(S) ≤ Â(n)Ŵ(n−1)Â(n)ᵀ + V̂(n) for random S > 0, tiny and huge ones, and hence one compact set
/// cI ≤ S ≤ CI with c > 0 for all n; on it φ_n → φ, at the rate 1/n.
#[test]
fn all_iterates_lie_in_a_compact_set() {
    let mut draws = Draws::seeded(51);
    for limit in Limit::examples() {
        let p = limit.p();
        let identity = Matrix::identity(p);
        // V̂(n) ≥ V > 0, and the upper bounds fall with n.
        let model = limit.estimate(2);
        let top = model.transition.congruence(&limit.estimate(1).noise.observation) + &model.noise.process;
        let ceiling = identity.scaled(&(ratio(4, 1) * (0..p).map(|i| top[(i, i)].clone()).sum::<Rational>()));
        let floor = identity.scaled(&ratio(1, 1000));
        assert!(floor.loewner_le(&limit.v).is_ok());
        let scales = [ratio(1, 1_000_000), ratio(1, 1), ratio(1_000_000, 1)];
        let starts: Vec<Q> = scales.iter().map(|scale| draws.definite(p).scaled(scale)).collect();
        let gap = |n: usize, s: &Q| size(&(phi_n(&limit, n, s) - riccati(&limit.a, &limit.v, &limit.w, s)));
        for s in &starts {
            for n in [2, 3, 5, 9, 50] {
                let (model, before) = (limit.estimate(n), limit.estimate(n - 1));
                let image = phi_n(&limit, n, s);
                let bound = model.transition.congruence(&before.noise.observation) + &model.noise.process;
                assert!(between(&model.noise.process, &image, &bound));
                assert!(between(&floor, &image, &ceiling));
            }
            let inside = phi_n(&limit, 2, s);
            for n in [10, 20, 40, 80] {
                // Twice the rate at n = 10 bounds all later ones.
                let share = ratio(20, i64::try_from(n).unwrap_or(i64::MAX));
                assert!(gap(n, &inside) <= gap(10, &inside) * share);
            }
        }
    }
}

/// AK-5-r: the r for which the enclosure is ε wide serves all starts, from εI to I/ε and beyond.
#[test]
fn one_number_of_steps_for_all_starts() {
    let epsilon = ratio(1, 1000);
    for limit in Limit::examples() {
        let phi = |s: &Q| riccati(&limit.a, &limit.v, &limit.w, s);
        let (mut low, mut high) = (limit.v.clone(), limit.a.congruence(&limit.w) + &limit.v);
        let mut steps = 1;
        while (0..limit.p()).map(|i| &high[(i, i)] - &low[(i, i)]).sum::<Rational>() > epsilon {
            (low, high, steps) = (phi(&low), phi(&high), steps + 1);
        }
        assert!((2..40).contains(&steps), "{steps}");
        for scale in [ratio(1, 1_000_000_000), ratio(1, 1), ratio(1_000_000_000, 1)] {
            let start = Matrix::identity(limit.p()).scaled(&scale);
            let reached = (0..steps).fold(start, |s, _| phi(&s));
            assert!(size(&(reached - &limit.s)) <= epsilon);
        }
    }
}

/// AK-5-limsup: Ŝ(k) and φʳ(Ŝ(k − r)) come together as k grows, for fixed r, and both come to S∞.
#[test]
fn late_iterates_are_iterates_of_the_limit_map() {
    for limit in Limit::examples() {
        let run = limit.run(64, &Matrix::identity(limit.p()), |n| limit.estimate(n));
        let phi = |s: Q| riccati(&limit.a, &limit.v, &limit.w, &s);
        let gap = |k: usize| {
            let mapped = (0..3).fold(run[k - 4].0.clone(), |s, _| phi(s));
            size(&(&run[k - 1].0 - mapped))
        };
        assert!(gap(16) > ratio(0, 1) && gap(64) * ratio(2, 1) < gap(16));
    }
}

/// Erratum AK-5-limsup: the limit over i is of Ŝ(k_i). Along k_i = 8, 16, 32, 64 it comes to S∞; Ŝ(k) with k fixed, as
/// printed, does not depend on i: with P̂(0) = 0 and A = 1/2 it stays where it is, at Ŝ(1) ≠ S∞.
#[test]
fn the_limit_is_along_a_subsequence() {
    let limit = &Limit::examples()[0];
    let run = limit.run(64, &Matrix::zeros(1, 1), |n| limit.estimate(n));
    let distance = |k: usize| size(&(&run[k - 1].0 - &limit.s));
    assert!([8, 16, 32].iter().all(|&k| distance(2 * k) < distance(k)));
    assert!(distance(64) < ratio(1, 10));
    assert!(distance(1) > ratio(1, 10));
}
