//! The statements of chapter EK without each hypothesis. (That L1 to L6 hold: `agree::squares`.)

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use proptest::collection::vec;
use proptest::prelude::*;

use super::models::{Q, inverse, is_definite, is_semidefinite, le, matrices, scalar, semidefinite};
use super::search::{counterexample, holds_where, holds_without};

/// x₊ = A x + w, y = H x + v, one reading, cov(w; v) = M; and a covariance P.
#[derive(Clone, Debug)]
struct Step {
    a: Q,
    h: Q,
    noise: Q,
    p: Q,
}

impl Step {
    fn states(&self) -> usize {
        self.a.rows()
    }

    /// Γ = A P Hᵀ + S and Σ = H P Hᵀ + R.
    fn covariances(&self) -> [Q; 2] {
        let n = self.states();
        let (s, r) = (self.noise.block(0..n, n..n + 1), self.noise.block(n..n + 1, n..n + 1));
        [&self.a * &self.p * self.h.transpose() + s, self.h.congruence(&self.p) + r]
    }

    fn gain(&self) -> Q {
        let [gamma, sigma] = self.covariances();
        gamma * sigma.pseudo_inverse().expect("over an ordered field")
    }

    /// φ(P)
    fn map(&self) -> Q {
        let n = self.states();
        let [gamma, sigma] = self.covariances();
        let spent = gamma.congruence(&sigma.pseudo_inverse().expect("over an ordered field"));
        self.a.congruence(&self.p) + self.noise.block(0..n, 0..n) - spent
    }

    fn joseph(&self, gain: &Q) -> Q {
        let weights = Matrix::identity(self.states()).beside(&-gain);
        (&self.a - gain * &self.h).congruence(&self.p) + weights.congruence(&self.noise)
    }

    fn at(&self, p: Q) -> Self {
        Self { p, ..self.clone() }
    }
}

fn symmetric(n: usize) -> impl Strategy<Value = Q> {
    matrices(n, n, 2).prop_map(|a| &a + a.transpose())
}

/// Whether M and P are semidefinite, or only symmetric.
fn steps(noise: bool, p: bool) -> impl Strategy<Value = Step> {
    let one = |n, sign: bool| if sign { semidefinite(n).boxed() } else { symmetric(n).boxed() };
    (1_usize..=2)
        .prop_flat_map(move |n| (matrices(n, n, 2), matrices(1, n, 2), one(n + 1, noise), one(n, p)))
        .prop_map(|(a, h, noise, p)| Step { a, h, noise, p })
}

/// ΓΣ⁺Σ = Γ
fn is_in_range(step: &Step) -> bool {
    let [gamma, sigma] = step.covariances();
    step.gain() * sigma == gamma
}

/// EK-L2: needs P ≥ 0, and M ≥ 0.
#[test]
fn the_range_needs_both_signs() {
    holds_without(steps(true, true), is_in_range);
    assert!(!is_semidefinite(&counterexample(steps(true, false), is_in_range).p));
    assert!(!is_semidefinite(&counterexample(steps(false, true), is_in_range).noise));
}

/// EK-L1, EK-L3: the form of Joseph asks for no sign; that it is at least φ(P) needs P ≥ 0, and M ≥ 0.
#[test]
fn the_bound_by_any_gain_needs_both_signs() {
    let with_gain = |noise, p| {
        steps(noise, p).prop_flat_map(|step| {
            let n = step.states();
            (Just(step), matrices(n, 1, 2))
        })
    };
    let expanded = |(step, gain): &(Step, Q)| {
        let n = step.states();
        let [gamma, sigma] = step.covariances();
        let mixed = gain * gamma.transpose();
        let q = step.noise.block(0..n, 0..n);
        step.joseph(gain) == step.a.congruence(&step.p) + q - &mixed - mixed.transpose() + gain.congruence(&sigma)
    };
    holds_without(with_gain(false, false), expanded);
    let is_bound = |(step, gain): &(Step, Q)| le(&step.map(), &step.joseph(gain));
    holds_without(with_gain(true, true), is_bound);
    assert!(!is_semidefinite(&counterexample(with_gain(true, false), is_bound).0.p));
    assert!(!is_semidefinite(&counterexample(with_gain(false, true), is_bound).0.noise));
    // Σ > 0 is enough in place of both.
    holds_where(with_gain(false, false), |(step, _)| is_definite(&step.covariances()[1]), is_bound);
}

/// EK-L4: φ is monotone for P, P′ ≥ 0, or Σ > 0 at both; not otherwise.
#[test]
fn monotony_needs_a_sign() {
    let with_more = |p| {
        steps(true, p).prop_flat_map(|step| {
            let n = step.states();
            (Just(step), semidefinite(n))
        })
    };
    let is_monotone = |(step, more): &(Step, Q)| le(&step.map(), &step.at(&step.p + more).map());
    holds_without(with_more(true), is_monotone);
    let (step, more) = counterexample(with_more(false), is_monotone);
    let innovations = [step.covariances(), step.at(&step.p + &more).covariances()];
    assert!(!is_semidefinite(&step.p) && !innovations.iter().all(|[_, sigma]| is_definite(sigma)));
    holds_where(with_more(false), |(step, _)| is_definite(&step.covariances()[1]), is_monotone);
    // Without P ≤ P′.
    let pairs = steps(true, true).prop_flat_map(|step| {
        let n = step.states();
        (Just(step), semidefinite(n))
    });
    let (step, other) = counterexample(pairs, |(step, other)| le(&step.map(), &step.at(other.clone()).map()));
    assert!(!le(&step.p, &other));
}

/// EK-L5: ZXZ ≤ tr(XW) W needs both −W ≤ Z and Z ≤ W, and X ≥ 0.
#[test]
fn gaps_need_both_sides() {
    let models = |x: bool| {
        (1_usize..=2).prop_flat_map(move |n| {
            let weights = if x { semidefinite(n).boxed() } else { symmetric(n).boxed() };
            (symmetric(n), semidefinite(n), weights)
        })
    };
    let is_bounded = |(z, w, x): &(Q, Q, Q)| le(&z.congruence(x), &w.scaled(&(x * w).trace()));
    let below = |z: &Q, w: &Q| le(z, w);
    let is_between = |(z, w, _): &(Q, Q, Q)| below(z, w) && below(&-z, w);
    holds_where(models(true), is_between, is_bounded);
    for sign in [1, -1] {
        let (z, w, _) = counterexample(models(true), |model| {
            !below(&model.0.scaled(&ratio(sign, 1)), &model.1) || is_bounded(model)
        });
        assert!(!below(&z.scaled(&ratio(-sign, 1)), &w));
    }
    let (_, _, x) = counterexample(models(false), |model| !is_between(model) || is_bounded(model));
    assert!(!is_semidefinite(&x));
}

/// EK-L6: `D = diag(sᵢ² Σⱼ cᵢⱼ)` bounds e if |eᵢⱼ| ≤ cᵢⱼ sᵢ sⱼ for all entries; one diagonal entry that is larger is enough to
/// fail. c must be symmetric: D of an unsymmetric c bounds nothing.
#[test]
fn rounding_needs_bounds_for_every_entry() {
    type Model = (Vec<i64>, Vec<i64>, Vec<i64>);
    let models = || (vec(0_i64..4, 4), vec(-4_i64..5, 3), vec(1_i64..4, 2));
    let parts = |(c, e, s): &Model| {
        let c = Matrix::<Rational>::from_integers(&[[c[0], c[1]], [c[2], c[3]]]);
        let e = Matrix::<Rational>::from_integers(&[[e[0], e[1]], [e[1], e[2]]]);
        (c, e, [ratio(s[0], 1), ratio(s[1], 1)])
    };
    let within = |model: &Model, symmetric: bool, all: bool| {
        let (c, e, s) = parts(model);
        let fits = |i: usize, j: usize| {
            let bound = &c[(i, j)] * &s[i] * &s[j];
            e[(i, j)] <= bound && -&e[(i, j)] <= bound
        };
        (!symmetric || c[(0, 1)] == c[(1, 0)])
            && fits(0, 1)
            && fits(1, 1)
            && (!all || (fits(0, 0) && (!symmetric || fits(1, 0))))
    };
    let is_bounded = |model: &Model| {
        let (c, e, s) = parts(model);
        let pad = |i: usize| &s[i] * &s[i] * (&c[(i, 0)] + &c[(i, 1)]);
        let d = Matrix::diagonal(&[pad(0), pad(1)]);
        le(&e, &d) && le(&-&e, &d)
    };
    holds_where(models(), |model| within(model, true, true), is_bounded);
    counterexample(models(), |model| !within(model, true, false) || is_bounded(model));
    let (c, ..) = counterexample(models(), |model| !within(model, false, true) || is_bounded(model));
    assert_ne!(c[1], c[2]);
}

/// T, Σ̃, H, W ≥ 0, and P̃ − P = Z between ±W, one reading: Σ = Σ̃ + HZHᵀ.
type Regular = (Rational, Rational, Q, Q, Rational);

fn regular() -> impl Strategy<Value = Regular> {
    let fraction = |least: i64| (least..9, 1_i64..5).prop_map(|(a, b)| ratio(a, b));
    (fraction(-8), fraction(-8), matrices(1, 2, 2), semidefinite(2), (-8_i64..9).prop_map(|a| ratio(a, 8)))
}

/// EK-L7: κ > 0 gives Σ > 0 and Σ⁻¹ ≤ TᵀT/κ; without κ > 0 neither; nor without the gap counted in w, or Z between ±W.
#[test]
fn regular_innovations_need_a_positive_rest() {
    let one = || ratio(1, 1);
    let kappa = |(t, sigma, h, w, _): &Regular, with_gap: bool| {
        let distance = t * sigma * t - one();
        let eta = if distance < ratio(0, 1) { -distance } else { distance };
        let gap = t * t * &h.congruence(w)[(0, 0)];
        one() - eta - if with_gap { gap } else { ratio(0, 1) }
    };
    let claim = |model: &Regular, kappa: &Rational, stretch: i64| {
        let (t, sigma, h, w, share) = model;
        let truth = sigma + &h.congruence(w)[(0, 0)] * share * ratio(stretch, 1);
        // κ ≤ T Σ Tᵀ is Σ⁻¹ ≤ TᵀT/κ.
        truth > ratio(0, 1) && *kappa <= t * &truth * t
    };
    let if_positive = |model: &Regular, with_gap: bool, stretch: i64| {
        let kappa = kappa(model, with_gap);
        kappa <= ratio(0, 1) || claim(model, &kappa, stretch)
    };
    holds_where(regular(), |model| kappa(model, true) > ratio(0, 1), |model| claim(model, &kappa(model, true), 1));
    counterexample(regular(), |model| if_positive(model, false, 1));
    counterexample(regular(), |model| if_positive(model, true, 9));
    let model = counterexample(regular(), |model| claim(model, &kappa(model, true), 1));
    assert!(kappa(&model, true) <= ratio(0, 1));
}

/// A = B((Λ, above), (0, D))B⁻¹, H = (first, h)B⁻¹, and any gain: N = the first column of B.
#[derive(Clone, Debug)]
struct Unseen {
    lambda: i64,
    rest: [i64; 2],
    first: i64,
    h: i64,
    basis: Q,
    gain: Q,
}

fn unseen(lambda: std::ops::Range<i64>, first: std::ops::Range<i64>) -> impl Strategy<Value = Unseen> {
    (lambda, [-2_i64..3, -2_i64..3], first, -2_i64..3, matrices(2, 2, 2), matrices(2, 1, 4)).prop_filter_map(
        "a basis",
        |(lambda, rest, first, h, basis, gain)| {
            (basis.rank() == 2).then_some(Unseen { lambda, rest, first, h, basis, gain })
        },
    )
}

/// ρ(A − KH) ≥ 1, with Λ in quarters.
fn stays_unstable(model: &Unseen) -> bool {
    let Unseen { lambda, rest, first, h, basis, gain } = model;
    let entry = |value: i64| ratio(value, 4);
    let block =
        Matrix::from_fn(2, 2, |i, j| [[entry(*lambda), entry(rest[0])], [entry(0), entry(rest[1])]][i][j].clone());
    let back = inverse(basis);
    let (a, h) = (basis * block * &back, Matrix::from_integers(&[[*first, *h]]) * back);
    !(a - gain * h).spectral_radius_lt(&ratio(1, 1))
}

/// EK-T7a: an unstable mode that is not seen stays, whatever the gain; one that is seen need not, nor one that is stable.
#[test]
fn modes_stay_if_they_are_unseen_and_unstable() {
    for unstable in [4..13, -12..-3] {
        holds_without(unseen(unstable, 0..1), stays_unstable);
    }
    let seen = counterexample(unseen(4..9, -2..3), stays_unstable);
    assert_ne!(seen.first, 0);
    let stable = counterexample(unseen(-12..13, 0..1), stays_unstable);
    assert!(stable.lambda.abs() < 4);
}

/// A = λ + yh, cov(w; v) = R (y, 1)(y, 1)ᵀ + E: noise that is the reading's own, and more by E; a scalar state and a P.
type Reached = (i64, i64, i64, i64, i64, Rational);

fn reached(&(lambda, y, h, r, more, ref p): &Reached) -> Step {
    let noise = Matrix::<Rational>::from_integers(&[[r * y * y + more, r * y], [r * y, r]]);
    Step { a: scalar(ratio(lambda, 2) + ratio(y * h, 1)), h: scalar(ratio(h, 1)), noise, p: scalar(p.clone()) }
}

/// Whether P solves the equation with Σ > 0.
fn is_solution(model: &Reached) -> bool {
    let step = reached(model);
    is_definite(&step.covariances()[1]) && step.map() == step.p
}

/// Whether its loop is not stable.
fn is_unstable(model: &Reached) -> bool {
    let step = reached(model);
    !(&step.a - step.gain() * &step.h).spectral_radius_lt(&ratio(1, 1))
}

/// EK-T7b: with a mode on the circle that no noise reaches no solution of the scalar equation has a stable loop; off the circle, and
/// with noise, one may.
#[test]
fn modes_on_the_circle_stay_without_noise() {
    let models = |on_circle: bool, more: std::ops::Range<i64>| {
        let lambda = if on_circle { prop_oneof![Just(2_i64), Just(-2)].boxed() } else { (-6_i64..7).boxed() };
        (lambda, -2_i64..3, -2_i64..3, 0_i64..4, more, (-12_i64..30, 1_i64..5).prop_map(|(a, b)| ratio(a, b)))
    };
    let stays = |model: &Reached| !is_solution(model) || is_unstable(model);
    holds_where(models(true, 0..1), is_solution, is_unstable);
    let (lambda, ..) = counterexample(models(false, 0..1), stays);
    assert_ne!(lambda.abs(), 2);
    let (lambda, _, _, _, more, p) = counterexample(models(true, 0..8), stays);
    assert!(lambda.abs() == 2 && more > 0 && p > ratio(0, 1));
}

/// EK-T5, EK-T6: a scalar model whose fixed point is known lies in the set; the set must be mapped into itself.
#[test]
fn sets_that_are_not_mapped_into_themselves_hold_no_fixed_point() {
    // φ(P) = P/(P + 1) + V on [s − e, s + e]; monotone, so the ends decide.
    let models = (1_i64..9, 0_i64..12, 1_i64..12);
    let phi = |v: i64, p: &Rational| p / (p + ratio(1, 1)) + ratio(v, 8);
    let ends = |s: i64, e: i64| [ratio(s - e, 4), ratio(s + e, 4)];
    let is_mapped = |v: i64, s: i64, e: i64| {
        let [low, high] = ends(s, e);
        low >= ratio(0, 1) && phi(v, &low) >= low && phi(v, &high) <= high
    };
    // A fixed point lies between low ≥ 0 and high exactly if φ − 1 changes its sign there: P² − VP − V = 0 has one root P > 0.
    let holds_one = |v: i64, s: i64, e: i64| {
        let value = |p: &Rational| p * p - ratio(v, 8) * p - ratio(v, 8);
        let [low, high] = ends(s, e);
        (low < ratio(0, 1) || value(&low) <= ratio(0, 1)) && value(&high) >= ratio(0, 1)
    };
    holds_where(models.clone(), |&(v, s, e)| is_mapped(v, s, e), |&(v, s, e)| holds_one(v, s, e));
    let (v, s, e) = counterexample(models, |&(v, s, e)| holds_one(v, s, e));
    assert!(!is_mapped(v, s, e));
}
