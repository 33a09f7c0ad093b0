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

/// About a million, and short in binary.
const FAR: i64 = 1 << 20;

type Parts = Vec<(Rational, Matrix<Rational>, Matrix<Rational>)>;

/// Two atoms and a slab, in halves, around the point with these entries.
fn parts(n: usize, shift: i64) -> Parts {
    let column = |of: fn(i64) -> i64| {
        Matrix::from_fn(n, 1, |i, _| ratio(of(i64::try_from(i).expect("small")), 2) + ratio(shift, 1))
    };
    let zero = Matrix::zeros(n, n);
    vec![
        (ratio(1, 4), column(|i| i - 1), zero.clone()),
        (ratio(1, 4), column(|i| 2 - 3 * i), zero),
        (ratio(1, 2), column(|_| 1), Matrix::identity(n)),
    ]
}

/// The numbers of the last step, in groups that have a scale in common: best estimate, best affine one, weights, covariance, difference
/// of the estimates.
type Groups = [Vec<Rational>; 5];

/// To 80 bits.
fn exact(path: &Path<Rational>, parts: &Parts) -> Groups {
    let component = |(weight, mean, covariance): &(Rational, Matrix<Rational>, Matrix<Rational>)| Component {
        weight: weight.clone(),
        law: Gaussian::new(mean.clone(), covariance.clone()).expect("symmetric"),
    };
    let law = InitialLaw::mixture(parts.iter().map(component)).expect("a law");
    let now = statistics(path).expect("noisy").pop().expect("not empty");
    let (posterior, linear) = (now.posterior(&law), now.linear(&law));
    let number = |found: &Enclosed| match found {
        Enclosed::Exact(value) => value.clone(),
        // The width is no more than 2^−80 of the value.
        Enclosed::Between(interval) => interval.lower().value().expect("short"),
    };
    let numbers = |found: &[Enclosed]| found.iter().map(number).collect::<Vec<_>>();
    [
        numbers(&posterior.mean(80).expect("enclosed")),
        linear.estimate.entries().to_vec(),
        numbers(&posterior.weights(80).expect("enclosed")),
        numbers(posterior.covariance(80).expect("enclosed").entries()),
        numbers(&posterior.difference(&linear, 80).expect("enclosed")),
    ]
}

fn double(found: &MixtureEstimate) -> Groups {
    let exact = |entries: &[f64]| entries.iter().map(|&x| Rational::from_float(x).expect("finite")).collect();
    [
        found.mean.entries(),
        found.linear.entries(),
        &found.weights,
        found.covariance.entries(),
        found.difference.entries(),
    ]
    .map(exact)
}

/// Every number moved by 0 or ±2⁻⁵³ of itself, as a function of its value, so that symmetric matrices stay so.
fn moved(value: &Rational, seed: u64) -> Rational {
    let hash =
        value.to_string().bytes().fold(seed, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
    let direction = i64::try_from((hash >> 20) % 3).expect("small") - 1;
    value + value * Rational::new(BigInt::from(direction), BigInt::from(1) << 53)
}

fn largest(values: impl Iterator<Item = Rational>) -> f64 {
    values.map(|value| value.to_f64().expect("a double").abs()).fold(0.0, f64::max)
}

/// The largest error in each group.
fn errors(found: &Groups, truth: &Groups) -> [f64; 5] {
    std::array::from_fn(|i| largest(found[i].iter().zip(&truth[i]).map(|(found, truth)| found - truth)))
}

/// The data moved by a relative 2⁻⁵³ move the exact answers by some amount, the worst of eight; in each group the f64 answers lose at most
/// two digits more than that, as the judge grants, and never more than two digits against 2⁻⁵³ of the group's scale itself
/// where the data do not matter. The scale is the largest entry, one at least, that of a difference the largest of the two estimates.
fn keeps_the_digits(path: &Path<Rational>, parts: &Parts, truth: &Groups) -> Result<MixtureEstimate, TestCaseError> {
    let moved = (0..8).map(|seed| {
        let Ok(path) = path.try_map(|value| Ok::<_, std::convert::Infallible>(moved(value, seed)));
        let law = parts.iter().map(|(weight, mean, covariance)| {
            (weight.clone(), mean.map(|value| moved(value, seed)), covariance.map(|value| moved(value, seed)))
        });
        errors(&exact(&path, &law.collect()), truth)
    });
    let moved: Vec<[f64; 5]> = moved.collect();
    let double_parts: Vec<_> = parts
        .iter()
        .map(|(weight, mean, covariance)| MixturePart {
            weight: weight.to_f64().expect("a double"),
            mean: mean.map(|value| value.to_f64().expect("a double")),
            covariance: covariance.map(|value| value.to_f64().expect("a double")),
        })
        .collect();
    let mut all = estimate_mixture(&systems::doubles(path), &double_parts).expect("a regular system");
    let found = all.pop().expect("not empty");
    prop_assert_eq!(found.covariance.asymmetry(), None);
    for (group, error) in errors(&double(&found), truth).into_iter().enumerate() {
        let scaled = if group == 4 { [&truth[0][..], &truth[1]].concat() } else { truth[group].clone() };
        let scale = largest(scaled.into_iter()).max(1.0);
        let attainable = moved.iter().map(|errors| errors[group]).fold(scale * f64::EPSILON / 2.0, f64::max);
        prop_assert!(error <= 100.0 * attainable, "group {}: {:e} where {:e} is attainable", group, error, attainable);
    }
    Ok(found)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// SM-4.2, SM-4.3, SM-4.31: on random systems.
    #[test]
    fn as_good_as_the_data_allow(path in systems::paths(Timing::Departing)) {
        let parts = parts(path.states(), 0);
        keeps_the_digits(&path, &parts, &exact(&path, &parts))?;
    }

    /// SM-4.2, SM-4.3: and where start and readings are a million away from the origin.
    #[test]
    fn far_from_the_origin_as_well(path in systems::moved_paths(Timing::Departing, FAR)) {
        let parts = parts(path.states(), FAR);
        keeps_the_digits(&path, &parts, &exact(&path, &parts))?;
    }
}

/// Evidence beyond every double, about e^(±5·10⁵), is no obstacle to the logarithm of a sum: the weights of the atoms (0, 0) and (1000, 1000)
/// are one below every double and 1.
#[test]
fn huge_evidence_is_no_obstacle() {
    let path = systems::twin_sensors(9, &[1000, 1000]);
    let atom = |x: i64| (ratio(1, 2), Matrix::from_fn(2, 1, |_, _| ratio(x, 1)), Matrix::zeros(2, 2));
    let parts = vec![atom(0), atom(1000)];
    let truth = exact(&path, &parts);
    assert!(truth[2][0] > ratio(0, 1) && truth[2][0].to_f64() == Some(0.0));
    match keeps_the_digits(&path, &parts, &truth) {
        Ok(found) => assert_eq!(found.weights, [0.0, 1.0]),
        Err(error) => panic!("{error}"),
    }
}

/// A law that is no number, and sensors without noise, are refused.
#[test]
fn what_has_no_estimate() {
    let part = |x: f64| MixturePart {
        weight: 1.0,
        mean: Matrix::column(vec![x; 2]),
        covariance: Matrix::from_fn(2, 2, |_, _| 0.0),
    };
    let path = systems::doubles(&systems::twin_sensors(9, &[1, 2]));
    assert_eq!(estimate_mixture(&path, &[part(f64::NAN)]), Err(MixtureError::NoLaw));
    assert_eq!(estimate_mixture(&path, &[]), Err(MixtureError::NoLaw));
    // From the third reading on the sensors are equal and have no noise: S is singular.
    let quiet = systems::doubles(&systems::twin_sensors(2, &[1, 2, 3]));
    assert_eq!(estimate_mixture(&quiet, &[part(0.0)]), Err(MixtureError::Singular { step: 2 }));
}
