//! CKS-T for coefficients that follow the readings, without freezing them: x̂ and P are right iff E[(x − x̂) g] = 0 and
//! E[((x − x̂)² − P) g] = 0 for all functions g of the readings.
//!
//! x̂ is a quotient of polynomials whose denominator is the innovation covariance S, a function of the readings too; so
//! both are multiplied by S or its square, and each expectation over the sources is an exact finite sum.

use exact_kalman::filter::filter;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Noise, Observation, Past, System, Timing};
use exact_kalman::scalar::{Rational, ratio};

use super::quadrature::expected;
use super::systems::Q;

fn number(value: Rational) -> Q {
    Matrix::column(vec![value])
}

fn row(entries: &[Rational; 2]) -> Q {
    Matrix::column(entries.to_vec()).transpose()
}

/// x_0 ~ N(0, 1), y_0 = x_0 + v_0, x_1 = (1 + slope·y_0) x_0 + (y_0 − 1) w_1, y_1 = x_1 + w_1 + v_1: w_1 moves x_1 and y_1.
fn growth(slope: i64, y: &Rational) -> Rational {
    ratio(1, 1) + ratio(slope, 1) * y
}

fn disturbance(y: &Rational) -> Rational {
    y - ratio(1, 1)
}

/// The system with growth that follows y_0 as fast as `slope` says.
fn system(slope: i64) -> System<Rational> {
    let following = move |past: Past<'_, Rational>, of: fn(i64, &Rational) -> Q| {
        let zero = ratio(0, 1);
        Ok(of(slope, past.last_entry(0).unwrap_or(&zero)))
    };
    System {
        timing: Timing::Arriving,
        initial: Initial::new(Before::Observation, number(ratio(0, 1)), number(ratio(1, 1))),
        transition: Coefficient::adapted(move |past| following(past, |slope, y| number(growth(slope, y)))),
        observation: number(ratio(1, 1)).into(),
        noise: Noise::Factors {
            process: Coefficient::adapted(move |past| following(past, |_, y| row(&[disturbance(y), ratio(0, 1)]))),
            observation: Coefficient::per_step([row(&[ratio(0, 1), ratio(1, 1)]), row(&[ratio(1, 1), ratio(1, 1)])]),
        },
        input: None,
        observation_input: None,
    }
}

/// The defects of mean and variance of x_1 given y_0 and y_1, where the filter believes in `believed`.
fn defects(slope: i64, believed: i64) -> Vec<Rational> {
    let system = system(believed);
    // (x − x̂)S is of degree 4 in each source, its square of 8, and g of 3: eleven nodes are exact.
    expected(4, 5, |z| {
        let [x0, v0, w1, v1] = z else { panic!("four sources") };
        let y0 = x0 + v0;
        let x1 = growth(slope, &y0) * x0 + disturbance(&y0) * w1;
        let y1 = &x1 + w1 + v1;
        let data = [&y0, &y1].map(|y| Observation::complete([y.clone()]));
        let path = system.realised(&data).unwrap_or_else(|error| panic!("{error}"));
        let record = filter(&path).unwrap_or_else(|error| panic!("{error}")).records.remove(1);
        let s = &record.innovation_covariance[(0, 0)];
        let error = (&x1 - &record.filtered.mean[(0, 0)]) * s;
        let square = &error * &error - &record.filtered.covariance[(0, 0)] * s * s;
        let functions = [ratio(1, 1), y0.clone(), y1.clone(), &y0 * &y1];
        functions.iter().flat_map(|g| [&error * g, &square * g]).collect()
    })
}

/// CKS-T, CKS-A3, CKS-3, CKS-4: A and D follow the reading before, noise is shared; and a filter that believes in another
/// growth is found out.
#[test]
fn the_filter_is_right_where_coefficients_follow_the_readings() {
    assert!(defects(2, 2).iter().all(|defect| *defect == ratio(0, 1)));
    assert!(defects(2, 1).iter().any(|defect| *defect != ratio(0, 1)));
}
