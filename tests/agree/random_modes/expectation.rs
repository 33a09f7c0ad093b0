//! The law of P(k) against the filter run along every path.

use std::cell::Cell;
use std::collections::BTreeMap;

use exact_kalman::filter::filter;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Noise, Observation, System, Timing};
use exact_kalman::scalar::{Rational, Scalar, ratio};
use exact_kalman::stability::{CovarianceLaw, Mode};
use proptest::test_runner::{Config, TestCaseError, TestRunner};

use super::super::systems::Q;
use super::draws::{Draw, draws};
use super::{Process, paths};

/// P(k) after these modes: the covariance that the filter of the paper of 1989 predicts.
fn predicted(process: &Process, start: &Q, modes: &[usize]) -> Result<Q, String> {
    // The observation of time k itself is not used, but a path ends with one.
    let along = || modes.iter().chain([&0]).map(|&mode| &process.modes()[mode]);
    let per_step = |part: fn(&Mode<Rational>) -> &Q| Coefficient::per_step(along().map(part).cloned());
    let (d, m) = (process.states(), process.modes()[0].observation().rows());
    let system = System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, Matrix::zeros(d, 1), start.clone()),
        transition: per_step(Mode::transition),
        observation: per_step(Mode::observation),
        noise: Noise::Covariances {
            process: per_step(Mode::process_noise),
            cross: None,
            observation: per_step(Mode::observation_noise),
        },
        input: None,
        observation_input: None,
    };
    let readings = vec![Observation::complete(vec![ratio(0, 1); m]); modes.len() + 1];
    let path = system.realised(&readings).map_err(|error| error.to_string())?;
    let trace = filter(&path).map_err(|error| error.to_string())?;
    Ok(trace.records[modes.len()].predicted.covariance.clone())
}

/// What can be told apart later, and how likely it is: the law of the next mode and P(k); probability and first path.
type Law = BTreeMap<(Vec<Rational>, Vec<Rational>), (Rational, Vec<usize>)>;

fn enumerated(draw: &Draw, steps: usize) -> Result<(Law, Vec<(Rational, Q)>), String> {
    let mut law = Law::new();
    let mut all = Vec::new();
    for path in paths(&draw.process, steps) {
        let covariance = predicted(&draw.process, &draw.start, &path.modes)?;
        let next = path.modes.last().map_or(draw.process.initial(), |&last| draw.process.transition().row(last));
        let state = law
            .entry((next.to_vec(), covariance.entries().to_vec()))
            .or_insert_with(|| (ratio(0, 1), path.modes.clone()));
        state.0 = state.0.plus(&path.probability);
        all.push((path.probability, covariance));
    }
    Ok((law, all))
}

/// Σ probability · P³, by squaring and without the crate's powers.
fn third_moment(all: &[(Rational, Q)], d: usize) -> Q {
    all.iter().fold(Matrix::zeros(d, d), |sum, (probability, p)| sum + (p * (p * p)).scaled(probability))
}

/// WG-D1.1, WG-1: states, probabilities, means, third powers, the worst path: by merging states, and by running a
/// filter along each of all paths.
#[test]
fn the_law_of_the_covariance_is_that_of_all_paths() -> Result<(), Box<dyn std::error::Error>> {
    let (merged, total) = (Cell::new(0), Cell::new(0));
    let mut runner = TestRunner::new(Config { cases: 150, failure_persistence: None, ..Config::default() });
    runner.run(&draws(3, 2), |draw| {
        let mut law = CovarianceLaw::start(&draw.process, draw.start.clone(), 1000).map_err(|error| failed(&error))?;
        for steps in 0..=3 {
            if steps > 0 {
                law.advance().map_err(|error| failed(&error))?;
            }
            let (expected, all) = enumerated(&draw, steps).map_err(TestCaseError::fail)?;
            compare(&law, &draw, &expected, &all)?;
            merged.set(merged.get() + all.len() - expected.len());
            total.set(total.get() + all.len());
        }
        Ok(())
    })?;
    assert!(merged.get() * 20 > total.get(), "only {} of {} paths were merged", merged.get(), total.get());
    Ok(())
}

fn compare(
    law: &CovarianceLaw<'_, Rational>,
    draw: &Draw,
    expected: &Law,
    all: &[(Rational, Q)],
) -> Result<(), TestCaseError> {
    let row = |path: &[usize]| {
        path.last().map_or(draw.process.initial(), |&last| draw.process.transition().row(last)).to_vec()
    };
    let found: Law = law
        .states()
        .iter()
        .map(|state| {
            ((row(&state.path), state.covariance.entries().to_vec()), (state.probability.clone(), state.path.clone()))
        })
        .collect();
    let d = draw.process.states();
    let mean = all.iter().fold(Matrix::zeros(d, d), |sum, (probability, p)| sum + p.scaled(probability));
    let trace = |p: &Q| (0..d).fold(ratio(0, 1), |sum, i| sum.plus(&p[(i, i)]));
    let worst = all.iter().map(|(_, p)| trace(p)).max();
    let checks = [
        ("the number of states", found.len() == law.states().len()),
        ("states", found == *expected),
        ("mean", law.mean() == mean),
        ("third power", law.mean_power(3) == third_moment(all, d)),
        ("power zero", law.mean_power(0) == Matrix::identity(d)),
        ("an entry", law.expectation(|p| p[(0, 0)].clone()) == mean[(0, 0)]),
        ("worst trace", Some(trace(&law.worst().covariance)) == worst),
    ];
    match checks.iter().find(|(_, holds)| !holds) {
        None => Ok(()),
        Some((what, _)) => Err(TestCaseError::fail(format!("{what} at time {}: {:?}", law.time(), law.states()))),
    }
}

fn failed(error: &dyn std::error::Error) -> TestCaseError {
    TestCaseError::fail(error.to_string())
}
