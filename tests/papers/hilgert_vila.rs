//! Hilgert, Vila 1999, sections 1 and 2 and the appendix: assumptions, Theorem 1 line by line, lemmas, errata.
//!
//! Names and indices of the tests are the paper's: states from 1, y(0) before them, transition k from x(k) to x(k+1). Ours
//! count observations from 0, so that list entry k − 1 holds A(k), B(k)u(k), D(k) and C(k−1), G(k−1)v(k−1), F(k−1).

mod appendix;
mod assumptions;
mod proof;
#[path = "../agree/quadrature.rs"]
mod quadrature;

use std::num::NonZero;

use exact_kalman::filter::{TraceAhead, predict_ahead};
use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Input, Noise, Observation, PathAhead, System, Timing};
use exact_kalman::scalar::{Rational, ratio};

type Q = Matrix<Rational>;

fn integers<const C: usize>(rows: &[[i64; C]]) -> Q {
    Matrix::from_integers(rows)
}

fn number(value: Rational) -> Q {
    Matrix::column(vec![value])
}

fn observations(readings: &[Q]) -> Vec<Observation<Rational>> {
    readings.iter().map(|y| Observation::complete(y.entries().to_vec())).collect()
}

/// HV (1) as printed with constant coefficients and without inputs: departing, x(1) given y(0) ~ N(0, p).
fn system(p: Q, a: Q, c: Q, d: Q, f: Q) -> System<Rational> {
    System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, Matrix::zeros(a.rows(), 1), p),
        transition: a.into(),
        observation: c.into(),
        noise: Noise::Factors { process: d.into(), observation: f.into() },
        input: None,
        observation_input: None,
    }
}

fn realised(system: &System<Rational>, readings: &[Q], d: usize) -> PathAhead<Rational> {
    let steps = NonZero::new(d).expect("at least one step");
    system.realised_ahead(&observations(readings), steps).unwrap_or_else(|error| panic!("a valid system: {error}"))
}

fn predicted(system: &System<Rational>, readings: &[Q], d: usize) -> TraceAhead<Rational> {
    predict_ahead(&realised(system, readings, d)).unwrap_or_else(|error| panic!("consistent data: {error}"))
}

/// A law whose covariance is symmetric.
fn law(mean: &Q, covariance: &Q) -> Gaussian<Rational> {
    Gaussian::new(mean.clone(), covariance.clone()).unwrap_or_else(|error| panic!("{error}"))
}

/// Everything of HV (1) with index k, by the paper's names.
struct At {
    a: Q,
    b_u: Q,
    d: Q,
    /// C(k−1)
    c: Q,
    /// G(k−1)v(k−1)
    g_v: Q,
    /// F(k−1)
    f: Q,
}

/// Two states, two sensors and three sources of noise that both equations share; nothing is constant.
fn at(k: i64) -> At {
    At {
        a: integers(&[[1, k], [-1, 2]]),
        b_u: integers(&[[k], [3 - k]]),
        d: integers(&[[1, 0, k], [0, 1, 1]]),
        c: integers(&[[1, 0], [k, 1]]),
        g_v: integers(&[[2], [-k]]),
        f: integers(&[[1, 1, 0], [0, 2, k]]),
    }
}

const MEAN: [[i64; 1]; 2] = [[1], [-2]];
const COVARIANCE: [[i64; 2]; 2] = [[2, 1], [1, 3]];

/// The system of [`at`] over `steps` readings, with lists that go on for predictions d steps ahead.
fn varying(steps: i64, d: i64) -> System<Rational> {
    let list = |entry: &dyn Fn(At) -> Q, last: i64| Coefficient::per_step((1..=last).map(|k| entry(at(k))));
    let input = |vector| Some(Input { matrix: None, vector });
    let beyond = steps + d - 1;
    System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, integers(&MEAN), integers(&COVARIANCE)),
        transition: list(&|at| at.a, beyond),
        observation: list(&|at| at.c, steps),
        noise: Noise::Factors { process: list(&|at| at.d, beyond), observation: list(&|at| at.f, steps) },
        input: input(list(&|at| at.b_u, beyond)),
        observation_input: input(list(&|at| at.g_v, steps)),
    }
}

/// A finite law: values with their probabilities, which sum to one.
fn expectation<V>(law: &[(Rational, V)], f: impl Fn(&V) -> Rational) -> Rational {
    assert_eq!(law.iter().fold(ratio(0, 1), |sum, (p, _)| sum + p), ratio(1, 1));
    law.iter().fold(ratio(0, 1), |sum, (p, value)| sum + p * f(value))
}
