//! Invariants of one state and one sensor: which forms keep them in `f64`, and what breaks the others.
//!
//! `proofs/smt/float` proves or refutes the same in half precision, for all numbers.

use std::fmt::Debug;

use exact_kalman::float::{FloatError, Form, filter};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, Path, System, Timing};
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::trace::{Quantity, Values};

use crate::systems;

/// The forms that subtract KCP from P, and KSKᵀ from what is predicted.
const SHORT: [Form; 3] = [Form::Textbook, Form::PseudoInverse, Form::Symmetrised];

/// A state that stays as it is, of variance p, seen twice through c with noise of variance r.
fn constant(p: i64, c: i64, r: &Rational) -> Path<f64> {
    let one = |value: i64| Matrix::from_integers(&[[value]]);
    let noise = Noise::Covariances { process: one(0).into(), cross: None, observation: one(1).scaled(r).into() };
    let system = System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, one(0), one(p)),
        transition: one(1).into(),
        observation: one(c).into(),
        noise,
        input: None,
        observation_input: None,
    };
    let readings = [1, 2].map(|value| Observation::complete([ratio(value, 1)]));
    systems::doubles(&system.realised(&readings).expect("a valid system"))
}

fn variance(values: &Values<f64>, quantity: Quantity) -> f64 {
    values[&quantity][(0, 0)]
}

/// The variance before and after the first reading.
fn step(form: Form, path: &Path<f64>) -> (f64, f64) {
    let found = filter(form, path);
    let values = found.as_ref().map_or_else(FloatError::computed, Vec::as_slice);
    let Some(first) = values.first() else { panic!("{form}: {found:?}") };
    (variance(first, Quantity::PredictedCovariance), variance(first, Quantity::FilteredCovariance))
}

fn power(exponent: u32) -> Rational {
    ratio(1, 1 << exponent)
}

fn same(found: f64, expected: f64, what: impl Debug) {
    assert_eq!(found.to_bits(), expected.to_bits(), "{what:?}: {found:e}, not {expected:e}");
}

/// P = 5, C = 7 and R = 2⁻⁶⁰ leave R/49 or so, and (I − KC)P makes −5·2⁻⁵² of it: KC is the double above one.
#[test]
fn the_short_update_makes_a_negative_variance() {
    let path = constant(5, 7, &power(60));
    for form in SHORT {
        same(step(form, &path).1, -5.0 * f64::EPSILON, form);
    }
    for form in Form::ALL.into_iter().filter(|form| !SHORT.contains(form)) {
        let (before, after) = step(form, &path);
        assert!((0.0..=before).contains(&after), "{form}: {after:e}");
    }
}

/// P = 7, C = 1 and R = 3·2⁻⁵²: the difference of P and KSKᵀ is −2⁻⁵⁰, though a sensor of the state itself makes no negative (I − K)P.
#[test]
fn the_short_prediction_makes_a_negative_variance() {
    let path = constant(7, 1, &(ratio(3, 1) * power(52)));
    for form in Form::ALL {
        let values = filter(form, &path).unwrap_or_else(|error| panic!("{form}: {error}"));
        let (after, ahead) =
            (variance(&values[0], Quantity::FilteredCovariance), variance(&values[1], Quantity::PredictedCovariance));
        assert!((0.0..=7.0).contains(&after), "{form}: {after:e}");
        if SHORT.contains(&form) {
            same(ahead, -4.0 * f64::EPSILON, form);
        } else {
            assert!((0.0..=7.0).contains(&ahead), "{form}: {ahead:e}");
        }
    }
}

/// 1/(1/49) is the double above 49.
#[test]
fn the_information_form_knows_less_than_it_was_told() {
    let path = constant(49, 1, &power(0));
    let (before, after) = step(Form::Information, &path);
    same(before, 49.0 + 32.0 * f64::EPSILON, "P after two inversions");
    assert!(after <= before);
}

/// Over a thousand small problems: only the short update makes a negative variance, and no form one above the prior that it hands out.
#[test]
fn only_short_updates_make_negative_variances() {
    let (mut negative, mut above) = ([0; Form::ALL.len()], [0; Form::ALL.len()]);
    for p in 1..=16 {
        for c in 1..=9 {
            for exponent in [0, 10, 20, 30, 40, 50, 60] {
                let path = constant(p, c, &power(exponent));
                for (place, form) in Form::ALL.into_iter().enumerate() {
                    let (before, after) = step(form, &path);
                    negative[place] += i32::from(after < 0.0);
                    above[place] += i32::from(after > before);
                }
            }
        }
    }
    for (place, form) in Form::ALL.into_iter().enumerate() {
        assert_eq!(negative[place] > 0, SHORT.contains(&form), "{form}: {} negative variances", negative[place]);
        assert_eq!(above[place], 0, "{form}: {} variances above the prior", above[place]);
    }
}
