//! HV-M.P: the covariance of a prediction, by an expectation and nothing else; and its limit for a diffuse start.

use exact_kalman::filter::predict_ahead;
use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, Scalar, ratio};
use exact_kalman::trace::Moments;
use proptest::collection::vec;
use proptest::prelude::*;

use super::ahead::steps;
use super::draws::draws;
use super::systems::{Draw, Kind, Q};

/// All vectors of the given length with entries ±1: they have the mean and covariance of N(0, I).
fn signs(length: usize) -> impl Iterator<Item = Vec<Rational>> {
    (0..1u32 << length).map(move |bits| (0..length).map(|i| ratio(1 - 2 * i64::from(bits >> i & 1), 1)).collect())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    /// HV-M.P: `P(k+d|k) = E[(x(k+d) − x̂(k+d|k))(x(k+d) − x̂(k+d|k))ᵀ | Y(k)]`
    ///
    /// HV-M.x, HV-C3: the error is uncorrelated with every reading known, so no affine function of them predicts better. Of the
    /// noise its first two moments alone are used: it is a fair sign here.
    #[test]
    fn covariance_eq_expected_squared_error(draw in draws(Kind { states: 2, sensors: 2, steps: 3, adapted: false, gaps: true }), d in 1usize..=3) {
        let draw = Draw { lag: d, ..draw };
        let (rank, q, total) = (draw.initial_factor.columns(), draw.d_columns(), draw.sources.len());
        let count = rank + q * total;
        prop_assume!(total > 1 && count <= 9);
        let fail = |error: &dyn std::fmt::Display| TestCaseError::fail(error.to_string());
        // Predictions of x_1, …, x_{T−1}: those states are simulated.
        let pairs: Vec<(usize, usize)> =
            (0..total).flat_map(|k| (k + 1..total.min(k + d + 1)).map(move |state| (k, state))).collect();
        let n = draw.mean.rows();
        let mut squares = vec![Matrix::zeros(n, n); pairs.len()];
        let mut products: Vec<Vec<Q>> = Vec::new();
        let mut covariances = Vec::new();
        for sign in signs(count) {
            let column = |from: usize, length: usize| Matrix::column(sign[from..from + length].to_vec());
            let sources: Vec<Q> = (0..total).map(|k| column(rank + q * k, q)).collect();
            let (states, readings) = draw.simulated(&column(0, rank), &sources);
            let data = draw.observations(&readings);
            let path = draw.system().realised_ahead(&data, steps(d)).map_err(|error| fail(&error))?;
            let trace = predict_ahead(&path).map_err(|error| fail(&error))?;
            let laws: Vec<&Moments<Rational>> = pairs.iter().map(|&(k, s)| &trace.steps[k].ahead[s - k - 1]).collect();
            covariances = laws.iter().map(|law| law.covariance.clone()).collect();
            products.resize(pairs.len(), Vec::new());
            for ((law, &(k, state)), (square, products)) in
                laws.iter().zip(&pairs).zip(squares.iter_mut().zip(&mut products))
            {
                let error = &states[state] - &law.mean;
                *square = &*square + &error * error.transpose();
                products.resize(k + 1, Matrix::zeros(0, 0));
                for (product, reading) in products.iter_mut().zip(&data) {
                    let term = &error * reading.values().transpose();
                    *product = if product.shape() == term.shape() { &*product + term } else { term };
                }
            }
        }
        let share = ratio(1, 1 << count);
        for ((square, covariance), products) in squares.iter().zip(&covariances).zip(&products) {
            prop_assert_eq!(&square.scaled(&share), covariance);
            prop_assert!(products.iter().all(Matrix::is_zero));
        }
    }

    /// A diffuse start: the mean and both orders of the covariance are limits; what remains falls like 1/κ.
    #[test]
    fn diffuse_predictions_are_limits(
        draw in draws(Kind { states: 3, sensors: 2, steps: 3, adapted: true, gaps: true }),
        entries in vec(-2i64..=2, 3),
        d in 1usize..=3,
    ) {
        let draw = Draw { lag: d, ..draw };
        let direction = Matrix::from_fn(draw.mean.rows(), 1, |i, _| ratio(entries[i], 1));
        let part = &direction * direction.transpose();
        let draw = Draw { mean: &draw.mean + &direction, ..draw };
        let traced = |kappa: Option<&Rational>| {
            let mut system = draw.system();
            match kappa {
                Some(kappa) => system.initial.covariance = system.initial.covariance + part.scaled(kappa),
                None => system.initial.diffuse = Some(part.clone()),
            }
            let path = system.realised_ahead(&draw.data(), steps(d)).map_err(|e| TestCaseError::fail(e.to_string()))?;
            let trace = predict_ahead(&path).map_err(|e| TestCaseError::fail(e.to_string()))?;
            let laws = trace.start.into_iter().chain(trace.steps.into_iter().flat_map(|step| step.ahead));
            Ok::<Vec<_>, TestCaseError>(laws.collect())
        };
        let (small, large) = (ratio(10, 1).pow(12), ratio(10, 1).pow(15));
        let (limits, first, second) = (traced(None)?, traced(Some(&small))?, traced(Some(&large))?);
        let remainder = |finite: &Moments<Rational>, limit: &Moments<Rational>, kappa: &Rational| -> Vec<Rational> {
            let n = limit.mean.rows();
            let growing = limit.diffuse.clone().unwrap_or_else(|| Matrix::zeros(n, n)).scaled(kappa);
            let covariance = &finite.covariance - &limit.covariance - growing;
            let mean = &finite.mean - &limit.mean;
            mean.entries().iter().chain(covariance.entries()).cloned().collect()
        };
        for ((limit, first), second) in limits.iter().zip(&first).zip(&second) {
            for (first, second) in remainder(first, limit, &small).iter().zip(&remainder(second, limit, &large)) {
                // 1/1000 of it is left, up to the next order.
                let reduced = second.times(&ratio(900, 1));
                prop_assert!(reduced.times(&reduced) <= first.times(first), "{first} then {second}");
            }
        }
    }
}
