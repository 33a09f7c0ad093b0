//! HV-C5: what the coefficients of a d-step predictor may depend on, and what goes wrong one step further.
//!
//! A path is realised before it is filtered, so every route that works on it would agree about a rule that knows too much.
//! Here the conditional moments are checked by expectations over the sources alone: x̂ and P are right exactly if
//! E[(x − x̂) g] = 0 and E[((x − x̂)² − P) g] = 0 for the functions g of the known readings. Everything is a polynomial
//! in Gaussian sources, and so each expectation an exact finite sum.

use std::sync::{Arc, Mutex};

use exact_kalman::filter::{one_shot_ahead, predict_ahead};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Input, Noise, Observation, Past, PathAhead, System, Timing};
use exact_kalman::scalar::{Rational, Undefined, ratio};
use proptest::prelude::*;

use super::ahead::steps;
use super::quadrature::expected;
use super::systems::Q;

fn scalar(value: Rational) -> Q {
    Matrix::column(vec![value])
}

fn number(value: i64) -> Q {
    scalar(ratio(value, 1))
}

/// A scalar coefficient `base + slope · last`, where `last` is the last known reading, if there is one.
#[derive(Clone, Copy, Debug)]
struct Follows {
    base: i64,
    slope: i64,
}

impl Follows {
    fn value(self, last: Option<&Rational>) -> Rational {
        last.map_or_else(|| ratio(self.base, 1), |y| ratio(self.base, 1) + ratio(self.slope, 1) * y)
    }

    fn coefficient(self) -> Coefficient<Rational> {
        Coefficient::adapted(move |past: Past<'_, Rational>| Ok(scalar(self.value(past.last_entry(0)))))
    }
}

/// A scalar system whose transition follows the readings: x ← A x + b + D w, y = c x + f w, x_0 ~ N(0, 1).
#[derive(Clone, Copy, Debug)]
struct Model {
    timing: Timing,
    a: Follows,
    b: Follows,
    d: Follows,
    c: i64,
    f: i64,
}

impl Model {
    fn system(self) -> System<Rational> {
        System {
            timing: self.timing,
            initial: Initial::new(Before::Observation, number(0), number(1)),
            transition: self.a.coefficient(),
            observation: number(self.c).into(),
            noise: Noise::Factors { process: self.d.coefficient(), observation: number(self.f).into() },
            input: Some(Input { matrix: None, vector: self.b.coefficient() }),
            observation_input: None,
        }
    }

    /// The states x_0, …, and the readings of all but the last, where the transition into x_s follows y_{s−d}; z holds
    /// x_0 and one w per index.
    fn simulated(self, d: usize, states: usize, z: &[Rational]) -> (Vec<Rational>, Vec<Rational>) {
        let (mut x, mut y): (Vec<Rational>, Vec<Rational>) = (vec![z[0].clone()], Vec::new());
        for s in 1..states {
            y.push(ratio(self.c, 1) * &x[s - 1] + ratio(self.f, 1) * &z[s]);
            let last = s.checked_sub(d).map(|known| y[known].clone());
            // The noise of index s − 1 departs with x_{s−1}, that of index s arrives with x_s.
            let w = if self.timing == Timing::Departing { &z[s] } else { &z[s + 1] };
            let [a, b, d] = [self.a, self.b, self.d].map(|coefficient| coefficient.value(last.as_ref()));
            x.push(a * &x[s - 1] + b + d * w);
        }
        (x, y)
    }

    fn realised(self, readings: &[Rational], d: usize) -> PathAhead<Rational> {
        let data: Vec<_> = readings.iter().map(|y| Observation::complete([y.clone()])).collect();
        self.system().realised_ahead(&data, steps(d)).expect("a valid system")
    }
}

/// Products of powers of the known readings, up to this degree.
fn functions(readings: &[Rational], degree: i32) -> Vec<Rational> {
    readings.iter().fold(vec![ratio(1, 1)], |products, y| {
        products.iter().flat_map(|p| (0..=degree).map(move |power| p * y.pow(power))).collect()
    })
}

/// Whether the law of x_state that `law` makes of the first `known` readings has the right conditional mean and variance,
/// tested on the functions up to `degree`.
fn is_right(
    model: Model,
    (d, state, known, degree): (usize, usize, usize, i32),
    law: impl Fn(&[Rational]) -> (Rational, Rational),
) -> bool {
    // The state is of degree 1 in the initial state and the noise, and of 1 more for each reading that moves it.
    let sources = if model.timing == Timing::Departing { state + 1 } else { state + 2 };
    let defects = expected(sources, 4, |z| {
        let (x, y) = model.simulated(d, state + 1, z);
        let (mean, variance) = law(&y[..known]);
        let error = &x[state] - mean;
        let square = &error * &error - variance;
        functions(&y[..known], degree).into_iter().flat_map(|g| [&error * &g, &square * &g]).collect()
    });
    defects.iter().all(|defect| *defect == ratio(0, 1))
}

/// The predictor's law of x_state given the first `known` readings.
fn predicted(model: Model, d: usize, state: usize, readings: &[Rational]) -> (Rational, Rational) {
    let trace = predict_ahead(&model.realised(readings, d)).expect("regular innovations");
    let law = &trace.steps[readings.len() - 1].ahead[state - readings.len()];
    (law.mean[(0, 0)].clone(), law.covariance[(0, 0)].clone())
}

fn follows() -> impl Strategy<Value = Follows> {
    (-2i64..=2, -2i64..=2).prop_map(|(base, slope)| Follows { base, slope })
}

fn models(timing: Timing) -> impl Strategy<Value = Model> {
    (follows(), follows(), follows(), -2i64..=2, 1i64..=2).prop_map(move |(a, b, d, c, f)| Model {
        timing,
        a,
        b,
        d,
        c,
        f,
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, failure_persistence: None, ..ProptestConfig::default() })]

    /// HV-C5, HV-T1, HV-C2, HV-E.x: d = 1, and A, B u, D of the transition into x_1 follow y_0, one reading later than printed.
    #[test]
    fn one_step_ahead_a_transition_may_follow_the_reading_it_departs_from(model in models(Timing::Departing)) {
        prop_assert!(is_right(model, (1, 1, 1, 3), |y| predicted(model, 1, 1, y)));
    }

    /// HV-C5, HV-T1, HV-C2: d = 2, x_2 given y_0, where the transition into x_2 follows y_0.
    #[test]
    fn two_steps_ahead_a_transition_may_follow_the_reading_before(model in models(Timing::Departing)) {
        prop_assert!(is_right(model, (2, 2, 1, 3), |y| predicted(model, 2, 2, y)));
    }

    /// HV-C5 in the other timing: x_1 and x_2 given y_0, where the transition into x_s follows y_{s−d}.
    #[test]
    fn arriving_transitions_may_follow_as_much(model in models(Timing::Arriving)) {
        prop_assert!(is_right(model, (1, 1, 1, 3), |y| predicted(model, 1, 1, y)));
        prop_assert!(is_right(model, (2, 2, 1, 3), |y| predicted(model, 2, 2, y)));
    }
}

/// HV-C5, HV-T1: d = 2 beyond the first step: x_3 given y_0 and y_1, where the transition into x_2 follows y_0 and that into
/// x_3 follows y_1.
#[test]
fn two_steps_ahead_of_the_second_reading() {
    let (a, b) = (Follows { base: 1, slope: -1 }, Follows { base: 0, slope: 2 });
    let model = Model { timing: Timing::Departing, a, b, d: Follows { base: 1, slope: 1 }, c: 1, f: 1 };
    assert!(is_right(model, (2, 3, 2, 1), |y| predicted(model, 2, 3, y)));
}

/// HV-C5: A(k) = y(k), D(k) = 1 + y(k), d = 1: the expectation over the sources, the joint law conditioned once, and the
/// predictor are one.
///
/// HV-S.k, HV-E.x: so the entries of the stacked matrix need be known only at the time of the reading that they follow.
#[test]
fn growth_may_depend_on_the_last_reading() {
    let zero = Follows { base: 0, slope: 0 };
    let model = Model {
        timing: Timing::Departing,
        a: Follows { base: 0, slope: 1 },
        b: zero,
        d: Follows { base: 1, slope: 1 },
        c: 1,
        f: 1,
    };
    assert!(is_right(model, (1, 1, 1, 4), |y| predicted(model, 1, 1, y)));
    for y in [-3, 0, 2] {
        let y = ratio(y, 1);
        let law = &one_shot_ahead(&model.realised(std::slice::from_ref(&y), 1)).expect("a model with noise")[1][0];
        let (mean, variance) = predicted(model, 1, 1, std::slice::from_ref(&y));
        assert_eq!((law.mean(), law.covariance()), (&scalar(mean.clone()), &scalar(variance.clone())));
        // By hand: x_0 and w_0 have mean y/2 and covariance [[1, −1], [−1, 1]]/2 given their sum y.
        let half = ratio(1, 2);
        assert_eq!(mean, &y * &y * &half + (ratio(1, 1) + &y) * &y * &half);
        assert_eq!(variance, &half * (&y - (ratio(1, 1) + &y)) * (&y - (ratio(1, 1) + &y)));
    }
}

/// HV-C5 one step further fails: with d = 2 and A(1) = y(1), E(x(2) | Y(0)) = E x(1)² = 1, and (6) would give y(1)·0. With
/// our indices that is x_1 = y_0 x_0 before any reading. A step later, x_2 = y_1 x_1 given y_0: E x_2 = x̂² + P, and (6)
/// would give y_1 x̂.
#[test]
fn one_step_further_the_predictor_would_be_wrong() {
    let zero = Follows { base: 0, slope: 0 };
    let d = Follows { base: 0, slope: 0 };
    let model = Model { timing: Timing::Departing, a: Follows { base: 0, slope: 1 }, b: zero, d, c: 1, f: 1 };
    // The paper's example, with the reading known too early (as one step ahead it may be): no reading at all is given.
    let mean = expected(2, 4, |z| vec![model.simulated(1, 2, z).0[1].clone()]);
    assert_eq!(mean, [ratio(1, 1)]);
    let printed = expected(2, 4, |z| vec![&model.simulated(1, 2, z).1[0] * ratio(0, 1)]);
    assert_eq!(printed, [ratio(0, 1)]);
    // A step later: x̂ and P are the moments of x_1 given y_0, of which A_1 = y_1 knows nothing.
    let one_ahead = |y: &[Rational]| predicted(model, 1, 1, &y[..1]);
    let right = |y: &[Rational]| {
        let (mean, variance) = one_ahead(y);
        // x_2 = (x_1 + w_1) x_1: mean x̂² + P; variance E(x²(x + w)²) less its square, by the moments of N(x̂, P).
        let (m, v) = (&mean * &mean, &variance);
        let fourth = &m * &m + ratio(6, 1) * &m * v + ratio(3, 1) * v * v;
        let first = &m + v;
        (first.clone(), fourth + &first - &first * &first)
    };
    assert!(is_right(model, (1, 2, 1, 1), right));
    // (6) with A_1 = y_1 has a value only if y_1 is known; whatever number stands for it, the mean is not x̂² + P.
    for y_1 in [-2, 0, 3] {
        let formula = |y: &[Rational]| (ratio(y_1, 1) * one_ahead(y).0, right(y).1);
        assert!(!is_right(model, (1, 2, 1, 1), formula));
    }
    // And the types do not let it: two steps ahead the rule is not shown y_1, but y_0.
    let shown = Arc::new(Mutex::new(Vec::new()));
    let log = Arc::clone(&shown);
    let mut system = model.system();
    system.transition = Coefficient::adapted(move |past: Past<'_, Rational>| {
        log.lock().map_err(|_| Undefined::Undecided)?.push((past.len(), past.entry(1, 0).cloned()));
        Ok(number(1))
    });
    let data = [5, 7].map(|y| Observation::complete([ratio(y, 1)]));
    system.realised_ahead(&data, steps(2)).expect("shapes that fit");
    // Into x_1, x_2 and x_3.
    assert_eq!(*shown.lock().expect("no other test holds it"), [(0, None), (1, None), (2, Some(ratio(7, 1)))]);
}

/// HV-C5, HV-C5-start, HV-C2: what the rules of a d-step predictor are shown, counted: the transition into x_s the first s + 1 − d
/// readings, C, G v and F with index k the first k.
#[test]
fn rules_are_shown_what_a_predictor_may_know() {
    for timing in [Timing::Departing, Timing::Arriving] {
        for d in 1..=4 {
            let logs: [Arc<Mutex<Vec<usize>>>; 6] = Default::default();
            let [a, b, q, c, g, f] = logs.clone().map(|log| {
                Coefficient::adapted(move |past: Past<'_, Rational>| {
                    log.lock().map_err(|_| Undefined::Undecided)?.push(past.len());
                    Ok(number(1))
                })
            });
            let system = System {
                timing,
                initial: Initial::new(Before::Observation, number(0), number(1)),
                transition: a,
                observation: c,
                noise: Noise::Factors { process: q, observation: f },
                input: Some(Input { matrix: None, vector: b }),
                observation_input: Some(Input { matrix: None, vector: g }),
            };
            let data = [1, 2, 3].map(|y| Observation::complete([ratio(y, 1)]));
            let path = system.realised_ahead(&data, steps(d)).expect("shapes that fit");
            // The last reading is y_2, so x_{2+d} is the last state.
            assert!(path.transition_into(2 + d).is_some() && path.transition_into(3 + d).is_none());
            let distinct = |log: &Arc<Mutex<Vec<usize>>>| {
                let mut lengths = log.lock().expect("no other test holds it").clone();
                lengths.dedup();
                lengths
            };
            let mut transitions: Vec<usize> = (1..=2 + d).map(|s| (s + 1).saturating_sub(d)).collect();
            transitions.dedup();
            for log in &logs[..3] {
                assert_eq!(distinct(log), transitions, "{timing:?}, d = {d}");
            }
            for log in &logs[3..] {
                assert_eq!(distinct(log), [0, 1, 2], "{timing:?}, d = {d}");
            }
        }
    }
}

/// A rule that answers differently when it is asked again does not make a covariance that is none: FFᵀ and DFᵀ are of one F.
#[test]
fn both_products_of_a_factor_are_of_one_answer() {
    let one = Q::identity(1);
    for timing in [Timing::Arriving, Timing::Departing] {
        let asked = Arc::new(Mutex::new(0));
        let counted = Coefficient::adapted(move |_: Past<'_, Rational>| {
            let mut asked = asked.lock().expect("no other test holds it");
            *asked += 1;
            Ok(Q::column(vec![ratio(*asked, 1)]))
        });
        let system = System {
            timing,
            initial: Initial::new(Before::Observation, Q::zeros(1, 1), one.clone()),
            transition: one.clone().into(),
            observation: one.clone().into(),
            noise: Noise::Factors { process: one.clone().into(), observation: counted },
            input: None,
            observation_input: None,
        };
        let data = [1, 2, 3].map(|y| Observation::complete([ratio(y, 1)]));
        let path = system.realised(&data).expect("shapes that fit");
        let transitions = path.steps().iter().filter_map(|step| Some((step, step.transition.as_ref()?)));
        // With D = 1 and one source, (DFᵀ)² = FFᵀ.
        let squares: Vec<_> = transitions
            .map(|(step, t)| (&t.cross_noise * t.cross_noise.transpose(), step.observation_noise.clone()))
            .collect();
        assert!(squares.len() >= 2 && squares.iter().all(|(cross, own)| cross == own), "{timing:?}");
    }
}
