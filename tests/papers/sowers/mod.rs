//! Sowers, Makowski 1988: the smallest examples, and what the paper prints beside what is right.

mod change;
mod characteristic;
mod decomposition;
mod errata;
mod estimates;
mod functionals;
mod girsanov;
mod horizon;
mod lemmas;
mod limit;
mod measure;
mod moments;
mod price;
#[cfg(feature = "judge")]
mod price_values;
mod start;
mod world;

use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, Path, System, Timing};
use exact_kalman::scalar::{Rational, ratio};

type Q = Matrix<Rational>;

fn number(value: Rational) -> Q {
    Matrix::column(vec![value])
}

/// The scalar system with these A, H, Σʷ, Σʷᵛ, Σᵛ along some readings.
fn scalar([a, h, w, wv, v]: [i64; 5], readings: &[i64]) -> Path<Rational> {
    let one = |value: i64| number(ratio(value, 1));
    let system = System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, one(0), one(0)),
        transition: one(a).into(),
        observation: one(h).into(),
        noise: Noise::Covariances { process: one(w).into(), cross: Some(one(wv).into()), observation: one(v).into() },
        input: None,
        observation_input: None,
    };
    let data: Vec<_> = readings.iter().map(|&y| Observation::complete([ratio(y, 1)])).collect();
    system.realised(&data).unwrap_or_else(|error| panic!("{error}"))
}
