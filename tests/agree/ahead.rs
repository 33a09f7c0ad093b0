//! HV-T1: the d-step predictor equals the joint Gaussian of the initial state and all noises, conditioned once.

use std::cell::Cell;
use std::num::NonZero;

use exact_kalman::filter::{FilterError, filter, one_shot, one_shot_ahead, predict_ahead};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{
    Before, Coefficient, Field, Initial, Input, ModelError, Noise, Observation, PathAhead, System, Timing,
};
use exact_kalman::scalar::{Rational, Scalar, ratio};
use exact_kalman::trace::Moments;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestCaseError, TestRunner};

use super::draws::draws;
use super::systems::{Draw, Kind, Q};

const KIND: Kind = Kind { states: 3, sensors: 3, steps: 4, adapted: true, gaps: true };

pub fn steps(d: usize) -> NonZero<usize> {
    NonZero::new(d).expect("at least one step")
}

/// The system of a draw whose transitions follow the data d steps late, along data that it can produce.
fn realised(draw: &Draw) -> Result<PathAhead<Rational>, String> {
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

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    /// HV-2: the law of the future readings integrated out. `one_shot` conditions x_{k+d} on all readings up to
    /// k + d − 1; averaged over those that follow y_k it must be what `predict_ahead` says at k. One reading more at a
    /// time, each with its law from the record: E and cov of an affine function of it.
    #[test]
    fn tower(draw in draws(Kind { adapted: false, steps: 3, ..KIND }), d in 2usize..=3) {
        let draw = Draw { lag: d, ..draw };
        let fail = |error: &dyn std::fmt::Display| TestCaseError::fail(error.to_string());
        let path = realised(&draw).map_err(|error| fail(&error))?;
        let trace = predict_ahead(&path).map_err(|error| fail(&error))?;
        for (step, next) in trace.steps.iter().zip(trace.steps.iter().skip(1)) {
            // x_{k+2} given y_0, …, y_{k+1} is affine in y_{k+1}: the mean of the innovation is 0, its covariance S.
            for (far, near) in step.ahead.iter().skip(1).zip(&next.ahead) {
                let gain = slope(&draw, &path, &trace.steps, next, near)?;
                let mean = &near.mean - &gain * &next.record.innovation;
                prop_assert_eq!(&far.mean, &mean);
                let covariance = &near.covariance + gain.congruence(&next.record.innovation_covariance);
                prop_assert_eq!(&far.covariance, &covariance);
            }
        }
    }
}

/// The slope of a prediction in the reading y_{k+1}, found by moving that reading along what it may be: the prediction
/// is affine, so differences are exact. On the null space of S nothing may move, and the slope is taken as zero there.
fn slope(
    draw: &Draw,
    path: &PathAhead<Rational>,
    steps: &[exact_kalman::filter::StepAhead<Rational>],
    next: &exact_kalman::filter::StepAhead<Rational>,
    law: &Moments<Rational>,
) -> Result<Q, TestCaseError> {
    let k = steps.iter().position(|step| std::ptr::eq(step, next)).expect("one of them");
    let i = next.ahead.iter().position(|other| std::ptr::eq(other, law)).expect("one of them");
    let covariance = &next.record.innovation_covariance;
    let observed = &next.record.observed;
    let mut moved = Matrix::zeros(law.mean.rows(), observed.len());
    for j in 0..observed.len() {
        // Along the column j of S, which the reading may move by.
        let mut data: Vec<Observation<Rational>> =
            path.path().steps().iter().map(|step| step.reading.clone()).collect();
        let mut entries = data[k].entries().to_vec();
        for (row, &sensor) in observed.iter().enumerate() {
            entries[sensor] = entries[sensor].take().map(|y| y.plus(&covariance[(row, j)]));
        }
        data[k] = Observation::new(entries);
        data.truncate(k + 1);
        let error = |error: String| TestCaseError::fail(error);
        let path = draw.system().realised_ahead(&data, steps_of(path)).map_err(|e| error(e.to_string()))?;
        let trace = predict_ahead(&path).map_err(|e| error(e.to_string()))?;
        let difference = &trace.steps[k].ahead[i].mean - &law.mean;
        for row in 0..difference.rows() {
            moved[(row, j)] = difference[(row, 0)].clone();
        }
    }
    // The slope times S is known; S⁺ takes S away on its range.
    Ok(moved * covariance.pseudo_inverse().map_err(|error| TestCaseError::fail(error.to_string()))?)
}

fn steps_of(path: &PathAhead<Rational>) -> NonZero<usize> {
    path.steps_ahead()
}

/// All vectors of the given length with entries ±1: they have the mean and covariance of N(0, I).
fn signs(length: usize) -> impl Iterator<Item = Vec<Rational>> {
    (0..1u32 << length).map(move |bits| (0..length).map(|i| ratio(1 - 2 * i64::from(bits >> i & 1), 1)).collect())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    /// HV-M.P: `P(k+d|k) = E[(x(k+d) − x̂(k+d|k))(x(k+d) − x̂(k+d|k))ᵀ | Y(k)]`
    ///
    /// HV-M.x, HV-C3: the error is uncorrelated with every reading known, so no affine function of them predicts better. Of the
    /// noise its first two moments alone are used: it is a fair sign here.
    #[test]
    fn covariance_eq_expected_squared_error(draw in draws(Kind { states: 2, sensors: 2, steps: 3, adapted: false, gaps: true }), d in 1usize..=3) {
        let draw = Draw { lag: d, ..draw };
        let (rank, q, total) = (draw.initial_factor.columns(), draw.d_columns(), draw.sources.len());
        let count = rank + q * total;
        prop_assume!(total > 1 && count <= 9);
        let fail = |error: &dyn std::fmt::Display| TestCaseError::fail(error.to_string());
        // Predictions of x_1, …, x_{T−1}: those states are simulated.
        let pairs: Vec<(usize, usize)> =
            (0..total).flat_map(|k| (k + 1..total.min(k + d + 1)).map(move |state| (k, state))).collect();
        let n = draw.mean.rows();
        let mut squares = vec![Matrix::zeros(n, n); pairs.len()];
        let mut products: Vec<Vec<Q>> = Vec::new();
        let mut covariances = Vec::new();
        for sign in signs(count) {
            let column = |from: usize, length: usize| Matrix::column(sign[from..from + length].to_vec());
            let sources: Vec<Q> = (0..total).map(|k| column(rank + q * k, q)).collect();
            let (states, readings) = draw.simulated(&column(0, rank), &sources);
            let data = draw.observations(&readings);
            let path = draw.system().realised_ahead(&data, steps(d)).map_err(|error| fail(&error))?;
            let trace = predict_ahead(&path).map_err(|error| fail(&error))?;
            let laws: Vec<&Moments<Rational>> = pairs.iter().map(|&(k, s)| &trace.steps[k].ahead[s - k - 1]).collect();
            covariances = laws.iter().map(|law| law.covariance.clone()).collect();
            products.resize(pairs.len(), Vec::new());
            for ((law, &(k, state)), (square, products)) in
                laws.iter().zip(&pairs).zip(squares.iter_mut().zip(&mut products))
            {
                let error = &states[state] - &law.mean;
                *square = &*square + &error * error.transpose();
                products.resize(k + 1, Matrix::zeros(0, 0));
                for (product, reading) in products.iter_mut().zip(&data) {
                    let term = &error * reading.values().transpose();
                    *product = if product.shape() == term.shape() { &*product + term } else { term };
                }
            }
        }
        let share = ratio(1, 1 << count);
        for ((square, covariance), products) in squares.iter().zip(&covariances).zip(&products) {
            prop_assert_eq!(&square.scaled(&share), covariance);
            prop_assert!(products.iter().all(Matrix::is_zero));
        }
    }

    /// A diffuse start: the mean and both orders of the covariance are limits; what remains falls like 1/κ.
    #[test]
    fn diffuse_predictions_are_limits(
        draw in draws(Kind { states: 3, sensors: 2, steps: 3, adapted: true, gaps: true }),
        entries in vec(-2i64..=2, 3),
        d in 1usize..=3,
    ) {
        let draw = Draw { lag: d, ..draw };
        let direction = Matrix::from_fn(draw.mean.rows(), 1, |i, _| ratio(entries[i], 1));
        let part = &direction * direction.transpose();
        let draw = Draw { mean: &draw.mean + &direction, ..draw };
        let traced = |kappa: Option<&Rational>| {
            let mut system = draw.system();
            match kappa {
                Some(kappa) => system.initial.covariance = system.initial.covariance + part.scaled(kappa),
                None => system.initial.diffuse = Some(part.clone()),
            }
            let path = system.realised_ahead(&draw.data(), steps(d)).map_err(|e| TestCaseError::fail(e.to_string()))?;
            let trace = predict_ahead(&path).map_err(|e| TestCaseError::fail(e.to_string()))?;
            let laws = trace.start.into_iter().chain(trace.steps.into_iter().flat_map(|step| step.ahead));
            Ok::<Vec<_>, TestCaseError>(laws.collect())
        };
        let (small, large) = (ratio(10, 1).pow(12), ratio(10, 1).pow(15));
        let (limits, first, second) = (traced(None)?, traced(Some(&small))?, traced(Some(&large))?);
        let remainder = |finite: &Moments<Rational>, limit: &Moments<Rational>, kappa: &Rational| -> Vec<Rational> {
            let n = limit.mean.rows();
            let growing = limit.diffuse.clone().unwrap_or_else(|| Matrix::zeros(n, n)).scaled(kappa);
            let covariance = &finite.covariance - &limit.covariance - growing;
            let mean = &finite.mean - &limit.mean;
            mean.entries().iter().chain(covariance.entries()).cloned().collect()
        };
        for ((limit, first), second) in limits.iter().zip(&first).zip(&second) {
            for (first, second) in remainder(first, limit, &small).iter().zip(&remainder(second, limit, &large)) {
                // 1/1000 of it is left, up to the next order.
                let reduced = second.times(&ratio(900, 1));
                prop_assert!(reduced.times(&reduced) <= first.times(first), "{first} then {second}");
            }
        }
    }
}

/// A scalar walk with lists of so many transitions.
fn listed(timing: Timing, transitions: usize) -> System<Rational> {
    let one = Matrix::<Rational>::identity(1);
    let list = |value: i64| Coefficient::per_step((0..transitions).map(|_| Matrix::from_integers(&[[value]])));
    System {
        timing,
        initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), one.clone()),
        transition: list(2),
        observation: one.clone().into(),
        noise: Noise::Covariances { process: list(1), cross: None, observation: one.into() },
        input: Some(Input { matrix: None, vector: list(3) }),
        observation_input: None,
    }
}

/// Lists may go on beyond the last observation as far as they are needed, and where they end prediction ends.
#[test]
fn prediction_ends_with_the_lists() {
    let data = [1, 4].map(|y| Observation::complete([ratio(y, 1)]));
    // How many laws there are after the last reading, for lists of two entries and more.
    for (timing, numbers) in [(Timing::Departing, [1, 2, 3]), (Timing::Arriving, [0, 1, 2])] {
        for (more, number) in numbers.into_iter().enumerate() {
            let path = listed(timing, 2 + more).realised_ahead(&data, steps(3)).unwrap();
            let trace = predict_ahead(&path).unwrap();
            let lengths = [&trace.start, &trace.steps[0].ahead, &trace.steps[1].ahead].map(Vec::len);
            assert_eq!(lengths, [3.min(number + 2), 3.min(number + 1), number], "{timing:?}");
            let laws = one_shot_ahead(&path).unwrap();
            assert_eq!(laws.iter().map(Vec::len).collect::<Vec<_>>(), lengths);
            let moments = trace.steps[1].ahead.iter().map(|law| (&law.mean, &law.covariance));
            assert!(moments.eq(laws[2].iter().map(|law| (law.mean(), law.covariance()))));
        }
        let beyond = if timing == Timing::Departing { 2 } else { 3 };
        assert!(listed(timing, 2 + beyond).realised_ahead(&data, steps(3)).is_ok());
        for found in [1, 3 + beyond] {
            let error = listed(timing, found).realised_ahead(&data, steps(3)).expect_err("too few or too many");
            assert_eq!(error, ModelError::Length { field: Field::Transition, expected: 2, beyond, found });
        }
        assert!(listed(timing, 3).realised(&data).is_err(), "a filter needs none beyond");
    }
    // Without the transition that departs from the last reading those after it are of no use.
    let mut broken = listed(Timing::Departing, 4);
    let entry = || Some(Matrix::<Rational>::identity(1));
    broken.transition = Coefficient::PerStep(vec![entry(), None, entry(), entry()]);
    let trace = predict_ahead(&broken.realised_ahead(&data, steps(3)).unwrap()).unwrap();
    assert_eq!(trace.steps[1].ahead, []);
}

/// The transitions beyond the last observation are checked as the others are.
#[test]
fn transitions_beyond_are_checked() {
    let data = [1, 4].map(|y| Observation::complete([ratio(y, 1)]));
    let refused = |system: System<Rational>| system.realised_ahead(&data, steps(2)).expect_err("a bad transition");
    let list = |last: Q| Coefficient::per_step([Matrix::identity(1), Matrix::identity(1), last]);
    let mut wide = listed(Timing::Departing, 3);
    wide.transition = list(Matrix::zeros(1, 2));
    assert!(matches!(refused(wide), ModelError::Shape { .. }));
    let mut negative = listed(Timing::Departing, 3);
    negative.noise = Noise::Covariances {
        process: list(Matrix::from_integers(&[[-1]])),
        cross: None,
        observation: Matrix::identity(1).into(),
    };
    assert!(matches!(refused(negative), ModelError::Indefinite { .. }));
}

/// HV-T1 holds almost surely: on data of probability zero the predictor stops, and keeps what it predicted before.
#[test]
fn what_was_predicted_before_a_contradiction_is_kept() {
    let (zero, one) = (Matrix::<Rational>::zeros(1, 1), Matrix::<Rational>::identity(1));
    let constant = System {
        noise: Noise::Covariances { process: zero.clone().into(), cross: None, observation: zero.into() },
        transition: one.clone().into(),
        input: None,
        ..listed(Timing::Departing, 0)
    };
    let data = [0, 1].map(|y| Observation::complete([ratio(y, 1)]));
    let path = constant.realised_ahead(&data, steps(2)).unwrap();
    let Err(FilterError { step, computed, .. }) = predict_ahead(&path) else { panic!("x is read as 0 and as 1") };
    assert_eq!((step, computed.start.len(), computed.steps.len()), (1, 2, 1));
    assert!(computed.steps[0].ahead.iter().all(|law| law.mean.is_zero() && law.covariance.is_zero()));
    assert!(matches!(one_shot_ahead(&path), Err(FilterError { step: 1, .. })));
    assert!(one_shot(path.path()).is_err());
}
