//! The flow of the Nile at Aswan, 1871–1970: a random walk seen through noise (Durbin and Koopman 2012, chapter 2).
//!
//! Their variances are 15099 and 1469.1. Taken as decimals and as doubles, 1469.1 gives two different answers:
//! both were computed independently of this crate, to 24 digits.

use exact_kalman::filter::{Effort, filter, filter_rational};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, Path, System, Timing};
use exact_kalman::scalar::{Rational, Scalar, ratio};
use exact_kalman::trace::Quantity;

fn flows() -> Vec<Observation<Rational>> {
    let lines = include_str!("../../data/nile.csv").lines().skip(1);
    let flow = |line: &str| line.split(',').nth(1).and_then(|flow| flow.parse().ok()).map(|flow| ratio(flow, 1));
    lines.map(|line| Observation::new(vec![flow(line)])).collect()
}

fn path(level_variance: Rational) -> Path<Rational> {
    let one = Matrix::<Rational>::identity(1);
    let scalar = |value: Rational| Matrix::column(vec![value]);
    let system = System {
        timing: Timing::Departing,
        initial: Initial {
            diffuse: Some(one.clone()),
            ..Initial::new(Before::Observation, Matrix::zeros(1, 1), Matrix::zeros(1, 1))
        },
        transition: one.clone().into(),
        observation: one.into(),
        noise: Noise::Covariances {
            process: scalar(level_variance).into(),
            cross: None,
            observation: scalar(ratio(15099, 1)).into(),
        },
        input: None,
        observation_input: None,
    };
    system.realised(&flows()).unwrap_or_else(|error| panic!("the Nile is a valid model: {error}"))
}

/// The decimals of a positive number, cut off after 20 places.
fn decimals(value: &Rational) -> String {
    let scaled = value.times(&ratio(10, 1).pow(20)).floor().to_integer().to_string();
    let (whole, part) = scaled.split_at(scaled.len() - 20);
    format!("{whole}.{part}")
}

fn last(path: &Path<Rational>) -> [String; 2] {
    let trace = filter(path).unwrap_or_else(|error| panic!("{error}"));
    let fast = filter_rational(path, Effort::default()).unwrap_or_else(|error| panic!("{error}"));
    let record = &trace.records[99];
    assert_eq!(fast[99].exactly(Quantity::FilteredMean).as_ref(), Some(&record.filtered.mean));
    assert_eq!(fast[99].exactly(Quantity::FilteredCovariance).as_ref(), Some(&record.filtered.covariance));
    [decimals(&record.filtered.mean[(0, 0)]), decimals(&record.filtered.covariance[(0, 0)])]
}

#[test]
fn decimal_variance() {
    assert_eq!(last(&path(ratio(14691, 10))), ["798.37029260836421990910", "4032.15794180847627059876"]);
}

#[test]
fn double_variance() {
    // 1469.1 as a double, by its bits: 0x4096f46666666666 = 0x16f46666666666 · 2⁻⁴².
    let double = ratio(0x0016_f466_6666_6666, 1 << 42);
    assert_eq!(double, Rational::from_float(1469.1_f64).unwrap_or_default());
    assert_eq!(last(&path(double)), ["798.37029260836422212280", "4032.15794180847616502029"]);
}
