//! The observer as a linear map, its error, and its covariance by two routes.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{Observer, ObserverError, Window, gramian, transition_matrix};

use super::Q;
use super::sources::Sources;
use crate::dice::Dice;

/// Systems with both windows, h ≤ 3 and three thresholds.
pub fn instances(seed: u64, count: usize) -> impl Iterator<Item = (Sources, Observer<Rational>)> {
    let mut dice = Dice(seed);
    (0..count).map(move |_| {
        let sources = Sources::random(&mut dice, 5);
        let window = [Window::Shifted, Window::Printed][dice.size(1)];
        let threshold = [ratio(0, 1), ratio(1, 2), ratio(6, 1)][dice.size(2)].clone();
        let observer = Observer::new(window, 1 + dice.size(2), threshold).expect("some");
        (sources, observer)
    })
}

/// The starts k for which x*(k+h) is computed, with whether the window is good.
fn starts(sources: &Sources, observer: &Observer<Rational>) -> Vec<(usize, bool)> {
    let (path, h) = (&sources.path, observer.length());
    let last = path.len() + 1 - observer.window().times(0, h).end;
    let is_good = |k| {
        let shifted =
            gramian(path, observer.window(), k, h) - Matrix::identity(sources.d()).scaled(observer.threshold());
        shifted.ldl().is_ok_and(|ldl| ldl.is_positive_definite())
    };
    (0..last).map(|k| (k, is_good(k))).collect()
}

/// WG-10, WG-11, WG-12: the observer by stacked observations and normal equations, as a map of all sources.
///
/// WG-18, WG-19: the same by state and noise.
#[test]
fn the_observer_is_least_squares_on_good_windows() {
    let (mut good, mut bad) = (0, 0);
    for (sources, observer) in instances(31, 100) {
        let (path, h) = (&sources.path, observer.length());
        let (states, readings) = (sources.states(), sources.readings());
        let estimates = observer.estimates(path, &sources.start(), &readings);
        assert_eq!(estimates[0], sources.start());
        for m in 0..(h - 1) {
            assert_eq!(estimates[m + 1], path[m].transition() * &estimates[m]);
        }
        for (k, is_good) in starts(&sources, &observer) {
            let times = observer.window().times(k, h);
            let front = transition_matrix(path, k..k + h);
            if !is_good {
                assert_eq!(estimates[k + h], front * &estimates[k]);
                bad += 1;
                continue;
            }
            let stack = |rows: Vec<Q>| rows.into_iter().reduce(|all, row| all.above(&row)).expect("h > 0");
            let seen = stack(times.clone().map(|i| path[i].observation() * transition_matrix(path, k..i)).collect());
            let squares = |right: Q| (seen.transpose() * &seen).solve(&(seen.transpose() * right)).expect("good");
            assert_eq!(estimates[k + h], &front * squares(stack(readings[times.clone()].to_vec())));
            assert_eq!(
                estimates[k + h],
                front * (&states[k] + squares(stack(times.map(|i| sources.xi(k, i)).collect())))
            );
            good += 1;
        }
    }
    assert!(good > 80 && bad > 80, "{good} {bad}");
}

/// WG-20: the coefficients of the error recursion are those of x(k+h) − x*(k+h), for both windows.
///
/// WG-14: and before the first window ends the error is that of a prediction.
#[test]
fn the_error_coefficient_by_coefficient() {
    for (sources, observer) in instances(32, 100) {
        let (path, h) = (&sources.path, observer.length());
        let estimates = observer.estimates(path, &sources.start(), &sources.readings());
        let errors: Vec<Q> = sources.states().iter().zip(&estimates).map(|(x, estimate)| x - estimate).collect();
        for m in 0..h {
            let carried = transition_matrix(path, 0..m) * &errors[0];
            let sum = (1..=m).fold(carried, |sum, i| sum + transition_matrix(path, i..m) * sources.w(i));
            assert_eq!(sum, errors[m]);
        }
        for (k, is_good) in starts(&sources, &observer) {
            let map = observer.error_map(path, k);
            assert_eq!((map.process.len(), map.observation.len()), (h, h));
            let process = map.process.iter().enumerate().map(|(j, c)| c * sources.w(k + 1 + j));
            let times = observer.window().times(k, h);
            let observation = map.observation.iter().zip(times).map(|(c, i)| c * sources.v(i));
            let sum = process.chain(observation).fold(&map.carried * &errors[k], |sum, term| sum + term);
            assert_eq!(sum, errors[k + h]);
            assert!(!is_good || map.carried.is_zero());
        }
    }
}

/// WG-20: the covariance by windows is that of the joint law of all sources. In a bad window it is ΦCΦᵀ and the noise on the way.
#[test]
fn the_covariance_by_windows_is_that_of_the_sources() {
    for (sources, observer) in instances(33, 100) {
        let estimates = observer.estimates(&sources.path, &sources.start(), &sources.readings());
        let covariances = observer.covariances(&sources.path, &sources.initial_covariance);
        assert_eq!(covariances.len(), estimates.len());
        let joint = sources.covariance();
        for ((state, estimate), covariance) in sources.states().iter().zip(&estimates).zip(&covariances) {
            assert_eq!(&(state - estimate).congruence(&joint), covariance);
        }
    }
}

/// WG-10: what is no observer.
#[test]
fn windows_and_thresholds_that_make_no_observer() {
    assert_eq!(Observer::new(Window::Shifted, 0, ratio(1, 1)), Err(ObserverError::EmptyWindow));
    assert_eq!(Observer::new(Window::Shifted, 1, ratio(-1, 1)), Err(ObserverError::NegativeThreshold));
}
