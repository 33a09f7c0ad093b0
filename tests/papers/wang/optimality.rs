//! The filter beside the observer: which of them is better, and when.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{Bracket, Mode, ModeProcess, Observer, Window, riccati_path};

use super::draws::mode;
use super::paths::{along, gaussian_moment, mean, paths, power, trace};
use super::sources::Sources;
use super::{Q, scalar, scalar_mode};
use crate::dice::Dice;

/// P(0), …, P(n).
pub fn covariances(path: &[Mode<Rational>], initial: &Q) -> Vec<Q> {
    std::iter::once(initial.clone()).chain(riccati_path(path, initial).into_iter().map(|step| step.next)).collect()
}

/// WG-9, WG-noise: the error of the filter with the gains of WG-1, as a map of the sources of the right model, has the covariance P(k)
/// and is uncorrelated with every reading before k: so x̂(k) is the best linear estimate and P(k) its covariance.
#[test]
fn the_filter_is_the_projection_on_the_readings() {
    let mut dice = Dice(41);
    for _ in 0..60 {
        let sources = Sources::random(&mut dice, 4);
        let (states, readings, joint) = (sources.states(), sources.readings(), sources.covariance());
        let mut estimate = sources.start();
        let steps = riccati_path(&sources.path, &sources.initial_covariance);
        for k in 0..=4 {
            let error = &states[k] - &estimate;
            let covariance = if k == 0 { &sources.initial_covariance } else { &steps[k - 1].next };
            assert_eq!(&error.congruence(&joint), covariance);
            assert!(readings[..k].iter().all(|reading| (&error * &joint * reading.transpose()).is_zero()));
            if k < 4 {
                let (f, h) = (sources.path[k].transition(), sources.path[k].observation());
                estimate = f * &estimate + f * &steps[k].gain * (&readings[k] - h * &estimate);
            }
        }
    }
}

/// Erratum WG-noise: with E[w(k+1)wᵀ(k+1)] = Q(k) the variance of x(1) given y(0) is the 3/2 of WG-1; with Q(k+1), as printed, 5/2:
/// F = H = R = P(0) = 1, Q(0) = 1, Q(1) = 2.
///
/// Erratum WG-noise-3: the same slip in the same model; WG-71 is WG-1.
#[test]
fn the_noise_that_arrives_has_the_covariance_of_the_step() {
    let of = |q| scalar_mode([1, 1, q, 1].map(|value| ratio(value, 1)));
    let by_equation = of(1).step(&scalar(ratio(1, 1))).next;
    // (x(1), y(0)) with x(0) of variance 1, var x(1) = 1 + var w(1), cov = 1, var y(0) = 2.
    let given_reading = |noise: i64| scalar(ratio(1 + noise, 1) - ratio(1, 2));
    let (right, printed) = (given_reading(1), given_reading(2));
    assert_eq!((&right, &printed), (&scalar(ratio(3, 2)), &scalar(ratio(5, 2))));
    assert_eq!(by_equation, right);
    assert_ne!(by_equation, printed);
}

/// WG-optimality, WG-trace: with the shifted window x*(k) knows no noise that the filter does not, and its error has the covariance P(k)
/// and that of x̂(k) − x*(k); the norm is below the trace, which is the mean of ‖x(k) − x*(k)‖².
#[test]
fn the_filter_beats_the_observer_of_the_shifted_window() {
    let (mut dice, mut strict) = (Dice(42), 0);
    for _ in 0..80 {
        let sources = Sources::random(&mut dice, 5);
        let observer = Observer::new(Window::Shifted, 1 + dice.size(2), ratio(1, 3)).expect("some");
        let (readings, joint) = (sources.readings(), sources.covariance());
        let observed = observer.estimates(&sources.path, &sources.start(), &readings);
        let bounds = observer.covariances(&sources.path, &sources.initial_covariance);
        let filtered = riccati_path(&sources.path, &sources.initial_covariance);
        let mut estimate = sources.start();
        for (k, p) in covariances(&sources.path, &sources.initial_covariance).iter().enumerate() {
            for later in k..5 {
                let noise = sources.v(later);
                assert!((&observed[k] * noise.transpose()).is_zero());
            }
            let distance = &estimate - &observed[k];
            assert_eq!(bounds[k], p + distance.congruence(&joint));
            p.loewner_le(&bounds[k]).expect("the filter is best");
            strict += usize::from(p != &bounds[k]);
            let tr = trace(&bounds[k]);
            p.loewner_le(&Matrix::identity(sources.d()).scaled(&tr)).expect("‖P‖ ≤ tr");
            assert_eq!(gaussian_moment(&bounds[k], 1), tr);
            if k < 5 {
                let (f, h) = (sources.path[k].transition(), sources.path[k].observation());
                estimate = f * &estimate + f * &filtered[k].gain * (&readings[k] - h * &estimate);
            }
        }
    }
    assert!(strict > 200, "{strict}");
}

/// Erratum WG-optimality: F = H = h = Q = P(0) = 1, R = 1/10: with the shifted window P(k) ≤ E(x − x*)(x − x*)ᵀ; with the printed one
/// the right side is 1/10 and P(1) = 12/11, P(2) = 143/131.
///
/// Erratum WG-trace, and likewise Erratum WG-41, Erratum WG-42, Erratum WG-43: d = 1, r = 1 and nothing random, so that all five are the
/// same comparison, at k = 1 and k = 2, multiples of h.
#[test]
fn the_printed_window_beats_the_filter() {
    let path = vec![scalar_mode([ratio(1, 1), ratio(1, 1), ratio(1, 1), ratio(1, 10)]); 3];
    let one = scalar(ratio(1, 1));
    let p = covariances(&path, &one);
    assert_eq!(p[1..3], [scalar(ratio(12, 11)), scalar(ratio(143, 131))]);
    let of = |window| Observer::new(window, 1, ratio(1, 2)).expect("some").covariances(&path, &one);
    let (right, printed) = (of(Window::Shifted), of(Window::Printed));
    for k in [1, 2] {
        assert_eq!((&right[k], &printed[k]), (&scalar(ratio(11, 10)), &scalar(ratio(1, 10))));
        assert!(p[k].loewner_le(&right[k]).is_ok());
        assert!(p[k].loewner_le(&printed[k]).is_err());
    }
}

/// WG-optimality: the other repair. With the printed window the covariance after y(k), P(k|k) = P(k) − L(k)H(k)P(k), is below that of
/// x*(k), and P(k+1) = F P(k|k) Fᵀ + Q; P(k) is not, for many of the systems.
#[test]
fn the_printed_window_and_the_filtered_covariance() {
    let (mut dice, mut violated) = (Dice(43), 0);
    for _ in 0..80 {
        let sources = Sources::random(&mut dice, 5);
        let observer = Observer::new(Window::Printed, 1 + dice.size(2), ratio(0, 1)).expect("some");
        let bounds = observer.covariances(&sources.path, &sources.initial_covariance);
        let steps = riccati_path(&sources.path, &sources.initial_covariance);
        let p = covariances(&sources.path, &sources.initial_covariance);
        let mut is_violated = false;
        for k in 0..5 {
            let (mode, step) = (&sources.path[k], &steps[k]);
            let filtered = &p[k] - &step.gain * mode.observation() * &p[k];
            filtered.loewner_le(&bounds[k]).expect("the same readings and more");
            assert_eq!(mode.transition().congruence(&filtered) + mode.process_noise(), step.next);
            is_violated |= p[k].loewner_le(&bounds[k]).is_err();
        }
        violated += usize::from(is_violated);
    }
    assert!(violated > 20, "{violated}");
}

/// WG-41: r = 2 and 3, by Gaussian moments of degree 4 and 6: ‖P‖ʳ ≤ (tr)ʳ ≤ E‖x − x*‖²ʳ.
///
/// WG-42, WG-43: the means over all paths of three random modes, r = 1, 2 and 3, at every k and so at multiples of h.
#[test]
fn powers_and_means_of_the_comparison() {
    let mut dice = Dice(44);
    for seed in 0..6 {
        let (d, m) = (1 + dice.size(1), 1 + dice.size(1));
        let modes: Vec<_> = (0..3).map(|_| mode(&mut dice, d, m)).collect();
        let law = [ratio(1, 2), ratio(1, 3), ratio(1, 6)].to_vec();
        let process = ModeProcess::independent(modes, law).expect("a law");
        let (initial, h) = (dice.positive_definite(d), 1 + seed % 2);
        let observer = Observer::new(Window::Shifted, h, ratio(1, 2)).expect("some");
        for k in 0..=3 {
            let paths = paths(&process, k.max(1));
            for r in 1..=3 {
                // Just above the norm: the claim for it is stronger.
                let norm = |path: &[usize]| {
                    let p = covariances(&along(&process, path), &initial)[k].clone();
                    let found = Bracket::largest_eigenvalue(&p, &Matrix::identity(d), &ratio(1, 1 << 20));
                    power(&found.expect("the identity is regular").upper, r)
                };
                let bound = |path: &[usize]| observer.covariances(&along(&process, path), &initial)[k].clone();
                for (_, path) in &paths {
                    let (square, moment) = (power(&trace(&bound(path)), r), gaussian_moment(&bound(path), r));
                    assert!(norm(path) <= square && square <= moment);
                }
                assert!(mean(&paths, norm) <= mean(&paths, |path| gaussian_moment(&bound(path), r)));
            }
        }
    }
}
