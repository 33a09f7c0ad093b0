//! CKS-K with a singular S: which generalised inverse the gain is made with, and what contradictions are shown.
//!
//! Any G with S G S = S gives the right mean, covariance and likelihood on data that the model can produce. Only the
//! gain and the direction of a contradiction tell them apart, so they are checked here, by their equations alone.

use exact_kalman::filter::filter;
use exact_kalman::gaussian::ConditionError;
use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Field, Scalar, ratio};
use proptest::test_runner::{Config, TestCaseError, TestRunner};

use super::draws::draws;
use super::systems::{Draw, Kind, Q};

const KIND: Kind = Kind { states: 3, sensors: 3, steps: 3, adapted: true, gaps: true };

fn runner(cases: u32) -> TestRunner {
    TestRunner::new(Config { cases, failure_persistence: None, ..Config::default() })
}

/// CKS-K: `K S = cov(x, y)` and K vanishes on the kernel of S: of all solutions the one with the pseudo-inverse.
#[test]
fn gain_is_that_of_the_pseudo_inverse() -> Result<(), Box<dyn std::error::Error>> {
    let singular = std::cell::Cell::new(0);
    runner(600).run(&draws(KIND), |draw| {
        let path = draw.system().realised(&draw.data()).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let trace = filter(&path).map_err(|error| TestCaseError::fail(error.to_string()))?;
        for record in &trace.records {
            let (k, s) = (&record.gain, &record.innovation_covariance);
            if k * s != record.cross_covariance {
                return Err(TestCaseError::fail(format!("K S is not cov(x, y): {record:?}")));
            }
            let kernel = s.kernel();
            if !(s * &kernel).is_zero() || !(k * &kernel).is_zero() {
                return Err(TestCaseError::fail(format!("K does not vanish on the kernel of S: {record:?}")));
            }
            // A kernel on which even cov(x, y) S⁻ could not but vanish says nothing: count those where it could.
            let telling = kernel.columns() > 0 && !record.cross_covariance.is_zero();
            singular.set(singular.get() + u32::from(telling));
        }
        Ok(())
    })?;
    assert!(singular.get() >= 200, "only {} gains with a singular S", singular.get());
    Ok(())
}

/// A contradiction comes with a direction v for anyone to recompute: `S v = 0` and `vᵀν ≠ 0`.
#[test]
fn contradictions_have_variance_zero() -> Result<(), Box<dyn std::error::Error>> {
    let found = std::cell::Cell::new(0);
    runner(600).run(&draws(Kind { gaps: false, ..KIND }), |draw| {
        let checked = contradicted(&draw).map_err(TestCaseError::fail)?;
        found.set(found.get() + u32::from(checked));
        Ok(())
    })?;
    assert!(found.get() >= 100, "only {} contradictions", found.get());
    Ok(())
}

/// Moves the last sensor's first reading; whether that contradicts the model.
fn contradicted(draw: &Draw) -> Result<bool, String> {
    let mut readings = draw.simulated(&draw.initial_source, &draw.sources).1;
    let last = readings[0].rows() - 1;
    readings[0][(last, 0)] = readings[0][(last, 0)].plus(&ratio(1, 7));
    let data = draw.observations(&readings);
    let path = draw.system().realised(&data).map_err(|error| error.to_string())?;
    let Err(error) = filter(&path) else { return Ok(false) };
    let ConditionError::Inconsistent(proof) = error.source else { return Err(format!("{error:?}")) };
    if error.step > 0 {
        return Ok(false);
    }
    let (mean, covariance) = first_reading(draw);
    let innovation = &readings[0] - mean;
    let value = proof.direction.transpose() * &innovation;
    if !(&covariance * &proof.direction).is_zero() || value[(0, 0)].is_zero() || value[(0, 0)] != proof.value {
        return Err(format!("{proof:?} proves nothing of S = {covariance}, ν = {innovation}"));
    }
    Ok(true)
}

/// The law of y_0. It is affine in the independent sources of the draw, so its slopes are read off at unit vectors.
fn first_reading(draw: &Draw) -> (Q, Q) {
    let (rank, q) = (draw.initial_source.rows(), draw.d_columns());
    let reading = |unit: Option<usize>| {
        let source =
            |from: usize, length: usize| Matrix::from_fn(length, 1, |i, _| ratio(i64::from(unit == Some(from + i)), 1));
        draw.simulated(&source(0, rank), &[source(rank, q)]).1.remove(0)
    };
    let mean = reading(None);
    let slopes: Vec<Q> = (0..rank + q).map(|unit| reading(Some(unit)) - &mean).collect();
    let covariance =
        slopes.iter().fold(Matrix::zeros(mean.rows(), mean.rows()), |sum, slope| sum + slope * slope.transpose());
    (mean, covariance)
}
