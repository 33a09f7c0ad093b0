//! A filter that was given wrong noise.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{
    Bracket, ErrorCovariances, Misspecified, Mode, OtherSystem, error_covariances, riccati_path,
};

use super::sources::Sources;
use super::{Q, integer_mode, scalar};
use crate::dice::Dice;

/// The same F and H with other noise; sometimes none.
fn with_other_noise(mode: &Mode<Rational>, dice: &mut Dice) -> Mode<Rational> {
    let (f, h) = (mode.transition().clone(), mode.observation().clone());
    let (q, r) = (dice.semidefinite(f.rows()), dice.semidefinite(h.rows()));
    Mode::new(f, h, q, r).expect("covariances")
}

/// Along actual sources with another belief of their noise: believed modes, and the errors x̃(0), …, x̃(n) of the filter as maps.
fn errors(actual: &Sources, believed: &[Mode<Rational>], start: &Q) -> Vec<Q> {
    let (states, readings) = (actual.states(), actual.readings());
    let mut estimate = actual.start();
    let mut errors = vec![&states[0] - &estimate];
    for (k, step) in riccati_path(believed, start).iter().enumerate() {
        let (f, h) = (believed[k].transition(), believed[k].observation());
        estimate = f * &estimate + f * &step.gain * (&readings[k] - h * &estimate);
        errors.push(&states[k + 1] - &estimate);
    }
    errors
}

/// WG-72, WG-72-Delta, WG-73: with any gains the error is driven by Δ, coefficient by coefficient, d ≤ 3.
///
/// WG-T3.1: the error covariance of a filter with wrong Q, R and P(0) by its recursion and by the joint law of all sources. It is at most c
/// times the believed one, where the actual noise and start are at most c times the believed ones, at every time.
#[test]
fn wrong_noise() {
    let (mut dice, mut above) = (Dice(81), 0);
    for _ in 0..60 {
        let assumed = Sources::random(&mut dice, 5);
        let d = assumed.d();
        let path: Vec<_> = assumed.path.iter().map(|mode| with_other_noise(mode, &mut dice)).collect();
        let actual = Sources { path, initial_mean: dice.matrix(d, 1), initial_covariance: dice.semidefinite(d) };
        let start = dice.positive_definite(d);
        let errors = errors(&actual, &assumed.path, &start);
        let steps = riccati_path(&assumed.path, &start);
        let new = |k: usize| actual.w(k + 1) - assumed.path[k].transition() * &steps[k].gain * actual.v(k);
        for k in 0..5 {
            assert_eq!(errors[k + 1], &steps[k].closed_loop * &errors[k] + new(k));
            let product = |i: usize| steps[i..=k].iter().fold(Matrix::identity(d), |p, step| &step.closed_loop * p);
            let sum = (1..=k + 1).fold(product(0) * &errors[0], |sum, i| sum + product(i) * new(i - 1));
            assert_eq!(errors[k + 1], sum);
        }
        let pair = |(believed, actual): (&Mode<_>, &Mode<_>)| Misspecified::new(believed.clone(), actual.clone());
        let pairs: Vec<_> = assumed.path.iter().zip(&actual.path).map(|p| pair(p).expect("the same F and H")).collect();
        let first = ErrorCovariances { believed: start.clone(), actual: actual.initial_covariance.clone() };
        let found = error_covariances(&pairs, first);
        let joint = actual.covariance();
        let ratio_of = |actual: &Q, believed: &Q| {
            Bracket::largest_eigenvalue(actual, believed, &ratio(1, 1024)).expect("believed noise is positive").upper
        };
        let mut c = ratio_of(&actual.initial_covariance, &start);
        for (believed, actual) in assumed.path.iter().zip(&actual.path) {
            c = c.max(ratio_of(actual.process_noise(), believed.process_noise()));
            c = c.max(ratio_of(actual.observation_noise(), believed.observation_noise()));
        }
        for (k, covariances) in found.iter().enumerate() {
            assert_eq!(covariances.actual, errors[k].congruence(&joint));
            let believed = if k == 0 { &start } else { &steps[k - 1].next };
            assert_eq!(&covariances.believed, believed);
            covariances.actual.loewner_le(&believed.scaled(&c)).expect("linear in the noise");
            above += usize::from(covariances.actual.loewner_le(believed).is_err());
        }
    }
    assert!(above > 100, "{above}");
}

/// WG-T3.1: an unstable system, F = 2, H = 1, believed Q = R = 1, actual Q = 3, R = 2: twelve steps stay below three times the bound 5 of
/// P(k) ≤ F²R/H² + Q, and so do all, the bound being the same for each.
#[test]
fn wrong_noise_and_an_unstable_system() {
    let pair = Misspecified::new(integer_mode([2, 1, 1, 1]), integer_mode([2, 1, 3, 2])).expect("the same F and H");
    let start = ErrorCovariances { believed: scalar(ratio(1, 1)), actual: scalar(ratio(1, 1)) };
    let found = error_covariances(&vec![pair; 12], start);
    assert!(found.iter().all(|now| now.believed[(0, 0)] <= ratio(5, 1) && now.actual[(0, 0)] <= ratio(15, 1)));
    assert!(found[12].actual[(0, 0)] > found[12].believed[(0, 0)]);
}

/// WG-T3.1: F and H must be those of the system.
#[test]
fn another_system_is_refused() {
    assert_eq!(Misspecified::new(integer_mode([2, 1, 1, 1]), integer_mode([3, 1, 1, 1])), Err(OtherSystem));
    assert_eq!(Misspecified::new(integer_mode([2, 1, 1, 1]), integer_mode([2, 2, 1, 1])), Err(OtherSystem));
}
