//! Estimates from a mixture in f64, against proved enclosures, by the digits that can be attained.

use exact_kalman::float::{MixtureError, MixtureEstimate, MixturePart, estimate_mixture};
use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Path, Timing};
use exact_kalman::nongaussian::{Component, Enclosed, InitialLaw, statistics};
use exact_kalman::scalar::{Rational, ratio};
use num_bigint::BigInt;
use num_traits::ToPrimitive;
use proptest::prelude::*;

use crate::systems;

type Parts = Vec<(Rational, Matrix<Rational>, Matrix<Rational>)>;

/// Two atoms and a slab around the origin, in halves.
fn parts(n: usize) -> Parts {
    let column = |of: fn(i64) -> i64| Matrix::from_fn(n, 1, |i, _| ratio(of(i64::try_from(i).unwrap()), 2));
    let zero = Matrix::zeros(n, n);
    vec![
        (ratio(1, 4), column(|i| i - 1), zero.clone()),
        (ratio(1, 4), column(|i| 2 - 3 * i), zero),
        (ratio(1, 2), column(|_| 1), Matrix::identity(n)),
    ]
}

/// All numbers of the last step: best estimate, best affine one, weights; to 80 bits.
fn exact(path: &Path<Rational>, parts: &Parts) -> Vec<Rational> {
    let component = |(weight, mean, covariance): &(Rational, Matrix<Rational>, Matrix<Rational>)| Component {
        weight: weight.clone(),
        law: Gaussian::new(mean.clone(), covariance.clone()).unwrap(),
    };
    let law = InitialLaw::mixture(parts.iter().map(component)).unwrap();
    let now = statistics(path).unwrap().pop().unwrap();
    let posterior = now.posterior(&law);
    let number = |found: &Enclosed| match found {
        Enclosed::Exact(value) => value.clone(),
        // The width is no more than 2^−80 of the value.
        Enclosed::Between(interval) => interval.lower().value().unwrap(),
    };
    let best = posterior.mean(80).unwrap();
    let weights = posterior.weights(80).unwrap();
    let linear = now.linear(&law).estimate;
    best.iter().map(number).chain(linear.entries().to_vec()).chain(weights.iter().map(number)).collect()
}

fn double(found: &MixtureEstimate) -> Vec<f64> {
    [found.mean.entries(), found.linear.entries(), &found.weights].concat()
}

/// Every number moved by 0 or ±2⁻⁵³ of itself, as a function of its value, so that symmetric matrices stay so.
fn moved(value: &Rational, seed: u64) -> Rational {
    let hash =
        value.to_string().bytes().fold(seed, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
    let direction = i64::try_from((hash >> 20) % 3).unwrap() - 1;
    value + value * Rational::new(BigInt::from(direction), BigInt::from(1) << 53)
}

fn error(found: &[Rational], truth: &[Rational]) -> f64 {
    let errors = found.iter().zip(truth).map(|(found, truth)| (found - truth).to_f64().unwrap().abs());
    // Weights are at most one, means are of the order of one or more: the scale is that of the largest of all.
    errors.fold(0.0, f64::max) / truth.iter().map(|truth| truth.to_f64().unwrap().abs()).fold(1.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// The data moved by a relative 2⁻⁵³ move the exact answers by some amount, the worst of eight; the f64 answers lose at most two
    /// digits more than that, as the judge grants, and never more than two digits against 2⁻⁵³ itself where the data do
    /// not matter.
    #[test]
    fn as_good_as_the_data_allow(path in systems::paths(Timing::Departing)) {
        let parts = parts(path.states());
        let truth = exact(&path, &parts);
        let attainable = (0..8).map(|seed| {
            let Ok(path) = path.try_map(|value| Ok::<_, std::convert::Infallible>(moved(value, seed)));
            let law = parts.iter().map(|(weight, mean, covariance)| {
                (weight.clone(), mean.map(|value| moved(value, seed)), covariance.map(|value| moved(value, seed)))
            });
            error(&exact(&path, &law.collect()), &truth)
        });
        let attainable = attainable.fold(f64::EPSILON / 2.0, f64::max);
        let double_parts: Vec<_> = parts.iter().map(|(weight, mean, covariance)| MixturePart {
            weight: weight.to_f64().unwrap(),
            mean: mean.map(|value| value.to_f64().unwrap()),
            covariance: covariance.map(|value| value.to_f64().unwrap()),
        }).collect();
        let found = estimate_mixture(&systems::doubles(&path), &double_parts).expect("a regular system");
        let found: Vec<Rational> = double(found.last().unwrap()).into_iter().map(|x| Rational::from_float(x).unwrap()).collect();
        let found = error(&found, &truth);
        prop_assert!(found <= 100.0 * attainable, "{found:e} where {attainable:e} is attainable");
    }
}

/// Evidence beyond every double: e^(±5·10⁵) is no obstacle to the logarithm of a sum.
#[test]
fn huge_evidence_is_no_obstacle() {
    let path = systems::doubles(&systems::twin_sensors(9, &[1000, 1000]));
    let n = path.states();
    let part = |x: f64| MixturePart {
        weight: 0.5,
        mean: Matrix::from_fn(n, 1, |_, _| x),
        covariance: Matrix::from_fn(n, n, |_, _| 0.0),
    };
    let found = estimate_mixture(&path, &[part(0.0), part(1000.0)]).map(|mut all| all.pop().unwrap().weights);
    match found {
        Ok(weights) => assert!((weights[1] - 1.0).abs() < 1e-15 && weights[0] < 1e-15, "{weights:?}"),
        Err(error) => assert!(matches!(error, MixtureError::Singular { .. })),
    }
}
