//! The f64 filters against the joint Gaussian law, conditioned exactly.

#![cfg(feature = "float")]

mod ahead;
mod digits;
mod extended;
mod identification;
mod invariants;
mod mixture;
mod random_riccati;
mod steady;
mod systems;
mod truth;

use exact_kalman::float::{FloatError, Form, Inverted, filter};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Path, Timing};
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::trace::{Quantity, Values};
use proptest::prelude::*;

/// What every form keeps of 16 digits on these systems: a condition number below 10⁴ takes at most four, and a few
/// roundings one more. A wrong formula keeps two or three: it is wrong by an amount of the order of the result.
const DIGITS: f64 = 11.0;

/// What the roots and reflections of a scalar step may be wrong by, in units of ε: some eight roundings.
const ROUNDINGS: f64 = 8.0;

/// The fewest digits; of the information form only the steps before a covariance that has no inverse, if it says so where
/// that is true.
fn least_digits(form: Form, path: &Path<Rational>) -> f64 {
    let exact = truth::values(path);
    let found = match filter(form, &systems::doubles(path)) {
        Err(FloatError::NoInverse { what: Inverted::State, step, computed }) if form == Form::Information => {
            // In departing timing a step computes the law of the next state, too; the last one is not among those known here.
            let of_next = usize::from(path.timing() == Timing::Departing);
            let singular = |values: &Values<Rational>| {
                values[&Quantity::PredictedCovariance].ldl().is_ok_and(|ldl| !ldl.is_positive_definite())
            };
            assert!(exact.get(step + of_next).is_none_or(singular), "P has an inverse at step {step}");
            computed
        }
        found => {
            let found = found.expect("a regular system");
            assert_eq!(found.len(), exact.len());
            found
        }
    };
    found.iter().zip(&exact).map(|(found, exact)| digits::least(found, exact)).fold(f64::INFINITY, f64::min)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn agrees_with_the_joint_law_when_departing(path in systems::paths(Timing::Departing)) {
        for form in Form::ALL {
            let digits = least_digits(form, &path);
            prop_assert!(digits >= DIGITS, "{form} keeps {digits:.1} digits");
        }
    }

    #[test]
    fn agrees_with_the_joint_law_when_arriving(path in systems::paths(Timing::Arriving)) {
        for form in Form::ALL {
            let digits = least_digits(form, &path);
            prop_assert!(digits >= DIGITS, "{form} keeps {digits:.1} digits");
        }
    }

    #[test]
    fn all_but_two_are_symmetric_to_the_last_bit(
        path in prop_oneof![systems::paths(Timing::Departing), systems::paths(Timing::Arriving)]
    ) {
        for form in Form::ALL.into_iter().filter(|form| !matches!(form, Form::Textbook | Form::PseudoInverse)) {
            let found = filter(form, &systems::doubles(&path));
            for values in found.as_ref().map_or_else(FloatError::computed, Vec::as_slice) {
                for (quantity, value) in values.iter().filter(|(quantity, _)| quantity.is_covariance()) {
                    prop_assert_eq!(value.asymmetry(), None, "{}: {}", form, quantity);
                }
            }
        }
    }
}

/// The forms that go on where S is singular.
const SINGULAR: [Form; 5] = [Form::PseudoInverse, Form::Sequential, Form::SquareRoot, Form::Ud, Form::Svd];

#[test]
fn equal_sensors_without_noise_have_no_inverse() {
    let path = systems::twin_sensors(2, &[1, 3, 4, 8]);
    let exact = truth::values(&path);
    for form in [Form::Textbook, Form::Joseph, Form::Symmetrised] {
        let error = filter(form, &systems::doubles(&path)).expect_err("S is singular");
        assert!(matches!(error, FloatError::Singular { step: 2, .. }), "{form}: {error}");
        let digits = error.computed().iter().zip(&exact).map(|(found, exact)| digits::least(found, exact));
        assert_eq!(error.computed().len(), 2);
        assert!(digits.fold(f64::INFINITY, f64::min) >= DIGITS);
    }
    let error = filter(Form::Information, &systems::doubles(&path)).expect_err("R is singular");
    assert!(matches!(error, FloatError::NoInverse { what: Inverted::Noise, step: 2, .. }), "{error}");
    assert!(error.is_unsupported() && error.computed().len() == 2);
    for form in SINGULAR {
        let values = filter(form, &systems::doubles(&path)).expect("S has a pseudo-inverse");
        for (step, (values, exact)) in values.iter().zip(&exact).enumerate() {
            for (quantity, exact) in exact {
                // A gain that is not that of Moore and Penrose is left out.
                if *quantity == Quantity::Gain && step >= 2 && form != Form::PseudoInverse {
                    assert!(!values.contains_key(quantity), "{form}");
                    continue;
                }
                // The exact variance of the sensed state is 0 here, so there is no deviation to scale by: compare by the
                // scale of the problem, which is 1.
                for (found, exact) in values[quantity].entries().iter().zip(exact.entries()) {
                    let error = Rational::from_float(*found).expect("a finite number") - exact;
                    let bound = ratio(1, 1 << 40);
                    assert!(error <= bound && -error <= bound, "{form}: {quantity}: {found}, not {exact}");
                }
            }
        }
    }
}

#[test]
fn equal_sensors_without_noise_stop_the_first_step() {
    let path = systems::doubles(&systems::twin_sensors(0, &[1]));
    for form in [Form::Textbook, Form::Joseph, Form::Symmetrised] {
        assert_eq!(filter(form, &path), Err(FloatError::Singular { step: 0, computed: vec![] }));
    }
}

#[test]
fn a_reading_that_is_no_number_is_not_finite() {
    let path = systems::twin_sensors(9, &[1, 2, 77, 3]);
    let spoilt = systems::doubles(&path)
        .try_map(|&value| Ok::<_, std::convert::Infallible>(if (value - 77.0).abs() < 0.5 { f64::NAN } else { value }));
    let Ok(spoilt) = spoilt;
    for form in Form::ALL {
        let error = filter(form, &spoilt).expect_err("a NaN was read");
        assert!(matches!(error, FloatError::NotFinite { step: 2, .. }), "{form}: {error}");
        assert_eq!(error.computed().len(), 2);
    }
}

#[test]
fn a_diffuse_start_is_refused_unless_it_is_none() {
    use exact_kalman::model::{Before, Initial, Noise, Observation, System};
    let one = Matrix::<Rational>::identity(1);
    let walk = |diffuse: i64| {
        let mut initial = Initial::new(Before::Observation, Matrix::zeros(1, 1), one.clone());
        initial.diffuse = Some(Matrix::from_integers(&[[diffuse]]));
        let noise = Noise::Covariances { process: one.clone().into(), cross: None, observation: one.clone().into() };
        let (transition, observation) = (one.clone().into(), one.clone().into());
        let (timing, input, observation_input) = (Timing::Departing, None, None);
        let system = System { timing, initial, transition, observation, noise, input, observation_input };
        systems::doubles(&system.realised(&[Observation::complete([ratio(3, 1)])]).expect("a valid system"))
    };
    for form in Form::ALL {
        assert_eq!(filter(form, &walk(1)), Err(FloatError::Diffuse));
        let values = filter(form, &walk(0)).expect("no diffuse part");
        let mean = values[0][&Quantity::FilteredMean][(0, 0)];
        assert!((mean - 1.5).abs() <= ROUNDINGS * f64::EPSILON, "{form}: {mean}");
    }
}

#[test]
fn names_are_unique_words() {
    for form in Form::ALL {
        assert!(form.name().chars().all(|letter| letter.is_ascii_lowercase() || letter == '-'));
        assert!(!form.description().is_empty() && !form.description().contains('\n'));
        assert_eq!(Form::ALL.iter().filter(|other| other.name() == form.name()).count(), 1);
    }
}
