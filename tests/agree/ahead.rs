//! HV-T1: the d-step predictor equals the joint Gaussian of the initial state and all noises, conditioned once.

use std::cell::Cell;
use std::num::NonZero;

use exact_kalman::filter::{filter, one_shot_ahead, predict_ahead};
use exact_kalman::model::{PathAhead, Timing};
use exact_kalman::scalar::Rational;
use exact_kalman::trace::Moments;
use proptest::test_runner::{Config, TestCaseError, TestRunner};

use super::draws::draws;
use super::systems::{Draw, Kind};

pub const KIND: Kind = Kind { states: 3, sensors: 3, steps: 4, adapted: true, gaps: true };

pub fn steps(d: usize) -> NonZero<usize> {
    NonZero::new(d).expect("at least one step")
}

/// The system of a draw whose transitions follow the data d steps late, along data that it can produce.
pub fn realised(draw: &Draw) -> Result<PathAhead<Rational>, String> {
    draw.system().realised_ahead(&draw.data(), steps(draw.lag)).map_err(|error| error.to_string())
}

/// What was met among the systems drawn.
#[derive(Clone, Copy, Default)]
struct Met {
    all: usize,
    arriving: usize,
    singular: usize,
    more_sensors: usize,
}

/// HV-T1, HV-3, HV-4, HV-5, HV-6, HV-7, HV-M.x: for d = 1, …, 4, in both timings, with gaps, feedback and shared noise. A third of the
/// systems has a singular innovation.
///
/// HV-C1: p ≤ s is used nowhere; every tenth system has more sensors than states.
#[test]
fn predictor_eq_one_shot_conditioning() -> Result<(), Box<dyn std::error::Error>> {
    for d in 1..=4 {
        let mut runner = TestRunner::new(Config { cases: 260, failure_persistence: None, ..Config::default() });
        let met = Cell::new(Met::default());
        runner.run(&draws(KIND), |draw| {
            let draw = Draw { lag: d, ..draw };
            let singular = compare(&draw).map_err(TestCaseError::fail)?;
            let Met { all, arriving, singular: before, more_sensors } = met.get();
            met.set(Met {
                all: all + 1,
                arriving: arriving + usize::from(draw.timing == Timing::Arriving),
                singular: before + usize::from(singular),
                more_sensors: more_sensors + usize::from(draw.missing[0].len() > draw.mean.rows()),
            });
            Ok(())
        })?;
        let Met { all, arriving, singular, more_sensors } = met.get();
        assert!(singular * 3 >= all, "only {singular} of {all} systems have a singular innovation");
        assert!(arriving * 3 >= all && (all - arriving) * 3 >= all, "{arriving} of {all} are arriving");
        assert!(more_sensors * 10 >= all, "only {more_sensors} of {all} systems have more sensors than states");
    }
    Ok(())
}

/// Whether some innovation was singular; or what differs.
fn compare(draw: &Draw) -> Result<bool, String> {
    let path = realised(draw)?;
    let trace = predict_ahead(&path).map_err(|error| error.to_string())?;
    let laws = one_shot_ahead(&path).map_err(|error| error.to_string())?;
    let predictions: Vec<_> = std::iter::once(&trace.start).chain(trace.steps.iter().map(|step| &step.ahead)).collect();
    if (predictions.len(), laws.len()) != (path.path().steps().len() + 1, path.path().steps().len() + 1) {
        return Err("a step is missing".into());
    }
    for (known, (ahead, laws)) in predictions.into_iter().zip(&laws).enumerate() {
        if (ahead.len(), laws.len()) != (draw.lag, draw.lag) {
            return Err(format!("{} and {} of {} predictions from {known}", ahead.len(), laws.len(), draw.lag));
        }
        for (i, (Moments { mean, covariance, diffuse }, law)) in ahead.iter().zip(laws).enumerate() {
            if mean != law.mean() || covariance != law.covariance() || diffuse.is_some() {
                return Err(format!("x_{} given {known} readings: {mean} {covariance}, jointly {law:?}", known + i));
            }
        }
    }
    // What the filter says on the way is what it says without looking ahead.
    let filtered = filter(path.path()).map_err(|error| error.to_string())?;
    if !filtered.records.iter().eq(trace.steps.iter().map(|step| &step.record)) {
        return Err("the records are not those of the filter".into());
    }
    let singular =
        |record: &exact_kalman::trace::Record<Rational>| record.innovation_covariance.rank() < record.observed.len();
    Ok(filtered.records.iter().any(singular))
}
