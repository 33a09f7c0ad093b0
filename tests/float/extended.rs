//! The extended predictor: on linear systems it is the ordinary one; on others, small cases by hand.

use std::convert::Infallible;
use std::num::NonZeroUsize;

use exact_kalman::float::{
    AdditiveNoise, ExtendedError, ExtendedObstacle, ExtendedSystem, ExtendedTrace, Function, Linearisation, Linearised,
    predict_extended,
};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Initial, Observation, Path, Timing, Transition};
use exact_kalman::scalar::Rational;
use exact_kalman::trace::{Moments, Quantity};
use num_traits::ToPrimitive;
use proptest::prelude::*;

use crate::{DIGITS, systems, truth};

const BOTH: [Linearisation; 2] = [Linearisation::Prediction, Linearisation::Filtered];

fn steps(ahead: usize) -> NonZeroUsize {
    NonZeroUsize::new(ahead).expect("at least one")
}

/// `a x + b` and its derivative a.
fn affine(a: &Matrix<f64>, b: &Matrix<f64>, x: &Matrix<f64>) -> Linearised {
    let row = |i: usize| a.row(i).iter().zip(x.entries()).map(|(a, x)| a * x).sum::<f64>() + b[(i, 0)];
    Linearised { value: Matrix::from_fn(a.rows(), 1, |i, _| row(i)), jacobian: a.clone() }
}

/// The extended predictor on a path, whose last transitions are repeated beyond its end.
fn of_path(path: &Path<f64>, linearisation: Linearisation, ahead: usize) -> ExtendedTrace {
    let (n, m) = (path.states(), path.sensors());
    let transition = |k: usize| -> Option<&Transition<f64>> { path.steps().get(k)?.transition.as_ref() };
    let still = |x: &Matrix<f64>| Linearised {
        value: x.clone(),
        jacobian: Matrix::from_fn(n, n, |i, j| if i == j { 1.0 } else { 0.0 }),
    };
    let f = |k: usize, x: &Matrix<f64>| {
        Ok::<_, Infallible>(transition(k).map_or_else(|| still(x), |given| affine(&given.matrix, &given.input, x)))
    };
    let h = |k: usize, x: &Matrix<f64>| {
        let step = &path.steps()[k];
        Ok(affine(&step.observation, &step.observation_input, x))
    };
    let zeros = |rows: usize, columns: usize| Matrix::from_fn(rows, columns, |_, _| 0.0);
    let noise = |k: usize| AdditiveNoise {
        process: transition(k).map_or_else(|| zeros(n, n), |given| given.noise.clone()),
        cross: transition(k).map_or_else(|| zeros(n, m), |given| given.cross_noise.clone()),
        observation: path.steps().get(k).map_or_else(|| zeros(m, m), |step| step.observation_noise.clone()),
    };
    let Initial { mean, covariance, .. } = path.initial();
    let system = ExtendedSystem { mean, covariance, transition: &f, observation: &h, noise: &noise, linearisation };
    let readings: Vec<_> = path.steps().iter().map(|step| step.reading.clone()).collect();
    predict_extended(&system, &readings, steps(ahead)).expect("a regular system")
}

/// The digits that are right of a mean and a covariance, in units of the exact standard deviations.
fn digits(found: &Moments<f64>, mean: &Matrix<Rational>, covariance: &Matrix<Rational>) -> f64 {
    let deviation = |i: usize| covariance[(i, i)].to_f64().expect("a double").sqrt();
    let of = |found: f64, exact: &Rational, scale: f64| {
        let error = (Rational::from_float(found).expect("finite") - exact).to_f64().expect("a double").abs();
        if error == 0.0 { 17.0 } else { -(error / scale.max(exact.to_f64().expect("a double").abs())).log10() }
    };
    let n = mean.rows();
    let means = (0..n).map(|i| of(found.mean[(i, 0)], &mean[(i, 0)], deviation(i)));
    let covariances = (0..n)
        .flat_map(|i| (0..n).map(move |j| (i, j)))
        .map(|(i, j)| of(found.covariance[(i, j)], &covariance[(i, j)], deviation(i) * deviation(j)));
    means.chain(covariances).fold(17.0, f64::min)
}

/// The same path with the readings from `first` on missing.
fn unread(path: &Path<Rational>, first: usize) -> Path<Rational> {
    use exact_kalman::model::{Coefficient, Input, Noise, System};
    let steps = path.steps();
    let of = |entry: &dyn Fn(usize) -> Matrix<Rational>| Coefficient::per_step((0..steps.len()).map(entry));
    let (n, m) = (path.states(), path.sensors());
    let transition = |k: usize| steps[k].transition.clone();
    let system = System {
        timing: path.timing(),
        initial: path.initial().clone(),
        transition: of(&|k| transition(k).map_or_else(|| Matrix::identity(n), |given| given.matrix)),
        observation: of(&|k| steps[k].observation.clone()),
        noise: Noise::Covariances {
            process: of(&|k| transition(k).map_or_else(|| Matrix::zeros(n, n), |given| given.noise)),
            cross: Some(of(&|k| transition(k).map_or_else(|| Matrix::zeros(n, m), |given| given.cross_noise))),
            observation: of(&|k| steps[k].observation_noise.clone()),
        },
        input: Some(Input {
            matrix: None,
            vector: of(&|k| transition(k).map_or_else(|| Matrix::zeros(n, 1), |given| given.input)),
        }),
        observation_input: Some(Input { matrix: None, vector: of(&|k| steps[k].observation_input.clone()) }),
    };
    let readings: Vec<_> = steps
        .iter()
        .enumerate()
        .map(|(k, step)| if k < first { step.reading.clone() } else { Observation::missing(m) })
        .collect();
    system.realised(&readings).expect("the same system")
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// HV-3, HV-6, HV-7, one to three steps ahead: with nothing to make linear both forms agree with the joint law, in
    /// which the readings in between are missing.
    #[test]
    fn linear_systems_have_the_ordinary_predictor(path in systems::paths(Timing::Departing)) {
        let doubles = systems::doubles(&path);
        for linearisation in BOTH {
            let trace = of_path(&doubles, linearisation, 3);
            for (k, exact) in truth::values(&path).iter().enumerate() {
                let (mean, covariance) = (&exact[&Quantity::FilteredMean], &exact[&Quantity::FilteredCovariance]);
                prop_assert!(digits(&trace.steps[k].filtered, mean, covariance) >= DIGITS);
            }
            for first in 0..path.steps().len() {
                let exact = truth::values(&unread(&path, first));
                for ahead in 1..=3_usize.min(path.steps().len() - first) {
                    let exact = &exact[first + ahead - 1];
                    let (mean, covariance) = (&exact[&Quantity::PredictedMean], &exact[&Quantity::PredictedCovariance]);
                    let found = match first.checked_sub(1) {
                        Some(last) => &trace.steps[last].ahead[ahead - 1],
                        None => &trace.prior[ahead - 1],
                    };
                    let digits = digits(found, mean, covariance);
                    prop_assert!(digits >= DIGITS, "{linearisation:?}, {ahead} ahead: {digits:.1} digits");
                }
            }
        }
    }
}

fn scalar(value: f64) -> Matrix<f64> {
    Matrix::column(vec![value])
}

fn square(x: &Matrix<f64>) -> Linearised {
    Linearised { value: scalar(x[(0, 0)] * x[(0, 0)]), jacobian: scalar(2.0 * x[(0, 0)]) }
}

/// `x₊ = x² + w, y = x² + v` from x̂ = 2, P = 1, Q = 1, DF = 4, R = 16 and y = 12, all by hand in dyadic numbers:
/// C = 4, S = 32, ν = 8, K = 1/8, so x̂(0|0) = 3 and P(0|0) = 1 − 16/32.
#[test]
fn both_forms_by_hand() {
    let noise = |_| AdditiveNoise { process: scalar(1.0), cross: scalar(4.0), observation: scalar(16.0) };
    for (linearisation, mean, covariance) in [
        // A = 4, K₊ = (4·4 + 4)/32: mean 4 + 8·20/32, variance 16 + 1 − 20²/32.
        (Linearisation::Prediction, 9.0, 4.5),
        // A = 6, K₊ = (6·4 + 4)/32: mean 9 + 8·4/32, variance 36 + 1 − 28²/32.
        (Linearisation::Filtered, 10.0, 12.5),
    ] {
        let f = |_, x: &Matrix<f64>| Ok::<_, Infallible>(square(x));
        let (start, variance) = (scalar(2.0), scalar(1.0));
        let system = ExtendedSystem {
            mean: &start,
            covariance: &variance,
            transition: &f,
            observation: &f,
            noise: &noise,
            linearisation,
        };
        let trace = predict_extended(&system, &[Observation::complete([12.0])], steps(2)).expect("regular");
        let step = &trace.steps[0];
        assert_eq!((&step.filtered.mean, &step.filtered.covariance), (&scalar(3.0), &scalar(0.5)));
        assert_eq!((&step.ahead[0].mean, &step.ahead[0].covariance), (&scalar(mean), &scalar(covariance)));
        // One more step: the square of the mean, and the variance times the square of its double, plus one.
        let further = (mean * mean, 4.0 * mean * mean * covariance + 1.0);
        assert_eq!((&step.ahead[1].mean, &step.ahead[1].covariance), (&scalar(further.0), &scalar(further.1)));
        // Before any reading: 2² = 4 with variance 16 + 1.
        assert_eq!(trace.prior.len(), 2);
        assert_eq!((&trace.prior[1].mean, &trace.prior[1].covariance), (&scalar(4.0), &scalar(17.0)));
        let predictions: Vec<f64> = trace.predictions().map(|law| law.mean[(0, 0)]).collect();
        assert_eq!(predictions, [2.0, 4.0, further.0]);
        // A missing reading: x̂ stays, and so both forms are one.
        let missing = predict_extended(&system, &[Observation::missing(1)], steps(1)).expect("regular");
        assert_eq!(missing.steps[0].filtered.mean, start);
        assert_eq!(missing.steps[0].ahead[0].covariance, scalar(17.0));
    }
}

#[test]
fn obstacles_are_values_with_their_step() {
    let noise = |_| AdditiveNoise { process: scalar(0.0), cross: scalar(0.0), observation: scalar(0.0) };
    let itself = |_: usize, x: &Matrix<f64>| Ok(Linearised { value: x.clone(), jacobian: scalar(1.0) });
    let (mean, covariance) = (scalar(1.0), scalar(1.0));
    let run = |f: &Function<'_, String>, readings: &[f64]| {
        let system = ExtendedSystem {
            mean: &mean,
            covariance: &covariance,
            transition: f,
            observation: &itself,
            noise: &noise,
            linearisation: Linearisation::Filtered,
        };
        let readings: Vec<_> = readings.iter().map(|&y| Observation::complete([y])).collect();
        let ExtendedError { step, source, computed } = predict_extended(&system, &readings, steps(1)).unwrap_err();
        assert_eq!(computed.len(), step);
        (step, source)
    };
    // A reading without noise leaves no variance for the second one.
    assert_eq!(run(&itself, &[1.0, 1.0]), (1, ExtendedObstacle::Singular));
    assert_eq!(run(&itself, &[f64::NAN]), (0, ExtendedObstacle::NotFinite));
    let root = |_: usize, x: &Matrix<f64>| {
        let x = x[(0, 0)];
        if x < 0.0 {
            return Err(format!("no root of {x}"));
        }
        Ok(Linearised { value: scalar(x.sqrt()), jacobian: scalar(0.5 / x.sqrt()) })
    };
    assert_eq!(run(&root, &[-4.0]), (0, ExtendedObstacle::Undefined("no root of -4".to_owned())));
}
