//! Transitions beyond the last observation, and where prediction ends.

use exact_kalman::filter::{FilterError, one_shot, one_shot_ahead, predict_ahead};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Field, Initial, Input, ModelError, Noise, Observation, System, Timing};
use exact_kalman::scalar::{Rational, ratio};

use super::ahead::steps;
use super::systems::Q;

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
            let path = listed(timing, 2 + more).realised_ahead(&data, steps(3)).expect("a valid system");
            let trace = predict_ahead(&path).expect("regular innovations");
            let lengths = [&trace.start, &trace.steps[0].ahead, &trace.steps[1].ahead].map(Vec::len);
            assert_eq!(lengths, [3.min(number + 2), 3.min(number + 1), number], "{timing:?}");
            let laws = one_shot_ahead(&path).expect("regular innovations");
            assert_eq!(laws.iter().map(Vec::len).collect::<Vec<_>>(), lengths);
            let moments = trace.steps[1].ahead.iter().map(|law| (&law.mean, &law.covariance));
            assert!(moments.eq(laws[2].iter().map(|law| (law.mean(), law.covariance()))));
        }
        let beyond = if timing == Timing::Departing { 2 } else { 3 };
        assert!(listed(timing, 2 + beyond).realised_ahead(&data, steps(3)).is_ok());
        let error = listed(timing, 1).realised_ahead(&data, steps(3)).expect_err("too few");
        assert_eq!(error, ModelError::Length { field: Field::Transition, expected: 2, may_go_on: true, found: 1 });
        // What lies beyond the reach is not evaluated: a longer list changes nothing, even if its shape is wrong.
        let mut longer = listed(timing, 2 + beyond);
        let Coefficient::PerStep(values) = &mut longer.transition else { panic!("a list") };
        values.push(Some(Matrix::zeros(2, 3)));
        let reached = listed(timing, 2 + beyond).realised_ahead(&data, steps(3)).expect("a valid system");
        assert_eq!(longer.realised_ahead(&data, steps(3)).expect("a valid system"), reached);
        assert_eq!(
            longer.realised(&data).expect("a valid system"),
            *listed(timing, 2 + beyond).realised_ahead(&data, steps(1)).expect("a valid system").path()
        );
        let mut observed = listed(timing, 2);
        observed.observation = Coefficient::per_step([(); 3].map(|()| Matrix::identity(1)));
        let error = observed.realised_ahead(&data, steps(3)).expect_err("no reading");
        assert_eq!(error, ModelError::Length { field: Field::Observation, expected: 2, may_go_on: false, found: 3 });
    }
    // Without the transition that departs from the last reading those after it are of no use.
    let mut broken = listed(Timing::Departing, 4);
    let entry = || Some(Matrix::<Rational>::identity(1));
    broken.transition = Coefficient::PerStep(vec![entry(), None, entry(), entry()]);
    let path = broken.realised_ahead(&data, steps(3)).expect("a valid system");
    assert_eq!(
        (predict_ahead(&path).expect("noise on every sensor").steps[1].ahead.len(), path.beyond().len()),
        (0, 0)
    );
    assert_eq!(
        one_shot_ahead(&path).expect("noise on every sensor").iter().map(Vec::len).collect::<Vec<_>>(),
        [2, 1, 0]
    );
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
    let path = constant.realised_ahead(&data, steps(2)).expect("shapes that fit");
    let Err(FilterError { step, computed, .. }) = predict_ahead(&path) else { panic!("x is read as 0 and as 1") };
    assert_eq!((step, computed.start.len(), computed.steps.len()), (1, 2, 1));
    assert!(computed.steps[0].ahead.iter().all(|law| law.mean.is_zero() && law.covariance.is_zero()));
    assert!(matches!(one_shot_ahead(&path), Err(FilterError { step: 1, .. })));
    assert!(one_shot(path.path()).is_err());
}
