//! Products that decay: the class S⁰(λ), Lemmas 2.1 and 2.3, exponential stability.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{Contraction, DecayVerdict, Drift, ModeProcess};
use num_traits::{One, Zero};

use super::bounded_moments::kronecker_operator;
use super::{Q, integer_mode};
use crate::dice::Dice;

/// A chain whose modes do not matter.
fn chain(initial: Vec<Rational>, rows: Vec<Vec<Rational>>) -> ModeProcess<Rational> {
    let modes = vec![integer_mode([1, 1, 1, 1]); initial.len()];
    ModeProcess::markov(modes, initial, Matrix::from_rows(rows).expect("square")).expect("a chain")
}

fn law(dice: &mut Dice, n: usize) -> Vec<Rational> {
    let parts: Vec<i64> = (0..n).map(|_| i64::try_from(dice.below(4)).expect("small")).collect();
    let sum: i64 = parts.iter().sum();
    if sum == 0 { law(dice, n) } else { parts.iter().map(|&part| ratio(part, sum)).collect() }
}

fn random_chain(dice: &mut Dice) -> ModeProcess<Rational> {
    let n = 1 + dice.size(2);
    chain(law(dice, n), (0..n).map(|_| law(dice, n)).collect())
}

/// Pr of all paths of n + 1 modes from time i, with the law of time i by powers of the chain; and E ∏ of the last n factors.
fn by_paths(process: &ModeProcess<Rational>, factors: &[Rational], i: usize, n: usize) -> Rational {
    let mut weights = process.initial().to_vec();
    for _ in 0..i {
        weights = (0..weights.len())
            .map(|to| (0..weights.len()).map(|from| &weights[from] * &process.transition()[(from, to)]).sum())
            .collect();
    }
    let mut paths: Vec<(usize, Rational)> = weights.into_iter().enumerate().collect();
    for _ in 0..n {
        paths = paths
            .iter()
            .flat_map(|(from, weight)| {
                (0..factors.len()).map(move |to| (to, weight * &process.transition()[(*from, to)] * &factors[to]))
            })
            .filter(|(_, weight)| !weight.is_zero())
            .collect();
    }
    paths.into_iter().map(|(_, weight)| weight).sum()
}

/// WG-54: random chains: certified rates are kept over all paths, refuted ones are broken by some product, and the mean products agree.
#[test]
fn the_class_is_decided() {
    let mut dice = Dice(3);
    let (mut certified, mut refuted) = (0, 0);
    for _ in 0..60 {
        let process = random_chain(&mut dice);
        let n = process.modes().len();
        let a: Vec<Rational> = (0..n).map(|_| ratio(i64::try_from(dice.below(5)).expect("small"), 4)).collect();
        let factors: Vec<Rational> = a.iter().map(|a| Rational::one() - a).collect();
        let rate = ratio(1 + i64::try_from(dice.below(9)).expect("small"), 10);
        let expected: Rational = process
            .expected_products(&a, 4)
            .iter()
            .zip(process.initial())
            .map(|(product, weight)| product * weight)
            .sum();
        assert_eq!(expected, by_paths(&process, &factors, 0, 4));
        match process.decay(&a, &rate).expect("a is in the unit interval") {
            DecayVerdict::Certified(decay) => {
                // Bx ≤ λx, x > 0 on reachable modes.
                for &u in &process.reachable() {
                    let image: Rational =
                        (0..n).map(|v| &process.transition()[(u, v)] * &factors[v] * &decay.weights[v]).sum();
                    assert!(decay.weights[u] > Rational::zero() && image <= &rate * &decay.weights[u]);
                }
                for i in 0..3 {
                    for n in 0..6 {
                        let steps = i32::try_from(n).expect("small");
                        assert!(by_paths(&process, &factors, i, n) <= &decay.constant * rate.pow(steps));
                    }
                }
                certified += 1;
            }
            DecayVerdict::Refuted => {
                // Bⁿ1 is above 10 λⁿ somewhere, for some n; by doubling.
                let reachable = process.reachable();
                let mut power: Q = Matrix::from_fn(n, n, |u, v| &process.transition()[(u, v)] * &factors[v] / &rate)
                    .select(&reachable, &reachable);
                let exceeds =
                    |power: &Q| (0..power.rows()).any(|u| power.row(u).iter().sum::<Rational>() > ratio(10, 1));
                let mut doublings = 0;
                while !exceeds(&power) {
                    // A few digits downward are enough, and keep numbers short.
                    power = (&power * &power).map(|entry| (entry * ratio(1 << 40, 1)).floor() / ratio(1 << 40, 1));
                    doublings += 1;
                    assert!(doublings < 12, "{a:?} {rate}");
                }
                refuted += 1;
            }
            DecayVerdict::Critical => {}
        }
    }
    assert!(certified > 15 && refuted > 15, "{certified} {refuted}");
}

/// WG-54: rates at the edge: at the spectral radius itself products may have an extra factor n, or none.
#[test]
fn rates_at_the_edge() {
    let [zero, half, one] = [ratio(0, 1), ratio(1, 2), ratio(1, 1)];
    // From 0 to 1 for good, both factors ½ on their own steps: E ∏ of n steps from mode 0 has n + 1 terms of order 2^(−n).
    let slow =
        chain(vec![one.clone(), zero.clone()], vec![vec![half.clone(), half.clone()], vec![zero.clone(), one.clone()]]);
    let a = [zero.clone(), half.clone()];
    assert_eq!(slow.decay(&a, &half), Ok(DecayVerdict::Critical));
    assert_eq!(slow.expected_products(&a, 10)[0], ratio(10 + 2, 1 << 11));
    assert!(matches!(slow.decay(&a, &ratio(51, 100)), Ok(DecayVerdict::Certified(_))));
    assert_eq!(slow.decay(&a, &ratio(49, 100)), Ok(DecayVerdict::Refuted));
    // The same from mode 1 alone.
    let reached =
        chain(vec![zero.clone(), one.clone()], vec![vec![half.clone(), half.clone()], vec![zero.clone(), one.clone()]]);
    assert!(matches!(reached.decay(&a, &half), Ok(DecayVerdict::Certified(_))));
    // An eigenvalue below the radius: B = diag(1/2, 1) by modes that stay.
    let apart =
        chain(vec![half.clone(), half.clone()], vec![vec![one.clone(), zero.clone()], vec![zero.clone(), one.clone()]]);
    assert_eq!(apart.decay(&[half.clone(), zero.clone()], &half), Ok(DecayVerdict::Refuted));
    // λ = 0 with a = 1, and with a < 1 only in a mode that is left at once.
    assert!(matches!(apart.decay(&[one.clone(), one.clone()], &zero), Ok(DecayVerdict::Certified(_))));
    assert!(apart.decay(&[ratio(-1, 2), one], &half).is_err());
}

/// WG-L2.1: random drifts: the constants of the closed form contract, and do so for chains with that drift; E ∏ (1 − 1/a) keeps below the bound.
#[test]
fn the_drift_has_constants() {
    let mut dice = Dice(17);
    for _ in 0..200 {
        let alpha = ratio(i64::try_from(dice.below(20)).expect("small"), 20);
        let beta = ratio(1 + i64::try_from(dice.below(60)).expect("small"), 7);
        let drift = Drift::new(alpha.clone(), beta.clone()).expect("α < 1, β > 0");
        let contraction = drift.contraction();
        assert!(drift.contracts(&contraction));
        // Point by point, without the vertex.
        let Contraction { rate, offset } = &contraction;
        for a in 0..200 {
            let a = Rational::one() + ratio(a * a, 16);
            let m = &alpha * &a + &beta;
            assert!(m < Rational::one() || &m - Rational::one() + offset - offset / &m <= rate * (&a + offset));
        }
        assert!(!drift.contracts(&Contraction { rate: &alpha - ratio(1, 100), offset: offset.clone() }));
    }
    let mut checked = 0;
    for _ in 0..40 {
        let process = random_chain(&mut dice);
        let n = process.modes().len();
        let a: Vec<Rational> = (0..n).map(|_| ratio(2 + i64::try_from(dice.below(8)).expect("small"), 2)).collect();
        let ahead = |u: usize| (0..n).map(|v| &process.transition()[(u, v)] * &a[v]).sum::<Rational>();
        let alpha = ratio(1, 3);
        let beta = (0..n).map(|u| ahead(u) - &alpha * &a[u]).max().expect("a mode");
        let Some(drift) = Drift::new(alpha, beta) else { continue };
        let contraction = drift.contraction();
        // One step of V on the chain, mode by mode.
        for u in 0..n {
            let step: Rational = (0..n)
                .map(|v| {
                    &process.transition()[(u, v)] * (&a[v] + &contraction.offset) * (Rational::one() - a[v].recip())
                })
                .sum();
            assert!(step <= &contraction.rate * (&a[u] + &contraction.offset));
        }
        let first: Rational = a.iter().zip(process.initial()).map(|(a, weight)| a * weight).sum();
        let constant = drift.constant(&contraction, &first);
        let factors: Vec<Rational> = a.iter().map(|a| Rational::one() - a.recip()).collect();
        for (i, n) in (0..3).flat_map(|i| (0..6).map(move |n| (i, n))) {
            assert!(
                by_paths(&process, &factors, i, n)
                    <= &constant * contraction.rate.pow(i32::try_from(n).expect("small"))
            );
        }
        checked += 1;
    }
    assert!(checked > 20, "{checked}");
}

/// WG-L2.1: what fails without α < 1, and without a ≥ 1; constants that are given are checked exactly.
#[test]
fn hypotheses_of_the_drift_are_needed() {
    assert_eq!(Drift::new(ratio(1, 1), ratio(1, 1)), None);
    // a(k) = k + 1, α = β = 1: the product is 1/(k + 1).
    let mut product = Rational::one();
    for k in 1..=400 {
        product *= Rational::one() - ratio(1, k + 1);
        assert_eq!(product, ratio(1, k + 1));
    }
    assert!(product > ratio(9, 10).pow(400) * ratio(1_000_000, 1));
    // a = 1/3 < 1: a factor of −2, whose products are in no class.
    assert_eq!(Rational::one() - ratio(1, 3).recip(), ratio(-2, 1));
    let drift = Drift::new(ratio(1, 2), ratio(1, 1)).expect("α < 1");
    let with = |rate: Rational, offset: i64| drift.contracts(&Contraction { rate, offset: ratio(offset, 1) });
    // α = ½, β = 1, c = 4: a/2 + 4 − 4/(a/2 + 1) ≤ λ(a + 4); at a = 7, 119/18 ≤ 11λ, so λ ≥ 119/198 = 0.6010…, and little more is enough.
    assert!(with(ratio(3, 4), 4) && with(ratio(61, 100), 4) && !with(ratio(6, 10), 4));
    assert!(!with(ratio(1, 1), 4) && !with(ratio(99, 100), -1));
}

/// WG-L2.3: block products to single ones, M = c/λʰ, over random chains with a certified rate.
///
/// Erratum WG-L2.3: λ = 0 is admitted in print.
#[test]
fn blocks_give_the_class() {
    let mut dice = Dice(23);
    for _ in 0..20 {
        let process = random_chain(&mut dice);
        let n = process.modes().len();
        let factors: Vec<Rational> = (0..n).map(|_| ratio(i64::try_from(dice.below(4)).expect("small"), 4)).collect();
        let h = 1 + dice.size(2);
        let products = |i: usize, n: usize| by_paths(&process, &factors, i, n);
        // The least c for these k and t with λ = 9/10, and then all products.
        let rate = ratio(9, 10);
        let power = |n: usize| rate.pow(i32::try_from(n).expect("small"));
        let c = (0..3)
            .flat_map(|k| (0..3).map(move |t| (k, t)))
            .map(|(k, t)| products(k, t * h) / power(t * h))
            .max()
            .expect("some");
        for (m, n) in (0..3).flat_map(|m| (0..3 * h).map(move |n| (m, n))) {
            assert!(products(m, n) <= &c / power(h) * power(n));
        }
    }
    // h = 2, a = 0, 1, 0, 1, …: blocks vanish, so c = 1 and λ = 0 fit (0⁰ = 1); a single factor 1 − a(2) = 1 is not 0.
    let factor = |k: usize| ratio(i64::from(k.is_multiple_of(2)), 1);
    let product = |from: usize, n: usize| (from..from + n).map(factor).product::<Rational>();
    for (k, t) in (0..5).flat_map(|k| (0..5).map(move |t| (k, t))) {
        assert!(product(k, 2 * t) <= Rational::zero().pow(i32::try_from(2 * t).expect("small")));
        // The right form: λ = ½, c = 4.
        assert!(product(k, 2 * t) <= ratio(1, 2).pow(i32::try_from(2 * t).expect("small")));
    }
    assert!(product(2, 1) > Rational::zero());
    assert!(
        (0..5)
            .all(|m| (0..9).all(|n| product(m, n) <= ratio(4, 1) * ratio(1, 2).pow(i32::try_from(n).expect("small"))))
    );
}

/// WG-D2.1, WG-51: products of 2×2 matrices that follow a chain: with the constant found, the mean square and the mean fourth power of norms keep
/// below M λⁿ over all paths; a rate below the spectral radius of the Kronecker form has no constant.
#[test]
fn exponential_stability_is_decided_for_matrices_of_modes() {
    let mut dice = Dice(29);
    let mut found = [0, 0];
    for _ in 0..20 {
        let n = 1 + dice.size(1);
        let mode = || {
            exact_kalman::stability::Mode::new(
                Matrix::identity(2),
                Matrix::identity(2),
                Matrix::identity(2),
                Matrix::identity(2),
            )
            .expect("a mode")
        };
        let rows = (0..n).map(|_| law(&mut dice, n)).collect();
        let process = ModeProcess::markov(vec![mode(); n], law(&mut dice, n), Matrix::from_rows(rows).expect("square"))
            .expect("a chain");
        let matrices: Vec<Q> = (0..n).map(|_| dice.matrix(2, 2).scaled(&ratio(1, 4))).collect();
        for s in 1..=2 {
            let rate = ratio(1, 2);
            // The Kronecker form grows fast; for the fourth moments one mode is enough.
            let contracts = || {
                let operator = kronecker_operator(&process, &process.reachable(), &matrices, 2 * s);
                operator.spectral_radius_lt(&rate)
            };
            let is_small = s == 1 || n == 1;
            let Some(constant) = process.product_bound(&matrices, s, &rate) else {
                assert!(!is_small || !contracts());
                found[0] += 1;
                continue;
            };
            assert!(!is_small || contracts());
            found[1] += 1;
            let mut paths: Vec<(usize, Rational, Q)> = process
                .initial()
                .iter()
                .enumerate()
                .map(|(mode, weight)| (mode, weight.clone(), Matrix::identity(2)))
                .collect();
            for n in 0..5 {
                // (∑aᵢⱼ²)ˢ, which is no less than the norm to the power 2s.
                let mean: Rational = paths
                    .iter()
                    .map(|(_, weight, a)| weight * a.squared_norm().pow(i32::try_from(s).expect("small")))
                    .sum();
                assert!(mean <= &constant * rate.pow(n));
                paths = paths
                    .into_iter()
                    .flat_map(|(from, weight, a)| {
                        let (process, matrices) = (&process, &matrices);
                        (0..matrices.len())
                            .map(move |to| (to, &weight * &process.transition()[(from, to)], &matrices[from] * &a))
                    })
                    .filter(|(_, weight, _)| !weight.is_zero())
                    .collect();
            }
        }
    }
    assert!(found.iter().all(|&count| count > 8), "{found:?}");
}
