//! HV-X.ad, HV-X.da: the two timings of shared noise, one made from the other without enlarging the state.

use exact_kalman::filter::{FilterError, filter, one_shot};
use exact_kalman::gaussian::ConditionError;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, Path, System, Timing};
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::trace::Trace;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

use super::draws::draws;
use super::systems::{Draw, Kind, Q};

const KIND: Kind = Kind { states: 3, sensors: 3, steps: 4, adapted: true, gaps: true };

fn realised(system: &System<Rational>, draw: &Draw) -> Result<Path<Rational>, TestCaseError> {
    system.realised(&draw.data()).map_err(|error| TestCaseError::fail(error.to_string()))
}

fn filtered(path: &Path<Rational>) -> Result<Trace<Rational>, TestCaseError> {
    filter(path).map_err(|error| TestCaseError::fail(error.to_string()))
}

/// A draw, and a direction in which its start is diffuse (zero: it is not).
fn starts(timing: Timing) -> impl Strategy<Value = (Draw, System<Rational>)> {
    let drawn = draws(KIND).prop_filter("the other timing", move |draw| draw.timing == timing);
    (drawn, vec(-2i64..=2, 3), any::<bool>()).prop_map(|(mut draw, entries, diffuse)| {
        let scale = i64::from(diffuse);
        let direction = Matrix::from_fn(draw.mean.rows(), 1, |i, _| ratio(scale * entries[i], 1));
        draw.mean = &draw.mean + &direction;
        let mut system = draw.system();
        system.initial.diffuse = Some(&direction * direction.transpose());
        (draw, system)
    })
}

/// Runs 500 cases, of which so many must have a singular R.
fn run(
    timing: Timing,
    check: impl Fn(&Draw, &Path<Rational>) -> Result<(), TestCaseError>,
) -> Result<(), Box<dyn std::error::Error>> {
    let mut runner = TestRunner::new(Config { cases: 500, failure_persistence: None, ..Config::default() });
    let counts = std::cell::Cell::new((0, 0));
    runner.run(&starts(timing), |(draw, system)| {
        let path = realised(&system, &draw)?;
        let singular = path.steps().iter().any(|step| step.observation_noise.rank() < path.sensors());
        let (all, some) = counts.get();
        counts.set((all + 1, some + usize::from(singular)));
        check(&draw, &path)
    })?;
    let (all, singular) = counts.get();
    assert!(singular * 3 >= all, "only {singular} of {all} systems have a singular R");
    Ok(())
}

/// HV-X.ad: `z(k+1) = A z(k) + B u + D w(k),  y(k) = C A z(k) + C B u + G v + (C D + F)w(k),  z(k+1) = x(k)`
///
/// What is predicted of z_{k+1} is what is filtered of x_k; readings, innovations and likelihoods are the same.
#[test]
fn arriving_as_departing() -> Result<(), Box<dyn std::error::Error>> {
    run(Timing::Arriving, |_, path| {
        let departing = path.to_departing();
        prop_assert_eq!((departing.timing(), departing.states()), (Timing::Departing, path.states()));
        let (trace, converted) = (filtered(path)?, filtered(&departing)?);
        prop_assert_eq!(trace.records.len(), converted.records.len());
        let predicted = converted.records.iter().skip(1).map(|record| &record.predicted).chain(&converted.ahead);
        for (record, predicted) in trace.records.iter().zip(predicted) {
            prop_assert_eq!(&record.filtered, predicted);
        }
        for (record, converted) in trace.records.iter().zip(&converted.records) {
            prop_assert_eq!(&record.innovation, &converted.innovation);
            prop_assert_eq!(&record.innovation_covariance, &converted.innovation_covariance);
            prop_assert_eq!(&record.innovation_diffuse, &converted.innovation_diffuse);
            prop_assert_eq!(&record.likelihood, &converted.likelihood);
        }
        prop_assert_eq!(departing.to_departing(), departing);
        Ok(())
    })
}

/// HV-X.da: `x(k+1) = (A − L C)x(k) + B u + L(y(k) − G v) + D(I − F⁺F)w(k),  L = D F⁺ = (D Fᵀ)(F Fᵀ)⁺`
///
/// The states are the same, and so is everything that is said of them.
#[test]
fn departing_as_arriving() -> Result<(), Box<dyn std::error::Error>> {
    run(Timing::Departing, |draw, path| {
        let arriving = path.to_arriving().map_err(|error| TestCaseError::fail(error.to_string()))?;
        prop_assert_eq!((arriving.timing(), arriving.states()), (Timing::Arriving, path.states()));
        prop_assert_eq!(filtered(path)?.records, filtered(&arriving)?.records);
        // The factors say the same as the covariances: D F⁺ and D(I − F⁺F).
        let (d, f) = (&draw.d, &draw.f);
        if draw.missing.iter().flatten().all(|gone| !gone) && !d.is_adapted() && !f.is_adapted() {
            let inverse = f.base().pseudo_inverse().map_err(|error| TestCaseError::fail(error.to_string()))?;
            let rest = d.base() * (Matrix::identity(draw.d_columns()) - &inverse * f.base());
            for (before, after) in path.steps().iter().zip(arriving.steps().iter().skip(1)) {
                let Some(transition) = &after.transition else { return Err(TestCaseError::fail("no transition")) };
                let Some(departing) = &before.transition else { return Err(TestCaseError::fail("no transition")) };
                prop_assert_eq!(&transition.noise, &(&rest * rest.transpose()));
                prop_assert_eq!(&transition.matrix, &(&departing.matrix - d.base() * &inverse * &before.observation));
                prop_assert!((&rest * f.base().transpose()).is_zero(), "uncorrelated with F w");
            }
        }
        // There and back: the state before each transition of the arriving system.
        let there_and_back = filtered(&arriving.to_departing())?;
        let predicted = there_and_back.records.iter().skip(1).map(|record| &record.predicted);
        for (record, predicted) in filtered(path)?.records.iter().zip(predicted.chain(&there_and_back.ahead)) {
            prop_assert_eq!(&record.filtered, predicted);
        }
        Ok(())
    })
}

/// Scalars A = C = D = F = 1 with x_0 = 0 known: y_0 = w_0.
fn ones(timing: Timing) -> System<Rational> {
    let one: Q = Matrix::identity(1);
    System {
        timing,
        initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), Matrix::zeros(1, 1)),
        transition: one.clone().into(),
        observation: one.clone().into(),
        noise: Noise::Factors { process: one.clone().into(), observation: one.into() },
        input: None,
        observation_input: None,
    }
}

/// HV-1a: the two timings are two models. Departing, y_0 = w_0 is x_1, so nothing is left to be guessed; with the cross term
/// at the other time x_1 has the variance 1.
#[test]
fn a_mistimed_cross_term_is_another_model() {
    let data = [3, 5].map(|y| Observation::complete([ratio(y, 1)]));
    let predicted = |timing| {
        let path = ones(timing).realised(&data).expect("shapes that fit");
        let record = filter(&path).expect("data as the system makes them").records[1].predicted.clone();
        let law = one_shot(&path).expect("data as the system makes them")[1].predicted.clone();
        assert_eq!((law.mean(), law.covariance()), (&record.mean, &record.covariance));
        (record.mean[(0, 0)].clone(), record.covariance[(0, 0)].clone())
    };
    assert_eq!(predicted(Timing::Departing), (ratio(3, 1), ratio(0, 1)));
    assert_eq!(predicted(Timing::Arriving), (ratio(0, 1), ratio(1, 1)));
}

/// Data of probability zero are refused at the same step in either timing.
#[test]
fn contradictions_stay_where_they_are() {
    let mut silent = ones(Timing::Departing);
    silent.noise = Noise::Factors { process: Matrix::identity(1).into(), observation: Matrix::zeros(1, 1).into() };
    for (data, step) in [([0, 1, 1], None), ([1, 0, 0], Some(0))] {
        let data = data.map(|y| Observation::complete([ratio(y, 1)]));
        let path = silent.realised(&data).expect("shapes that fit");
        for path in [
            path.clone(),
            path.to_arriving().expect("rationals have pseudo-inverses"),
            path.to_arriving().expect("rationals have pseudo-inverses").to_departing(),
        ] {
            match (filter(&path), step) {
                (Ok(_), None) => {}
                (Err(FilterError { step, source: ConditionError::Inconsistent(_), .. }), Some(expected)) => {
                    assert_eq!(step, expected);
                }
                other => panic!("{other:?}"),
            }
        }
    }
}
