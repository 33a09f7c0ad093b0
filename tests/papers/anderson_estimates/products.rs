//! Section 5: the filters as sums of products, the limit of their transitions, and products that contract.

use exact_kalman::identify::{Belief, EstimatedModel, NoiseCovariances};
use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};

use super::adaptive_limits::Limit;
use super::numbers::{Draws, Q, integers, inverse, number, power, riccati, squared_norm, total, trace};

/// A run of (2.3), (2.4), or of (1.3), (1.4) if the model is the truth: (Δ(k), G(k), x(k|k)) for k = 1, 2, ….
fn run(models: &[EstimatedModel<Rational>], start: &Belief<Rational>, readings: &[Q]) -> Vec<(Q, Q, Q)> {
    let mut belief = start.clone();
    let step = |(model, y): (&EstimatedModel<Rational>, &Q)| {
        let (_, gain, next) = belief.advanced(model, y).unwrap_or_else(|error| panic!("{error}"));
        belief = next;
        let g = (Matrix::identity(gain.rows()) - &gain) * &model.transition;
        (gain, g, belief.mean.clone())
    };
    models.iter().zip(readings).map(step).collect()
}

/// G(to)⋯G(from), the larger index on the left; the identity if there is no factor.
fn product(steps: &[(Q, Q, Q)], from: usize, to: usize) -> Q {
    let p = steps[0].1.rows();
    (from..=to).fold(Matrix::identity(p), |product, k| &steps[k - 1].1 * product)
}

/// G(k)⋯G(1)x(0|0) + Σ_{j=1..k} G(k)⋯G(j+1)Δ(j)y(j)
fn expanded(steps: &[(Q, Q, Q)], k: usize, start: &Q, readings: &[Q]) -> Q {
    let term = |j: usize| product(steps, j + 1, k) * &steps[j - 1].0 * &readings[j - 1];
    product(steps, 1, k) * start + total(start.rows(), 1, (1..=k).map(term))
}

fn start(draws: &mut Draws, p: usize) -> Belief<Rational> {
    Belief { mean: draws.matrix(p, 1), covariance: draws.semidefinite(p, 1) }
}

/// AK-5-x, AK-5-xhat, AK-5-G, AK-5-Ghat: the expansions for the filter and for the adaptive filter, at every k, for
/// fixed and for changing matrices.
#[test]
fn filters_are_sums_of_products() {
    let mut draws = Draws::seeded(61);
    for limit in Limit::examples() {
        let p = limit.a.rows();
        let (start, readings) = (start(&mut draws, p), draws.readings(p, 6));
        let truth = vec![limit.truth(); 6];
        let estimated: Vec<_> = (1..=6).map(|n| limit.estimate(n)).collect();
        for models in [truth, estimated] {
            let steps = run(&models, &start, &readings);
            for k in 1..=6 {
                assert_eq!(expanded(&steps, k, &start.mean, &readings), steps[k - 1].2);
            }
        }
    }
}

/// AK-5-x: with the larger index on the right the products, whose order is not printed, give another vector:
/// p = 2, A = [[1, 1], [0, 1]], V = W = P(0) = I, x(0|0) = (0, 1), readings zero, at k = 2.
#[test]
fn the_order_of_the_factors_matters() {
    let identity = Matrix::identity(2);
    let noise = NoiseCovariances { process: identity.clone(), observation: identity.clone() };
    let model = EstimatedModel { transition: integers(&[[1, 1], [0, 1]]), noise };
    let start = Belief { mean: integers(&[[0], [1]]), covariance: identity };
    let steps = run(&[model.clone(), model], &start, &[Matrix::zeros(2, 1), Matrix::zeros(2, 1)]);
    let [one, two] = [&steps[0].1, &steps[1].1];
    assert_eq!(two * one * &start.mean, steps[1].2);
    assert_ne!(one * two * &start.mean, steps[1].2);
}

/// Erratum AK-2.4: for p = 2, Δ̂ = 0, Â = I the mean x̂ = (1, 2) is kept by I − Δ̂, a difference of two matrices of one shape; the
/// printed 1 has another shape than Δ̂.
#[test]
fn the_identity_stands_before_the_gain() {
    let identity: Q = Matrix::identity(2);
    let noise = NoiseCovariances { process: Matrix::zeros(2, 2), observation: identity.clone() };
    let model = EstimatedModel { transition: identity.clone(), noise };
    let start = Belief { mean: integers(&[[1], [2]]), covariance: Matrix::zeros(2, 2) };
    let steps = run(&[model], &start, &[integers(&[[7], [7]])]);
    let gain = &steps[0].0;
    assert!(gain.is_zero());
    assert_eq!((&identity - gain) * &start.mean, steps[0].2);
    assert_eq!(identity.shape(), gain.shape());
    assert_ne!(number(ratio(1, 1)).shape(), gain.shape(), "the printed 1");
}

/// AK-5-G-limit, AK-5-rho: G = (I − Δ∞)A = W(S∞ + W)⁻¹A; powers of it and of D = AW(S∞ + W)⁻¹ have the same traces, so
/// the same characteristic polynomial; S∞ − DS∞Dᵀ ≥ V > 0, so ρ < 1 (Lemma 4.2), and some power of G has norm below 1.
/// G(k) → G, and Ĝ(k) → G.
#[test]
fn limit_of_the_transitions() {
    for limit in Limit::examples() {
        let p = limit.a.rows();
        let weight = inverse(&(&limit.s + &limit.w));
        let g = (Matrix::identity(p) - &limit.s * &weight) * &limit.a;
        assert_eq!(g, &limit.w * &weight * &limit.a);
        let d = &limit.a * &limit.w * &weight;
        for exponent in 1..=p {
            assert_eq!(trace(&power(&g, exponent)), trace(&power(&d, exponent)));
        }
        assert!(limit.v.loewner_le(&(&limit.s - d.congruence(&limit.s))).is_ok());
        assert!((1..30).any(|exponent| squared_norm(&power(&g, exponent)) < ratio(1, 2)));
        let (readings, identity) = (vec![Matrix::zeros(p, 1); 48], Matrix::identity(p));
        let start = Belief { mean: Matrix::zeros(p, 1), covariance: identity };
        let estimated: Vec<_> = (1..=48).map(|n| limit.estimate(n)).collect();
        for models in [vec![limit.truth(); 48], estimated] {
            let steps = run(&models, &start, &readings);
            let distance = |k: usize| squared_norm(&(&steps[k - 1].1 - &g));
            // Four times as far on, a fourth of the distance: a sixteenth of its square; some slack for low k.
            assert!(distance(48) * ratio(8, 1) <= distance(12), "{} {}", distance(12), distance(48));
        }
    }
}

/// The model of AK-5-block: S∞ = W, G = A/2, two factors contract and three do not.
pub fn see_saw() -> EstimatedModel<Rational> {
    let a = Matrix::from_fn(2, 2, |i, j| match (i, j) {
        (0, 1) => ratio(40, 1),
        (1, 0) => ratio(1, 100),
        _ => ratio(0, 1),
    });
    let process = Matrix::diagonal(&[ratio(200, 1), ratio(19, 20)]);
    let observation = Matrix::diagonal(&[ratio(1000, 1), ratio(1, 1)]);
    EstimatedModel { transition: a, noise: NoiseCovariances { process, observation } }
}

/// The filter and an adaptive filter on the model of AK-5-block: Â(n) = (1 + 1/n)A, V̂(n) = (1 + 1/n)V, Ŵ = W.
pub fn see_saw_runs(steps: usize) -> [Vec<(Q, Q)>; 2] {
    let truth = see_saw();
    let start = Belief { mean: Matrix::zeros(2, 1), covariance: Matrix::identity(2) };
    let estimate = |n: usize| {
        let factor = ratio(1, 1) + ratio(1, i64::try_from(n).unwrap_or(i64::MAX));
        let process = truth.noise.process.scaled(&factor);
        let noise = NoiseCovariances { process, observation: truth.noise.observation.clone() };
        EstimatedModel { transition: truth.transition.scaled(&factor), noise }
    };
    let estimated: Vec<_> = (1..=steps).map(estimate).collect();
    [vec![truth.clone(); steps], estimated].map(|models| {
        let run = run(&models, &start, &vec![Matrix::zeros(2, 1); steps]);
        run.into_iter().map(|(gain, g, _)| (gain, g)).collect()
    })
}

/// ‖G(to)⋯G(from)‖²
fn squared(run: &[(Q, Q)], from: usize, to: usize) -> Rational {
    squared_norm(&(from..=to).fold(Matrix::identity(2), |product, k| &run[k - 1].1 * product))
}

/// AK-5-block, AK-5-vanish. Erratum AK-5-block: A = [[0, 40], [1/100, 0]], V = diag(200, 19/20), W = diag(1000, 1) has
/// S∞ = W and G = A/2 with ‖G²‖² = 1/50 < 1, so r = 2. Products of r factors, j to j + r − 1, have norms below 3/10 from
/// k₀ = 20 on, both hats on and off; those of r + 1, j to j + r as printed, have norms above 1. Long products vanish.
#[test]
fn products_of_the_right_length_contract() {
    let EstimatedModel { transition: a, noise: NoiseCovariances { process: v, observation: w } } = see_saw();
    assert_eq!(riccati(&a, &v, &w, &w), w);
    let g = &w * inverse(&(&w + &w)) * &a;
    assert_eq!(g, a.scaled(&ratio(1, 2)));
    assert_eq!(squared_norm(&power(&g, 2)), ratio(1, 50));
    assert!(squared_norm(&power(&g, 3)) > ratio(4, 1));
    for run in see_saw_runs(32) {
        for j in 20..=30 {
            assert!(squared(&run, j, j + 1) <= ratio(9, 100), "{}", squared(&run, j, j + 1));
        }
        assert!((20..=29).any(|j| squared(&run, j, j + 2) > ratio(1, 1)), "r + 1 factors");
        assert!(squared(&run, 1, 32) < ratio(1, 1_000_000));
        assert!(squared(&run, 1, 32) < squared(&run, 1, 16));
    }
}

/// AK-5-fixed: over m factors the difference goes to 0, m = 0 included: its square at j = 28 is below a fourth of that at
/// j = 7. With Δ(j) twice, as printed, it does so as well from m = 1 on, but says nothing of the terms (5.2) drops: at
/// m = 0 it is 0 whatever Δ̂(j) is.
#[test]
fn differences_over_a_fixed_span_vanish() {
    let [plain, hatted] = see_saw_runs(32);
    let over = |run: &[(Q, Q)], j: usize, m: usize, gain: &Q| {
        (j + 1..=j + m).fold(gain.clone(), |product, k| &run[k - 1].1 * product)
    };
    let gap = |j: usize, m: usize| {
        squared_norm(&(over(&hatted, j, m, &hatted[j - 1].0) - over(&plain, j, m, &plain[j - 1].0)))
    };
    for m in 0..=3 {
        assert!(gap(28, m) * ratio(4, 1) < gap(7, m), "m = {m}");
        assert!(gap(28, m) > ratio(0, 1));
    }
    let printed =
        |j: usize| squared_norm(&(over(&hatted, j, 0, &plain[j - 1].0) - over(&plain, j, 0, &plain[j - 1].0)));
    assert_eq!(printed(7), ratio(0, 1));
}

/// AK-Delta: S∞ is the positive root of S² − (381/100)S − 4: it changes its sign between 4.667 and 4.668, and Δ = S/(S + 1)
/// is 0.8235… at both. The gains from P(0) = 0 are 4/5, 0.82295, 0.82353 and so on: equal to three digits from k = 3 on.
#[test]
fn limit_of_the_gain() {
    let polynomial = |s: &Rational| s * s - ratio(381, 100) * s - ratio(4, 1);
    let (below, above) = (ratio(4667, 1000), ratio(4668, 1000));
    assert!(polynomial(&below) < ratio(0, 1) && polynomial(&above) > ratio(0, 1));
    let gain = |s: &Rational| s / (s + ratio(1, 1));
    let rounded = |value: &Rational, digits: i32| (value * ratio(10, 1).pow(digits)).round();
    assert_eq!([&below, &above].map(|s| rounded(&gain(s), 3)), [ratio(824, 1), ratio(824, 1)]);
    // φ(S) = S is the same equation: (81/100) S/(S + 1) + 4 = S.
    let [a, v, w] = [ratio(9, 10), ratio(4, 1), ratio(1, 1)].map(number);
    for s in [&below, &above, &ratio(7, 3)] {
        let difference = s - &riccati(&a, &v, &w, &number(s.clone()))[(0, 0)];
        assert_eq!(difference * (s + ratio(1, 1)), polynomial(s));
    }
    let model = EstimatedModel { transition: a, noise: NoiseCovariances { process: v, observation: w } };
    let start = Belief { mean: Matrix::zeros(1, 1), covariance: Matrix::zeros(1, 1) };
    let gains: Vec<Rational> = run(&vec![model; 20], &start, &vec![Matrix::zeros(1, 1); 20])
        .iter()
        .map(|step| step.0[(0, 0)].clone())
        .collect();
    assert_eq!(gains[0], ratio(4, 5));
    assert_eq!([1, 2].map(|k| rounded(&gains[k], 5)), [ratio(82295, 1), ratio(82353, 1)]);
    assert!(gains[2..].iter().all(|gain| rounded(gain, 3) == ratio(824, 1)));
    assert_ne!(rounded(&gains[1], 3), ratio(824, 1));
}
