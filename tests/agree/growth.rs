//! HV-C5, its consequence for the bioreactor: a growth rate that follows the substrate itself, read without noise, fits d = 1,
//! and one that follows the substrate of the step before fits d = 2.
//!
//! The growth rate of Sokol and Howell with β = 0 is linear in the substrate, and so everything is a polynomial in the
//! sources once it is multiplied by the innovation variance, which is a divisor here.

use exact_kalman::filter::predict_ahead;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Noise, Observation, Past, System, Timing};
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::trace::Record;

use super::ahead::steps;
use super::quadrature::expected;
use super::systems::Q;

/// Biomass and substrate for the growth rate μ = y/3: what grows is taken from the substrate.
fn growth(substrate: Option<&Rational>) -> Q {
    let rate = substrate.map_or_else(|| ratio(0, 1), |y| y / ratio(3, 1));
    let mut matrix = Matrix::identity(2);
    matrix[(0, 0)] += &rate;
    matrix[(1, 0)] -= &rate;
    matrix
}

fn initial_factor() -> Q {
    Matrix::from_integers(&[[1, 1], [0, 1]])
}

fn noise() -> Q {
    Matrix::from_integers(&[[2], [1]])
}

fn reactor() -> System<Rational> {
    let covariance = initial_factor() * initial_factor().transpose();
    System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, Matrix::from_integers(&[[2], [1]]), covariance),
        transition: Coefficient::adapted(|past: Past<'_, Rational>| Ok(growth(past.last_entry(0)))),
        observation: Matrix::from_integers(&[[0, 1]]).into(),
        noise: Noise::Factors { process: noise().into(), observation: Matrix::zeros(1, 1).into() },
        input: None,
        observation_input: None,
    }
}

/// The biomass x_2, without the noise that comes last, and the substrates y_0, y_1: the growth rate follows the substrate
/// `lag` steps before.
fn simulated(lag: usize, z: &[Rational]) -> (Rational, [Rational; 2]) {
    let start = Matrix::from_integers(&[[2], [1]]) + initial_factor() * Matrix::column(z[..2].to_vec());
    let first = start[(1, 0)].clone();
    let known = |k: usize, substrates: &[Rational]| k.checked_sub(lag).map(|k| substrates[k].clone());
    let next = growth(known(0, std::slice::from_ref(&first)).as_ref()) * start + noise().scaled(&z[2]);
    let substrates = [first, next[(1, 0)].clone()];
    let last = growth(known(1, &substrates).as_ref()) * next;
    (last[(0, 0)].clone(), substrates)
}

/// The records, and the law of the biomass x_2 given the first `known` readings.
fn predicted(d: usize, known: usize, readings: &[Rational]) -> (Vec<Record<Rational>>, Rational, Rational) {
    let data: Vec<_> = readings[..known].iter().map(|y| Observation::complete([y.clone()])).collect();
    let path = reactor().realised_ahead(&data, steps(d)).expect("shapes that fit");
    let trace = predict_ahead(&path).expect("noise on every sensor");
    let law = &trace.steps[known - 1].ahead[2 - known];
    let (mean, variance) = (law.mean[(0, 0)].clone(), law.covariance[(0, 0)].clone());
    (trace.steps.into_iter().map(|step| step.record).collect(), mean, variance)
}

/// HV-C5, HV-T1: with μ(k) a function of x_S(k), read at k, the error of the predictor of x_2 from y_0 and y_1 has mean 0 and the
/// variance P on every function of them that is tried.
#[test]
fn growth_that_follows_the_substrate_fits_one_step_ahead() {
    let own = (noise() * noise().transpose())[(0, 0)].clone();
    let defects = expected(3, 6, |z| {
        let (biomass, readings) = simulated(0, z);
        let (records, mean, variance) = predicted(1, 2, &readings);
        let divisor = &records[1].innovation_covariance[(0, 0)];
        // The divisor makes polynomials of both; the last noise is independent of all this and adds its variance.
        let error = (biomass - mean) * divisor;
        let square = &error * &error - (variance - &own) * divisor * divisor;
        let [first, second] = &readings;
        vec![error.clone(), &error * first, &error * second, &error * first * second, square]
    });
    assert!(defects.iter().all(|defect| *defect == ratio(0, 1)), "{defects:?}");
}

/// HV-C5, HV-T1: with μ(k) a function of x_S(k−1), as printed for one step ahead, x_2 is predicted two steps ahead from y_0. With
/// μ(k) a function of x_S(k) it is not.
#[test]
fn growth_that_follows_the_substrate_before_fits_two_steps_ahead() {
    let own = (noise() * noise().transpose())[(0, 0)].clone();
    let defects = |lag: usize| {
        expected(3, 6, |z| {
            let (biomass, readings) = simulated(lag, z);
            let (_, mean, variance) = predicted(2, 1, &readings);
            let error = biomass - mean;
            let square = &error * &error - (variance - &own);
            vec![error.clone(), &error * &readings[0], square.clone(), square * &readings[0]]
        })
    };
    assert!(defects(1).iter().all(|defect| *defect == ratio(0, 1)));
    assert!(defects(0).iter().any(|defect| *defect != ratio(0, 1)));
}
