//! Hilgert and Vila 1999, section 3: the stirred tank reactor, its two predictors, Table 1 and the figures.

mod extended;
mod figures;
mod identities;
mod standard;
mod start;
mod table;

use exact_kalman::matrix::Matrix;
use exact_kalman::reproduce::bioreactor::{Exponent, Setting};
use exact_kalman::scalar::{Rational, exact_value, ratio};

/// All exponents for which the growth law is rational and that the paper prints.
const NATURAL: [Exponent; 3] = [Exponent::Natural(2), Exponent::Natural(1), Exponent::Natural(0)];

/// Readings of the paper's reactor under noise in tenths, simulated in doubles and rounded to 64ths: fractions that stay
/// short. (An exact course does not: each step takes a power of an old substrate.)
fn readings(setting: &Setting<Rational>, steps: i32) -> Vec<Rational> {
    let tenth = |k: i32, factor: i32| f64::from((k * factor + 3) % 21 - 10) / 10.0;
    let noise: Vec<_> = (1..steps).map(|k| [tenth(k, 7), tenth(k, 13)]).collect();
    let states = setting.doubles().simulated(&noise).expect("a tank that does not run dry");
    let sixty_fourth = |substrate: f64| exact_value((substrate * 64.0).round() / 64.0).expect("finite");
    states.iter().map(|[_, substrate]| sixty_fourth(*substrate)).collect()
}

/// vᵀ P v
fn form(p: &Matrix<Rational>, v: &[i64]) -> Rational {
    let v = Matrix::column(v.iter().map(|&entry| ratio(entry, 1)).collect());
    v.transpose().congruence(p)[(0, 0)].clone()
}
