//! The universal statistics against a filter that is started from each value of ξ, or from each component of its law.

use exact_kalman::filter::filter;
use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::Initial;
use exact_kalman::nongaussian::{Component, InitialLaw, Statistics, statistics};
use exact_kalman::scalar::{Rational, Scalar, ratio};
use exact_kalman::trace::Moments;
use proptest::prelude::*;

use super::draws::draws;
use super::systems::{Draw, Kind, Q};

const KIND: Kind = Kind { states: 3, sensors: 3, steps: 4, adapted: true, gaps: true };

/// A filter started from N(mean, covariance): the prediction of each next state, and so far Σ νᵀS⁻¹ν and Π det S.
struct Started {
    predicted: Vec<Moments<Rational>>,
    quadratics: Vec<Rational>,
    determinants: Vec<Rational>,
}

fn started(draw: &Draw, mean: &Q, covariance: &Q) -> Result<Started, String> {
    let mut system = draw.system();
    system.initial = Initial::new(system.initial.before, mean.clone(), covariance.clone());
    let path = system.realised(&draw.data()).map_err(|error| error.to_string())?;
    let trace = filter(&path).map_err(|error| error.to_string())?;
    let mut started = Started { predicted: Vec::new(), quadratics: Vec::new(), determinants: Vec::new() };
    let (mut quadratic, mut determinant) = (ratio(0, 1), ratio(1, 1));
    for record in &trace.records {
        let parts = record.likelihood.as_ref().ok_or("a regular innovation has a likelihood")?;
        quadratic = quadratic.plus(&parts.quadratic);
        determinant = determinant.times(&parts.pseudo_determinant);
        started.quadratics.push(quadratic.clone());
        started.determinants.push(determinant.clone());
    }
    started.predicted = trace.records.into_iter().skip(1).map(|record| record.predicted).chain(trace.ahead).collect();
    Ok(started)
}

fn all_statistics(draw: &Draw) -> Result<Vec<Statistics<Rational>>, String> {
    let path = draw.system().realised(&draw.data()).map_err(|error| error.to_string())?;
    statistics(&path).map_err(|error| error.to_string())
}

fn failed(message: String) -> TestCaseError {
    TestCaseError::fail(message)
}

/// A law of ξ with two components, one of them degenerate where the tape says so.
fn two_components(draw: &Draw) -> Result<InitialLaw<Rational>, String> {
    let n = draw.mean.rows();
    let law = |mean: Q, covariance: Q| Gaussian::new(mean, covariance).map_err(|error| error.to_string());
    let spread = &draw.initial_factor * draw.initial_factor.transpose();
    let slab = law(draw.mean.clone(), spread)?;
    let spike = law(Matrix::from_fn(n, 1, |i, _| ratio(i64::try_from(i).unwrap_or(0) - 1, 2)), Matrix::zeros(n, n))?;
    let components = [(ratio(1, 3), slab), (ratio(2, 3), spike)].map(|(weight, law)| Component { weight, law });
    InitialLaw::mixture(components).map_err(|error| error.to_string())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// SM-1.7, SM-2.1, SM-2.2, SM-2.3, SM-2.6, SM-4.1, SM-4.6: given ξ = z the state has the mean X̄ + Q*z and the covariance P.
    #[test]
    fn given_the_start_the_prediction_is_affine_in_it(draw in draws(KIND)) {
        let draw = draw.with_noisy_sensors();
        let n = draw.mean.rows();
        let all = all_statistics(&draw).map_err(failed)?;
        let units = (0..n).map(|i| Matrix::from_fn(n, 1, |row, _| ratio(i64::from(row == i), 1)));
        for z in units.chain([Matrix::zeros(n, 1), draw.mean.clone()]) {
            let started = started(&draw, &z, &Matrix::zeros(n, n)).map_err(failed)?;
            prop_assert_eq!(started.predicted.len(), all.len() - 1);
            for (now, predicted) in all[1..].iter().zip(&started.predicted) {
                prop_assert_eq!(&(&now.mean + now.response() * &z), &predicted.mean);
                prop_assert_eq!(&now.covariance, &predicted.covariance);
            }
        }
    }

    /// SM-2.4, SM-2.7, SM-3.20, SM-4.7, SM-4.8: log p(y | z) − log p(y | 0) = zᵀB̄ − ½ zᵀR*z.
    #[test]
    fn the_density_is_log_quadratic_in_the_start(draw in draws(KIND)) {
        let draw = draw.with_noisy_sensors();
        let n = draw.mean.rows();
        let all = all_statistics(&draw).map_err(failed)?;
        let origin = started(&draw, &Matrix::zeros(n, 1), &Matrix::zeros(n, n)).map_err(failed)?;
        for numbers in [[1, 0, 0], [0, 1, 0], [1, 1, -2], [3, -1, 5]] {
            let z = Matrix::from_fn(n, 1, |i, _| ratio(numbers[i], 2));
            let away = started(&draw, &z, &Matrix::zeros(n, n)).map_err(failed)?;
            for (t, now) in all[1..].iter().enumerate() {
                let gained = away.quadratics[t].minus(&origin.quadratics[t]);
                let linear = (z.transpose() * &now.linear)[(0, 0)].clone();
                let quadratic = z.transpose().congruence(&now.precision())[(0, 0)].clone();
                prop_assert_eq!(gained, quadratic.minus(&linear.plus(&linear)));
            }
        }
    }

    /// SM-A3, SM-LMMSE, SM-4.3: the best affine estimate and its error are those of a filter started from N(μ, Δ), for
    /// singular Δ too.
    #[test]
    fn the_best_affine_estimate_is_that_of_the_filter(draw in draws(KIND)) {
        let draw = draw.with_noisy_sensors();
        let law = two_components(&draw).map_err(failed)?;
        let filtered = started(&draw, &law.mean(), &law.covariance()).map_err(failed)?;
        for (now, predicted) in all_statistics(&draw).map_err(failed)?[1..].iter().zip(&filtered.predicted) {
            let linear = now.linear(&law);
            prop_assert_eq!((&linear.estimate, &linear.covariance), (&predicted.mean, &predicted.covariance));
        }
    }

    /// SM-T1, SM-2.9, SM-4.29: each component of the conditional law is what a filter started from it says, and its evidence
    /// is the likelihood of the readings in it, over that of ξ = 0.
    #[test]
    fn components_are_what_bayes_makes_of_them(draw in draws(KIND)) {
        let draw = draw.with_noisy_sensors();
        let n = draw.mean.rows();
        let law = two_components(&draw).map_err(failed)?;
        let origin = started(&draw, &Matrix::zeros(n, 1), &Matrix::zeros(n, n)).map_err(failed)?;
        let all = all_statistics(&draw).map_err(failed)?;
        for (place, component) in law.components().iter().enumerate() {
            let own = started(&draw, component.law.mean(), component.law.covariance()).map_err(failed)?;
            for (t, now) in all[1..].iter().enumerate() {
                let found = &now.posterior(&law).components[place];
                prop_assert_eq!(found.state.mean(), &own.predicted[t].mean);
                prop_assert_eq!(found.state.covariance(), &own.predicted[t].covariance);
                let twice = found.evidence.exponent.plus(&found.evidence.exponent);
                prop_assert_eq!(twice, origin.quadratics[t].minus(&own.quadratics[t]));
                let determinant = found.evidence.determinant.times(&origin.determinants[t]);
                prop_assert_eq!(&determinant, &own.determinants[t]);
                prop_assert_eq!(&found.evidence.weight, &component.weight);
            }
        }
    }

    /// Erratum SM-cone, SM-2.5, SM-4.7: Σ and R* are positive semidefinite, R* never decreases, and Σ(1) is singular, so that it
    /// never lies in the positive definite cone.
    #[test]
    fn covariances_are_semidefinite(draw in draws(KIND)) {
        let draw = draw.with_noisy_sensors();
        let all = all_statistics(&draw).map_err(failed)?;
        let n = draw.mean.rows();
        for (now, next) in all.iter().zip(all.iter().skip(1)) {
            prop_assert!(next.joint_covariance().ldl().is_ok());
            prop_assert!(now.precision().loewner_le(&next.precision()).is_ok());
        }
        prop_assert_eq!((&all[1].cross, &all[1].error), (&Matrix::zeros(n, n), &Matrix::zeros(n, n)));
        prop_assert!(all[1].joint_covariance().ldl().is_ok_and(|factors| !factors.is_positive_definite()));
    }
}
