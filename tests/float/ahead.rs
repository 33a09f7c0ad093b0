//! The f64 predictors against the joint Gaussian law, conditioned exactly.

use std::num::NonZero;

use exact_kalman::filter::one_shot_ahead;
use exact_kalman::float::{FloatError, Form, Inverted, predict_ahead};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Input, Noise, Observation, PathAhead, System, Timing};
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::trace::{Quantity, Values};
use num_traits::ToPrimitive;
use proptest::collection::vec;
use proptest::option::weighted;
use proptest::prelude::*;

use super::{DIGITS, ROUNDINGS, digits};

type Q = Matrix<Rational>;

/// A matrix of quarters up to this many.
fn quarters(rows: usize, columns: usize, bound: i64) -> impl Strategy<Value = Q> {
    vec(-bound..=bound, rows * columns)
        .prop_map(move |entries| Matrix::from_fn(rows, columns, |i, j| ratio(entries[i * columns + j], 4)))
}

/// A random path that changes from step to step, with lists that go on beyond the last reading. As in `systems::paths` R and
/// P₀ are at least I and ‖A‖ is at most 3/2, so S has a condition number below 10⁴; prediction adds no quotient to that.
fn paths(timing: Timing) -> impl Strategy<Value = (PathAhead<Rational>, PathAhead<f64>)> {
    (1usize..=3, 1usize..=3, 1usize..=3, 1usize..=4).prop_flat_map(move |(n, m, steps, d)| {
        let beyond = if timing == Timing::Departing { d - 1 } else { d };
        let initial = (quarters(n, 1, 16), quarters(n, n, 4));
        let dynamics = (vec(quarters(n, n, 2), steps + beyond), vec(quarters(m, n, 4), steps));
        let noise = (vec(quarters(n, 2, 4), steps + beyond), vec(quarters(m, 2, 4), steps));
        let inputs = (vec(quarters(n, 1, 8), steps + beyond), vec(quarters(m, 1, 8), steps));
        let readings = vec(vec(weighted(0.75, (-40i64..40).prop_map(|value| ratio(value, 4))), m), steps);
        (initial, dynamics, noise, inputs, readings).prop_map(move |parts| {
            let ((mean, root), (a, c), (q, f), (u, v), readings) = parts;
            // The own noise [0 I] of each sensor beside the two shared sources keeps S away from singular.
            let process = q.into_iter().map(|q| q.beside(&Matrix::zeros(n, m)));
            let observation = f.into_iter().map(|f| f.beside(&Matrix::identity(m)));
            let system = System {
                timing,
                initial: Initial::new(Before::Observation, mean, &root * root.transpose() + Matrix::identity(n)),
                transition: Coefficient::per_step(a),
                observation: Coefficient::per_step(c),
                noise: Noise::Factors {
                    process: Coefficient::per_step(process),
                    observation: Coefficient::per_step(observation),
                },
                input: Some(Input { matrix: None, vector: Coefficient::per_step(u) }),
                observation_input: Some(Input { matrix: None, vector: Coefficient::per_step(v) }),
            };
            let readings: Vec<_> = readings.into_iter().map(Observation::new).collect();
            let steps_ahead = NonZero::new(d).expect("at least one step");
            let path = system.realised_ahead(&readings, steps_ahead).expect("a valid system");
            let doubles = path.try_map(|value| value.to_f64().ok_or("no double")).expect("short dyadic fractions");
            (path, doubles)
        })
    })
}

/// The moments of a state, under the names by which digits are counted.
fn values<T: Clone>(mean: &Matrix<T>, covariance: &Matrix<T>) -> Values<T> {
    Values::from([
        (Quantity::PredictedMean, mean.clone()),
        (Quantity::PredictedCovariance, covariance.clone()),
        (Quantity::FilteredMean, mean.clone()),
        (Quantity::FilteredCovariance, covariance.clone()),
    ])
}

fn least_digits(form: Form, exact: &PathAhead<Rational>, doubles: &PathAhead<f64>) -> f64 {
    let found = match predict_ahead(form, doubles) {
        // Transitions of these systems are singular at times, and the information form then says so: `least_digits` beside
        // this looks whether that is true.
        Err(FloatError::NoInverse { what: Inverted::State, .. }) if form == Form::Information => return f64::INFINITY,
        found => found.expect("a regular system"),
    };
    let truth = one_shot_ahead(exact).expect("consistent data");
    assert_eq!(found.len() + 1, truth.len());
    let pairs = found.iter().zip(&truth[1..]).flat_map(|(found, truth)| {
        assert_eq!((found.len(), truth.len()), (exact.steps_ahead().get(), exact.steps_ahead().get()));
        found.iter().zip(truth)
    });
    let digits = pairs.map(|(found, truth)| {
        assert_eq!(found.diffuse, None);
        digits::least(&values(&found.mean, &found.covariance), &values(truth.mean(), truth.covariance()))
    });
    digits.fold(f64::INFINITY, f64::min)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// HV-T1 in floating point.
    #[test]
    fn departing_predictions_agree_with_the_joint_law((exact, doubles) in paths(Timing::Departing)) {
        for form in Form::ALL {
            let digits = least_digits(form, &exact, &doubles);
            prop_assert!(digits >= DIGITS, "{form} keeps {digits:.1} digits");
        }
    }

    /// HV-6 and HV-7 in floating point, from the filtered law.
    #[test]
    fn arriving_predictions_agree_with_the_joint_law((exact, doubles) in paths(Timing::Arriving)) {
        for form in Form::ALL {
            let digits = least_digits(form, &exact, &doubles);
            prop_assert!(digits >= DIGITS, "{form} keeps {digits:.1} digits");
        }
    }
}

/// A scalar walk that ends with its readings, with this reading last.
fn walk(last: f64) -> PathAhead<f64> {
    let one = Q::identity(1);
    let walk = System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, Q::zeros(1, 1), one.clone()),
        transition: Coefficient::PerStep(vec![Some(one.clone()), None]),
        observation: one.clone().into(),
        noise: Noise::Covariances { process: one.clone().into(), cross: None, observation: one.into() },
        input: None,
        observation_input: None,
    };
    let data = [1, 77].map(|y| Observation::complete([ratio(y, 1)]));
    let path = walk.realised_ahead(&data, NonZero::new(2).expect("not zero")).expect("a sound system");
    path.try_map(|value| if *value == ratio(77, 1) { Some(last) } else { value.to_f64() }.ok_or(()))
        .expect("all are numbers")
}

#[test]
fn prediction_ends_where_the_transitions_do() {
    for form in Form::ALL {
        let laws = predict_ahead(form, &walk(3.0)).expect("consistent data");
        assert_eq!(laws.iter().map(Vec::len).collect::<Vec<_>>(), [1, 0], "{form}");
        let bound = ROUNDINGS * f64::EPSILON;
        assert!((laws[0][0].mean[(0, 0)] - 0.5).abs() <= bound, "{form}");
        assert!((laws[0][0].covariance[(0, 0)] - 1.5).abs() <= bound, "{form}");
    }
}

#[test]
fn a_reading_that_is_no_number_stops_the_predictor() {
    for form in Form::ALL {
        let error = predict_ahead(form, &walk(f64::NAN)).expect_err("a NaN was read");
        assert!(matches!(error, FloatError::NotFinite { step: 1, .. }), "{form}: {error}");
        assert_eq!(error.computed().len(), 1);
    }
}
