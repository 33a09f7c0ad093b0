//! Each form by attainable digits, on random systems: regular and singular, both timings, noise shared, entries missing, units of all
//! sizes.

use exact_kalman::float::{FloatError, Form, Inverted, filter};
use exact_kalman::judge::{Judgement, Reference, Truth, Verdict};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Input, Noise, Observation, Path, System, Timing};
use exact_kalman::protocol::{Answer, Expect, Number, Reply};
use exact_kalman::scalar::{Rational, exact_value, nearest_double, ratio};
use exact_kalman::trace::{Quantity, Values};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

/// Those that go on where an innovation covariance is singular.
const SINGULAR: [Form; 5] = [Form::PseudoInverse, Form::Sequential, Form::SquareRoot, Form::Ud, Form::Svd];

/// What a system is to be like.
#[derive(Clone, Copy, Debug)]
struct Shape {
    timing: Timing,
    states: usize,
    sensors: usize,
    /// Sensors that repeat combinations of others, noise included.
    redundant: usize,
    steps: usize,
}

/// A system with its readings.
#[derive(Clone)]
struct Problem {
    timing: Timing,
    mean: Matrix<Rational>,
    covariance: Matrix<Rational>,
    a: Vec<Matrix<Rational>>,
    c: Vec<Matrix<Rational>>,
    d: Vec<Matrix<Rational>>,
    f: Vec<Matrix<Rational>>,
    u: Vec<Matrix<Rational>>,
    readings: Vec<Observation<Rational>>,
}

impl Problem {
    fn path(self) -> Path<Rational> {
        let system = System {
            timing: self.timing,
            initial: Initial::new(Before::Observation, self.mean, self.covariance),
            transition: Coefficient::per_step(self.a),
            observation: Coefficient::per_step(self.c),
            noise: Noise::Factors {
                process: Coefficient::per_step(self.d),
                observation: Coefficient::per_step(self.f),
            },
            input: Some(Input { matrix: None, vector: Coefficient::per_step(self.u) }),
            observation_input: None,
        };
        system.realised(&self.readings).expect("a valid system")
    }

    /// The same in other units: state i times two to the power of `states(i)`, sensor i likewise.
    fn in_units(mut self, states: impl Fn(usize) -> i32, sensors: impl Fn(usize) -> i32) -> Self {
        let unit = |exponent: i32| ratio(2, 1).pow(exponent);
        let (n, m) = (self.mean.rows(), self.c.first().map_or(0, Matrix::rows));
        let diagonal = |count: usize, exponent: &dyn Fn(usize) -> i32| {
            Matrix::diagonal(&(0..count).map(|i| unit(exponent(i))).collect::<Vec<_>>())
        };
        let (t, back, s) = (diagonal(n, &states), diagonal(n, &|i| -states(i)), diagonal(m, &sensors));
        self.mean = &t * &self.mean;
        self.covariance = t.congruence(&self.covariance);
        self.a.iter_mut().for_each(|a| *a = &(&t * &*a) * &back);
        self.c.iter_mut().for_each(|c| *c = &(&s * &*c) * &back);
        self.d.iter_mut().chain(&mut self.u).for_each(|d| *d = &t * &*d);
        self.f.iter_mut().for_each(|f| *f = &s * &*f);
        let entry = |(i, y): (usize, &Option<Rational>)| y.as_ref().map(|y| y * unit(sensors(i)));
        self.readings
            .iter_mut()
            .for_each(|reading| *reading = Observation::new(reading.entries().iter().enumerate().map(entry).collect()));
        self
    }
}

/// A stream of small integers.
struct Draws(u64);

impl Draws {
    fn next(&mut self, bound: i64) -> i64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        i64::try_from((self.0 >> 33) % u64::try_from(2 * bound + 1).expect("a small bound")).expect("a small number")
            - bound
    }

    fn matrix(&mut self, rows: usize, columns: usize, bound: i64, denominator: i64) -> Matrix<Rational> {
        Matrix::from_fn(rows, columns, |_, _| ratio(self.next(bound), denominator))
    }
}

/// A system with noise shared by state and sensors and inputs that act, along data that it produced itself, so that no reading
/// contradicts it where sensors repeat each other; a quarter of the entries is missing. Every number is a short dyadic fraction.
fn problem(shape: Shape, seed: u64) -> Problem {
    let Shape { timing, states: n, sensors, redundant, steps } = shape;
    let m = sensors + redundant;
    let mut draws = Draws(seed);
    // Q and R share two sources; each state and each sensor that repeats no other has one of its own, too.
    let sources = 2 + n + sensors;
    let root = draws.matrix(n, n, 2, 2);
    let covariance = &root * root.transpose() + Matrix::identity(n);
    let mean = draws.matrix(n, 1, 8, 2);
    let mut state = &mean + &root * draws.matrix(n, 1, 2, 1);
    let (mut a, mut c, mut d, mut f, mut u, mut readings) = (vec![], vec![], vec![], vec![], vec![], vec![]);
    for k in 0..steps {
        let transition = Matrix::from_fn(n, n, |i, j| ratio(draws.next(1) + 2 * i64::from(i == j), 4));
        let own = |shared: Matrix<Rational>, before: usize, count: usize, after: usize| {
            let rows = shared.rows();
            shared
                .beside(&Matrix::zeros(rows, before))
                .beside(&Matrix::identity(count))
                .beside(&Matrix::zeros(rows, after))
        };
        let process = own(draws.matrix(n, 2, 2, 2), 0, n, sensors);
        let repeat = Matrix::identity(sensors).above(&draws.matrix(redundant, sensors, 2, 1));
        let observation = &repeat * draws.matrix(sensors, n, 4, 4);
        let noise = &repeat * own(draws.matrix(sensors, 2, 2, 2), n, sensors, 0);
        let input = draws.matrix(n, 1, 4, 2);
        let w = draws.matrix(sources, 1, 2, 1);
        let moved = |state: &Matrix<Rational>| &transition * state + &input + &process * &w;
        if timing == Timing::Arriving && k > 0 {
            state = moved(&state);
        }
        let reading = &observation * &state + &noise * &w;
        if timing == Timing::Departing {
            state = moved(&state);
        }
        let entry = |y: &Rational, draws: &mut Draws| (draws.next(3) != 3).then(|| y.clone());
        readings.push(Observation::new(reading.entries().iter().map(|y| entry(y, &mut draws)).collect()));
        assert_eq!(readings[k].dimension(), m);
        a.push(transition);
        c.push(observation);
        d.push(process);
        f.push(noise);
        u.push(input);
    }
    Problem { timing, mean, covariance, a, c, d, f, u, readings }
}

fn doubles(path: &Path<Rational>) -> Path<f64> {
    let double = |value: &Rational| {
        let double = nearest_double(value);
        if exact_value(double).as_ref() == Some(value) { Ok(double) } else { Err(format!("{value} is no double")) }
    };
    path.try_map(double).expect("every number is a double")
}

fn judged(truth: &Truth, values: &[Values<f64>]) -> Judgement {
    let number = |value: &f64| Number::Finite(exact_value(*value).expect("filters return finite numbers only"));
    let numbers = |values: &Values<f64>| values.iter().map(|(name, matrix)| (*name, matrix.map(number))).collect();
    let answer = Answer::answered("random", values.iter().map(numbers).collect());
    Judgement::of(Expect::Estimate, truth, &Reply::Answer(answer))
}

fn truth(path: &Path<Rational>) -> Truth {
    Truth::Known(Box::new(Reference::of(path).expect("a short path")))
}

/// Random systems of this shape, all with the same seeds.
fn each(
    shapes: impl Strategy<Value = Shape>,
    cases: u32,
    check: impl Fn(&Path<Rational>) -> Result<(), TestCaseError>,
) {
    each_problem(shapes, cases, |problem| check(&problem.path()));
}

fn each_problem(
    shapes: impl Strategy<Value = Shape>,
    cases: u32,
    check: impl Fn(Problem) -> Result<(), TestCaseError>,
) {
    let config = ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() };
    let result = TestRunner::new_with_rng(
        config,
        proptest::test_runner::TestRng::deterministic_rng(proptest::test_runner::RngAlgorithm::ChaCha),
    )
    .run(&(shapes, any::<u64>()), |(shape, seed)| check(problem(shape, seed)));
    if let Err(error) = result {
        panic!("{error}");
    }
}

fn shapes(redundant: std::ops::RangeInclusive<usize>) -> impl Strategy<Value = Shape> {
    let timing = prop_oneof![Just(Timing::Departing), Just(Timing::Arriving)];
    (timing, 1usize..=8, 1usize..=3, redundant, 1usize..=5)
        .prop_map(|(timing, states, sensors, redundant, steps)| Shape { timing, states, sensors, redundant, steps })
}

#[test]
fn every_form_is_within_two_digits_of_what_is_attainable_on_regular_systems() {
    each(shapes(0..=0), 48, |path| {
        let truth = truth(path);
        for form in Form::ALL {
            let values = filter(form, &doubles(path)).expect("a regular system");
            let judgement = judged(&truth, &values);
            prop_assert_eq!(judgement.verdict, Verdict::Agrees, "{}: {:?}", form, judgement);
        }
        Ok(())
    });
}

/// What each form that decides on ranks makes of a system, where that is not within two digits.
fn failures(path: &Path<Rational>) -> Vec<String> {
    let truth = truth(path);
    let failure = |form: Form| match filter(form, &doubles(path)) {
        Err(error) => Some(format!("{form}: {error}")),
        Ok(values) => {
            let judgement = judged(&truth, &values);
            (judgement.verdict != Verdict::Agrees).then(|| format!("{form}: {:?}", judgement.scores))
        }
    };
    SINGULAR.into_iter().filter_map(failure).collect()
}

#[test]
fn forms_that_decide_on_ranks_are_within_two_digits_on_singular_systems() {
    each(shapes(1..=2), 48, |path| {
        let failures = failures(path);
        prop_assert!(failures.is_empty(), "{}", failures.join("\n"));
        Ok(())
    });
}

/// Five sensors of rank three, noise shared: the joint covariance of the noises has rank seven of nine, and its factor has entries that
/// ought to be zero and are what a difference left.
#[test]
fn forms_that_decide_on_ranks_see_what_the_factor_of_the_noise_was_computed_from() {
    let shape = Shape { timing: Timing::Departing, states: 4, sensors: 3, redundant: 2, steps: 5 };
    let failures = failures(&problem(shape, 4_154_859_111_121_260_400).path());
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// R is singular wherever sensors that repeat each other are read together, and nowhere else.
#[test]
fn the_information_form_answers_or_says_what_has_no_inverse() {
    let stopped = std::cell::Cell::new(0);
    each(shapes(1..=2), 48, |path| {
        let truth = truth(path);
        let (values, singular) = match filter(Form::Information, &doubles(path)) {
            Ok(values) => (values, None),
            Err(FloatError::NoInverse { what: Inverted::Noise, step, computed }) => (computed, Some(step)),
            Err(other) => return Err(TestCaseError::fail(other.to_string())),
        };
        let regular = |step: usize| {
            let step = &path.steps()[step];
            let present = step.reading.present();
            step.observation_noise.select(&present, &present).ldl().is_ok_and(|ldl| ldl.is_positive_definite())
        };
        prop_assert!((0..values.len()).all(regular));
        if let Some(step) = singular {
            prop_assert!(!regular(step));
            stopped.set(stopped.get() + 1);
        } else {
            prop_assert_eq!(judged(&truth, &values).verdict, Verdict::Agrees);
        }
        Ok(())
    });
    assert!(stopped.get() >= 20, "{}", stopped.get());
}

/// Multiplying by powers of two rounds nothing, and no decision depends on a unit: the same bits come out.
#[test]
fn in_units_of_any_size_the_same_bits_come_out() {
    for exponent in [-300, 300] {
        each_problem(shapes(0..=1), 24, |problem| {
            let path = problem.clone().path();
            let other = problem.in_units(|_| exponent, |_| exponent).path();
            for form in Form::ALL {
                let [one, other] = [&path, &other].map(|path| filter(form, &doubles(path)));
                let [one, other] =
                    [&one, &other].map(|found| found.as_ref().map_or_else(FloatError::computed, Vec::as_slice));
                prop_assert_eq!(one.len(), other.len(), "{}", form);
                for (one, other) in one.iter().zip(other) {
                    prop_assert!(one.keys().eq(other.keys()), "{}", form);
                    for (name, matrix) in one {
                        let power =
                            if *name == Quantity::Gain { 0 } else { exponent * (1 + i32::from(name.is_covariance())) };
                        prop_assert_eq!(
                            &matrix.map(|entry| entry * 2.0_f64.powi(power)),
                            &other[name],
                            "{}: {}",
                            form,
                            name
                        );
                    }
                }
            }
            Ok(())
        });
    }
}

/// Each state and each sensor in a unit of its own, up to 2¹⁰⁰ apart: nothing that is lost is lost by a decision on ranks.
///
/// The pseudo-inverse form is left out: its threshold is relative to the largest sensor, and takes the others for zero. So is the
/// SVD form where states differ: its directions are orthogonal in one unit for all, and it promises what it does there in the suite.
#[test]
fn in_units_of_their_own_states_and_sensors_keep_their_digits() {
    each_problem(shapes(0..=1), 24, |problem| {
        let state = |i: usize| 50 - 14 * i32::try_from(i).expect("few states");
        let sensor = |i: usize| 25 * i32::try_from(i).expect("few sensors") - 50;
        let path = problem.in_units(state, sensor).path();
        let truth = truth(&path);
        for form in SINGULAR.into_iter().filter(|form| *form != Form::PseudoInverse) {
            let values = filter(form, &doubles(&path)).expect("no form of these stops at a singular matrix");
            let judgement = judged(&truth, &values);
            prop_assert_eq!(judgement.verdict, Verdict::Agrees, "{}: {:?}", form, judgement);
        }
        Ok(())
    });
}
