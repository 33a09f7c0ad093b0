//! Section II.2: the change of measure for white noise and any adapted shift that is affine in the past.

use exact_kalman::matrix::Matrix;
use exact_kalman::nongaussian::as_printed::log_likelihood_ratio;
use exact_kalman::nongaussian::{Shift, log_likelihood_ratios};
use exact_kalman::scalar::ratio;

use super::Q;
use super::world::{Noises, World, form, half, integrated, negated, product, value};

const BOTH: &[Noises] = &[Noises::Correlated, Noises::Standard];

/// χ(0), …, χ(T), each affine in ξ and the noise before it.
fn shifts(world: &World, dice: &mut super::world::Dice) -> Vec<Q> {
    (0..world.steps.len()).map(|s| world.adapted(world.n + world.k, s, dice)).collect()
}

/// log L(t) of (2.12) for t = 0, …, T+1.
pub fn log_ratios(world: &World, chi: &[Q]) -> Vec<Q> {
    let mut all = vec![Matrix::zeros(world.size(), world.size())];
    for (s, (at, chi)) in world.steps.iter().zip(chi).enumerate() {
        let step = product(chi, &world.noise(s)) - half(&form(chi, &at.gamma()));
        all.push(&all[s] + step);
    }
    all
}

/// SM-2.10, SM-A1: E[exp(ηᵀU(t+1)) | ℱ(t)] = exp(½ ηᵀΛη), an identity of entire functions of η, so that it holds at η = iθ; Λ may be
/// singular.
#[test]
fn white_noise_has_its_transform() {
    let mut singular = 0;
    for (world, _) in World::all(BOTH) {
        for (s, at) in world.steps.iter().enumerate() {
            let (found, determinant) =
                integrated(&product(&world.long_eta(), &world.noise(s)), world.source(s)).expect("finite");
            assert_eq!((found, determinant), (half(&form(&world.long_eta(), &at.gamma())), ratio(1, 1)));
            singular += usize::from(at.gamma().rank() < world.n + world.k);
        }
    }
    assert!(singular > 0);
}

/// SM-2.12, SM-2.13, SM-2.14, SM-Girsanov-a: E[L(t+1) | ℱ(t)] = L(t), so that E L(T+1) = 1 given ξ, for every adapted χ; L is
/// positive, so the null sets are the same, and it is 1 at t = 0, so nothing changes on ℱ(0). All sources at once or one
/// after the other, the integrals are the same.
#[test]
fn the_density_has_mean_one() {
    for (world, mut dice) in World::all(BOTH) {
        let chi = shifts(&world, &mut dice);
        let all = log_ratios(&world, &chi);
        for s in 0..world.steps.len() {
            assert_eq!(integrated(&all[s + 1], world.source(s)), Some((all[s].clone(), ratio(1, 1))));
        }
        let nothing = Matrix::zeros(world.size(), world.size());
        assert_eq!(integrated(&all[world.steps.len()], world.sources()), Some((nothing, ratio(1, 1))));
    }
}

/// SM-Girsanov-a: a χ that looks ahead, χ(0) = U(1), has E L(1) = E exp(½ U²(1)) = ∞.
#[test]
fn a_shift_that_looks_ahead_is_no_shift() {
    let world = World::random(1, Noises::Standard);
    let noise = world.noise(0);
    let exponent = product(&noise, &noise) - half(&form(&noise, &Matrix::identity(noise.rows())));
    assert_eq!(integrated(&exponent, world.sources()), None);
}

/// SM-2.11, SM-2.14, SM-2.15, SM-Girsanov-b: the density of the sources times L is that of standard sources g(s) − Cᵀχ(s), and
/// Ū is C times these: so Ū is white with the covariances of U, and independent of ξ. Also by transforms: for all
/// coefficients, Ē exp(∑ aᵀ(s)Ū(s+1)) = exp(½ ∑ aᵀ(s)Λ(s+1)a(s)).
#[test]
fn the_shifted_noise_is_white_under_the_new_measure() {
    for (world, mut dice) in World::all(BOTH) {
        let chi = shifts(&world, &mut dice);
        let all = log_ratios(&world, &chi);
        let last = &all[world.steps.len()];
        let nothing = Matrix::zeros(world.size(), world.size());
        let square = |rows: &Q| half(&product(rows, rows));
        let (mut old, mut new) = (nothing.clone(), nothing.clone());
        let (mut transform, mut expected, mut by_new) = (last.clone(), nothing.clone(), nothing.clone());
        for (s, (at, chi)) in world.steps.iter().zip(&chi).enumerate() {
            let shifted = world.noise(s) - at.gamma() * chi;
            let source = world.g(s) - at.both().transpose() * chi;
            assert_eq!(shifted, at.both() * &source);
            (old, new) = (old + square(&world.g(s)), new + square(&source));
            let coefficient = dice.matrix(world.n + world.k, world.n + world.k) * world.long_eta();
            transform = transform + product(&coefficient, &shifted);
            expected = expected + half(&form(&coefficient, &at.gamma()));
            by_new = by_new + product(chi, &shifted) + half(&form(chi, &at.gamma()));
            assert_eq!(by_new, all[s + 1]);
        }
        assert_eq!(last - old, negated(&new));
        assert_eq!(integrated(&transform, world.sources()), Some((expected, ratio(1, 1))));
    }
}

/// SM-Girsanov-c: in the sources of the new measure, Ē[L⁻¹(t+1) | ℱ(t)] = L⁻¹(t).
#[test]
fn the_inverse_is_a_martingale_under_the_new_measure() {
    for (world, mut dice) in World::all(BOTH) {
        let chi = shifts(&world, &mut dice);
        let new = world.substitution(&chi).transpose();
        let inverse: Vec<Q> = log_ratios(&world, &chi).iter().map(|log| negated(&new.congruence(log))).collect();
        for s in 0..world.steps.len() {
            assert_eq!(integrated(&inverse[s + 1], world.source(s)), Some((inverse[s].clone(), ratio(1, 1))));
        }
    }
}

/// SM-2.11, SM-2.12, SM-2.15, SM-Girsanov-b: the steps of the crate, at values of ξ and the noise, against the exponents as functions of them:
/// the sums of (2.12) and of (2.15), the new noise, the moments of a factor given the past, and the law of the old noise under the
/// new measure by its transform: log E[exp(aᵀU) L(t+1)/L(t) | ℱ(t)] = aᵀΛχ + ½ aᵀΛa.
#[test]
fn the_steps_of_the_crate_are_these() {
    for (world, mut dice) in World::all(BOTH) {
        let chi = shifts(&world, &mut dice);
        let all = log_ratios(&world, &chi);
        let point = world.point(&mut dice);
        let steps: Vec<_> =
            world.steps.iter().zip(&chi).map(|(at, chi)| Shift::new(at.gamma(), chi * &point)).collect();
        let noise: Vec<Q> = (0..steps.len()).map(|s| world.noise(s) * &point).collect();
        let found = log_likelihood_ratios(&steps, &noise);
        assert_eq!(found, all.iter().map(|log| value(log, &point)).collect::<Vec<_>>());
        let mut by_new = ratio(0, 1);
        for (s, (step, value_of_noise)) in steps.iter().zip(&noise).enumerate() {
            let new = value_of_noise - world.steps[s].gamma() * &chi[s] * &point;
            assert_eq!(step.new_noise(value_of_noise), new);
            by_new += step.log_factor_by_new_noise(&new);
            assert_eq!(by_new, found[s + 1]);
            let factor = &all[s + 1] - &all[s];
            for power in [ratio(1, 1), ratio(0, 1), ratio(1, 2), ratio(-3, 2)] {
                let (mean, determinant) = integrated(&factor.scaled(&power), world.source(s)).expect("finite");
                assert_eq!((value(&mean, &point), determinant), (step.log_moment(&power), ratio(1, 1)));
            }
            let transform = product(&world.long_eta(), &world.noise(s)) + factor;
            let (mean, _) = integrated(&transform, world.source(s)).expect("finite");
            let (law, a) = (step.law_of_noise(), world.long_eta() * &point);
            let exponent = law.characteristic_exponent(&a);
            assert_eq!(value(&mean, &point), exponent.linear + exponent.quadratic * ratio(1, 2));
        }
    }
}

/// Erratum SM-2.12, and likewise SM-2.15: printed for t = 1, 2, … the formula says nothing of L(1). The product of one factor is
/// right: with it E[L(2) | ℱ(1)] = L(1) and E[L(1) | ℱ(0)] = L(0); the only value at hand in print, L(0) = 1, is not E[L(2) | ℱ(1)].
#[test]
fn the_range_begins_at_zero() {
    let mut told = 0;
    for (world, mut dice) in World::all(BOTH).filter(|(world, _)| world.steps.len() > 1) {
        let chi = shifts(&world, &mut dice);
        let all = log_ratios(&world, &chi);
        let point = world.point(&mut dice);
        let steps: Vec<_> =
            world.steps.iter().zip(&chi).map(|(at, chi)| Shift::new(at.gamma(), chi * &point)).collect();
        let noise: Vec<Q> = (0..steps.len()).map(|s| world.noise(s) * &point).collect();
        let right = log_likelihood_ratios(&steps, &noise);
        let printed = |t| log_likelihood_ratio(&steps, &noise, t);
        // The mean of the one before the last source, at the point.
        let given = |t: usize| value(&integrated(&all[t + 1], world.source(t)).expect("finite").0, &point);
        assert_eq!((&given(0), &given(1)), (&right[0], &right[1]));
        assert_eq!((printed(0).as_ref(), printed(2).as_ref()), (Some(&right[0]), Some(&right[2])));
        assert_eq!(printed(1), None);
        told += usize::from(printed(0) != Some(given(1)));
    }
    assert!(told > 10, "L(0) would do");
}
