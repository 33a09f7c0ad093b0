//! HV-2: predictions from later readings, averaged over those readings, are the predictions from the earlier ones.

use exact_kalman::filter::{StepAhead, predict_ahead};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Observation, PathAhead};
use exact_kalman::scalar::{Rational, Scalar};
use exact_kalman::trace::Moments;
use proptest::prelude::*;

use super::ahead::{KIND, realised};
use super::draws::draws;
use super::systems::{Draw, Kind, Q};

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    /// HV-2: the law of the future readings integrated out. `one_shot` conditions x_{k+d} on all readings up to
    /// k + d − 1; averaged over those that follow y_k it must be what `predict_ahead` says at k. One reading more at a
    /// time, each with its law from the record: E and cov of an affine function of it.
    #[test]
    fn tower(draw in draws(Kind { adapted: false, steps: 3, ..KIND }), d in 2usize..=3) {
        let draw = Draw { lag: d, ..draw };
        let fail = |error: &dyn std::fmt::Display| TestCaseError::fail(error.to_string());
        let path = realised(&draw).map_err(|error| fail(&error))?;
        let trace = predict_ahead(&path).map_err(|error| fail(&error))?;
        for (step, next) in trace.steps.iter().zip(trace.steps.iter().skip(1)) {
            // x_{k+2} given y_0, …, y_{k+1} is affine in y_{k+1}: the mean of the innovation is 0, its covariance S.
            for (far, near) in step.ahead.iter().skip(1).zip(&next.ahead) {
                let gain = slope(&draw, &path, &trace.steps, next, near)?;
                let mean = &near.mean - &gain * &next.record.innovation;
                prop_assert_eq!(&far.mean, &mean);
                let covariance = &near.covariance + gain.congruence(&next.record.innovation_covariance);
                prop_assert_eq!(&far.covariance, &covariance);
            }
        }
    }
}

/// The slope of a prediction in the reading y_{k+1}, found by moving that reading along what it may be: the prediction
/// is affine, so differences are exact. On the null space of S nothing may move, and the slope is taken as zero there.
fn slope(
    draw: &Draw,
    path: &PathAhead<Rational>,
    steps: &[StepAhead<Rational>],
    next: &StepAhead<Rational>,
    law: &Moments<Rational>,
) -> Result<Q, TestCaseError> {
    let k = steps.iter().position(|step| std::ptr::eq(step, next)).expect("one of them");
    let i = next.ahead.iter().position(|other| std::ptr::eq(other, law)).expect("one of them");
    let covariance = &next.record.innovation_covariance;
    let observed = &next.record.observed;
    let mut moved = Matrix::zeros(law.mean.rows(), observed.len());
    for j in 0..observed.len() {
        // Along the column j of S, which the reading may move by.
        let mut data: Vec<Observation<Rational>> =
            path.path().steps().iter().map(|step| step.reading.clone()).collect();
        let mut entries = data[k].entries().to_vec();
        for (row, &sensor) in observed.iter().enumerate() {
            entries[sensor] = entries[sensor].take().map(|y| y.plus(&covariance[(row, j)]));
        }
        data[k] = Observation::new(entries);
        data.truncate(k + 1);
        let error = |error: String| TestCaseError::fail(error);
        let path = draw.system().realised_ahead(&data, path.steps_ahead()).map_err(|e| error(e.to_string()))?;
        let trace = predict_ahead(&path).map_err(|e| error(e.to_string()))?;
        let difference = &trace.steps[k].ahead[i].mean - &law.mean;
        for row in 0..difference.rows() {
            moved[(row, j)] = difference[(row, 0)].clone();
        }
    }
    // The slope times S is known; S⁺ takes S away on its range.
    Ok(moved * covariance.pseudo_inverse().map_err(|error| TestCaseError::fail(error.to_string()))?)
}
