//! The bound on every path against stacked least squares, and against P(k) along every path.

use std::cell::Cell;

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::BoundError;
use proptest::test_runner::{Config, TestCaseError, TestRunner};

use super::super::systems::Q;
use super::draws::draws;
use super::observability::gramian;
use super::{Process, paths, windows};
use exact_kalman::stability::Window;

/// The sources of a window are stacked: the state at its beginning, then w and v of each step. States and observations
/// are matrices on them; the observer is the pseudo-inverse of what the observations see of the state.
fn stacked(process: &Process, modes: &[usize]) -> Q {
    let (d, m) = (process.states(), process.modes()[0].observation().rows());
    let sources = d + modes.len() * (d + m);
    let unit = |rows: usize, from: usize| Matrix::from_fn(rows, sources, |i, j| ratio(i64::from(from + i == j), 1));
    let mut state = unit(d, 0);
    let mut observed: Q = Matrix::zeros(0, sources);
    let mut covariance = Matrix::zeros(d, d);
    let mut transition = Matrix::identity(d);
    for (step, &mode) in modes.iter().enumerate() {
        let mode = &process.modes()[mode];
        let from = d + step * (d + m);
        observed = observed.above(&(mode.observation() * &state + unit(m, from + d)));
        state = mode.transition() * &state + unit(d, from);
        transition = mode.transition() * transition;
        covariance = covariance.block_diagonal(mode.process_noise()).block_diagonal(mode.observation_noise());
    }
    let seen = observed.block(0..observed.rows(), 0..d);
    let observer = transition * seen.pseudo_inverse().expect("an ordered field");
    let error = state - observer * observed;
    assert!(error.block(0..d, 0..d).is_zero(), "the error holds nothing of the state");
    error.congruence(&covariance)
}

fn check(holds: bool, what: &str, process: &Process) -> Result<(), TestCaseError> {
    if holds { Ok(()) } else { Err(TestCaseError::fail(format!("{what}: {process:?}"))) }
}

/// WG-T1.1, WG-10: the covariances of all windows by stacked least squares, and P(k) below them for every k ≥ h, every path
/// and three P(0), one of them large.
#[test]
fn no_path_exceeds_the_bound() -> Result<(), Box<dyn std::error::Error>> {
    let (found, equal) = (Cell::new(0), Cell::new(0));
    let mut runner = TestRunner::new(Config { cases: 300, failure_persistence: None, ..Config::default() });
    runner.run(&draws(3, 2), |draw| {
        let process = &draw.process;
        let d = process.states();
        for length in 1..=2 {
            let bound = match process.uniform_bound(length, 10_000) {
                Ok(bound) => bound,
                Err(BoundError::Unobservable(path)) => {
                    let gramian = gramian(process, Window::Shifted, &path.modes);
                    check(gramian.determinant() == Ok(ratio(0, 1)), "a failing window", process)?;
                    continue;
                }
                Err(error) => return Err(TestCaseError::fail(error.to_string())),
            };
            let modes: Vec<&Vec<usize>> = bound.windows.iter().map(|window| &window.modes).collect();
            check(modes.iter().copied().eq(&windows(process, length)), "the windows", process)?;
            let exact = bound.windows.iter().all(|window| window.covariance == stacked(process, &window.modes));
            check(exact, "the covariance of the observer", process)?;
            let most = bound.windows.iter().map(|window| trace(&window.covariance)).max();
            check(Some(trace(&bound.worst().covariance)) == most, "the largest trace", process)?;
            found.set(found.get() + 1);
            for start in [Matrix::zeros(d, d), draw.start.clone(), Matrix::identity(d).scaled(&ratio(1_000_000, 1))] {
                for path in paths(process, 4) {
                    let mut covariance = start.clone();
                    for (step, &mode) in (1..).zip(&path.modes) {
                        covariance = process.modes()[mode].step(&covariance).next;
                        let Some(above) = bound.after(&path.modes[..step]) else {
                            check(step < length, "a window without a bound", process)?;
                            continue;
                        };
                        check(covariance.loewner_le(above).is_ok(), "the bound is exceeded", process)?;
                        equal.set(equal.get() + usize::from(covariance == *above));
                    }
                }
            }
        }
        Ok(())
    })?;
    // With a sensor for each state and h = 1 the bound is reached as P(0) grows; without noise of the observations, at once.
    assert!(found.get() > 100 && equal.get() > 100, "{} bounds, {} reached", found.get(), equal.get());
    Ok(())
}

fn trace(matrix: &Q) -> Rational {
    (0..matrix.rows()).map(|i| matrix[(i, i)].clone()).sum()
}
