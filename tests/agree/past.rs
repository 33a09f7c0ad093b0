//! CKS-A3: what an adapted coefficient is shown. Filters agree with each other about a wrong model too, so the model
//! is compared with the rule here.

use std::sync::{Arc, Mutex};

use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Input, Noise, Observation, Past, System, Timing};
use exact_kalman::scalar::{Rational, ratio};

const STEPS: usize = 4;

/// The lengths of the pasts that the rule of one field was shown, in the order of the calls.
type Shown = Arc<Mutex<Vec<usize>>>;

/// A 1×1 coefficient that notes what it is shown and is worth 1 plus the sum of it, so that no two pasts look alike.
fn spy() -> (Coefficient<Rational>, Shown) {
    let shown = Shown::default();
    let log = Arc::clone(&shown);
    let rule = move |past: Past<'_, Rational>| {
        log.lock().map_err(|_| exact_kalman::scalar::Undefined::Undecided)?.push(past.len());
        let sum = (0..past.len()).filter_map(|k| past.entry(k, 0)).fold(ratio(1, 1), |sum, y| sum + y);
        assert_eq!((past.entry(past.len(), 0), past.is_empty()), (None, past.last().is_none()));
        Ok(Matrix::column(vec![sum]))
    };
    (Coefficient::adapted(rule), shown)
}

/// The past of length l shows the readings 2⁰, …, 2^(l−1): one and their sum is 2^l.
fn value(length: usize) -> Matrix<Rational> {
    Matrix::column(vec![ratio(1 << length, 1)])
}

fn realised(timing: Timing, before: Before) {
    let [(a, of_a), (b, of_b), (c, of_c), (d, of_d), (g, of_g), (f, of_f)] = [(); 6].map(|()| spy());
    let one = Matrix::<Rational>::identity(1);
    let system = System {
        timing,
        initial: Initial::new(before, Matrix::zeros(1, 1), one),
        transition: a,
        observation: c,
        noise: Noise::Factors { process: d, observation: f },
        input: Some(Input { matrix: None, vector: b }),
        observation_input: Some(Input { matrix: None, vector: g }),
    };
    let data: Vec<_> = (0..STEPS).map(|k| Observation::complete([ratio(1 << k, 1)])).collect();
    let path = system.realised(&data).unwrap_or_else(|error| panic!("{error}"));
    // Index k of an observation is shown y_0, …, y_{k−1}; a transition that departs from k is shown y_k as well.
    let seen = |k: usize| k + usize::from(timing == Timing::Departing);
    let mut transitions = 0;
    for (k, step) in path.steps().iter().enumerate() {
        assert_eq!((&step.observation, &step.observation_input), (&value(k), &value(k)), "C and Gv at {k}");
        assert_eq!(step.observation_noise, &value(k) * value(k), "FFᵀ at {k}");
        if let Some(transition) = &step.transition {
            let expected = value(seen(k));
            assert_eq!((&transition.matrix, &transition.input), (&expected, &expected), "A and Bu at {k}");
            assert_eq!(transition.noise, &expected * &expected, "DDᵀ at {k}");
            assert_eq!(transition.cross_noise, &expected * value(k), "DFᵀ at {k}");
            transitions += 1;
        }
    }
    let first = usize::from(timing == Timing::Arriving && before == Before::Observation);
    assert_eq!(transitions, STEPS - first);
    let distinct = |shown: &Shown| {
        let mut lengths = shown.lock().map(|shown| shown.clone()).unwrap_or_default();
        lengths.sort_unstable();
        lengths.dedup();
        lengths
    };
    for shown in [of_c, of_g, of_f] {
        assert_eq!(distinct(&shown), (0..STEPS).collect::<Vec<_>>());
    }
    for shown in [of_a, of_b, of_d] {
        assert_eq!(distinct(&shown), (first..STEPS).map(seen).collect::<Vec<_>>());
    }
}

#[test]
fn rules_of_departing_transitions_see_the_reading_they_depart_from() {
    realised(Timing::Departing, Before::Observation);
}

#[test]
fn rules_of_arriving_transitions_see_the_readings_before() {
    realised(Timing::Arriving, Before::Observation);
    realised(Timing::Arriving, Before::Transition);
}
