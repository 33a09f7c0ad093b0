//! P = E[(x − x̂)(x − x̂)ᵀ], checked by an expectation and nothing else.
//!
//! Independent fair signs have the mean and covariance of N(0, I). With coefficients that do not follow the data
//! the error x − x̂ is linear in the sources, so its second moments under the signs are those under the Gaussian
//! law: a finite sum over all sign vectors, exactly.

use exact_kalman::filter::filter;
use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, Scalar, ratio};
use exact_kalman::trace::Moments;
use proptest::prelude::*;

use super::draws::draws;
use super::systems::{Draw, Kind, Q};

const KIND: Kind = Kind { states: 2, sensors: 2, steps: 3, adapted: false, gaps: true };

/// All vectors of the given length with entries ±1.
fn signs(length: usize) -> impl Iterator<Item = Vec<Rational>> {
    (0..1u32 << length).map(move |bits| (0..length).map(|i| ratio(1 - 2 * i64::from(bits >> i & 1), 1)).collect())
}

/// The covariances with which the errors of prediction and filtering really vary, per step.
fn expected(draw: &Draw) -> Result<Vec<[Q; 2]>, String> {
    let (n, rank, q) = (draw.mean.rows(), draw.initial_factor.columns(), draw.d_columns());
    let steps = draw.sources.len();
    let count = rank + q * steps;
    let mut sums = vec![[Matrix::zeros(n, n), Matrix::zeros(n, n)]; steps];
    for sign in signs(count) {
        let column = |from: usize, length: usize| Matrix::column(sign[from..from + length].to_vec());
        let sources: Vec<Q> = (0..steps).map(|k| column(rank + q * k, q)).collect();
        let (states, readings) = draw.simulated(&column(0, rank), &sources);
        let path = draw.system().realised(&draw.observations(&readings)).map_err(|error| error.to_string())?;
        let trace = filter(&path).map_err(|error| error.to_string())?;
        for ((sum, record), state) in sums.iter_mut().zip(&trace.records).zip(&states) {
            for (sum, Moments { mean, .. }) in sum.iter_mut().zip([&record.predicted, &record.filtered]) {
                let error = state - mean;
                *sum = &*sum + &error * error.transpose();
            }
        }
    }
    let share = Rational::one().over(&ratio(1 << count, 1)).map_err(|error| error.to_string())?;
    Ok(sums.into_iter().map(|sum| sum.map(|matrix| matrix.scaled(&share))).collect())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    /// CKS-T, CKS-L1, CKS-L1.covariance: `P = E[(X − X̂)(X − X̂)ᵀ | Y]`
    #[test]
    fn covariance_eq_expected_squared_error(draw in draws(KIND)) {
        prop_assume!(draw.initial_factor.columns() + draw.d_columns() * draw.sources.len() <= 9);
        let expected = expected(&draw).map_err(TestCaseError::fail)?;
        let path = draw.system().realised(&draw.data()).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let trace = filter(&path).map_err(|error| TestCaseError::fail(error.to_string()))?;
        for (record, [predicted, filtered]) in trace.records.iter().zip(&expected) {
            prop_assert_eq!(&record.predicted.covariance, predicted);
            prop_assert_eq!(&record.filtered.covariance, filtered);
        }
    }
}
