//! The standard predictor: the ordinary one on the linear system, exact in law.

use super::BioreactorError;
use crate::filter::filter;
use crate::float::{self, Form};
use crate::matrix::Matrix;
use crate::model::{Path, Transition};
use crate::scalar::Rational;
use crate::trace::{Moments, Quantity};

/// For k = 0, 1, …: the exact law of x_k given y_0, …, y_{k−d}, d = `ahead`; for k < d before any reading.
///
/// HV-SKP: `x̂_SKP(k) = E(x(k) | y(0), …, y(k−1)) = x̂(k|k−1)`
///
/// HV-SKP2: `x̂_SKP2(k) = E(x(k) | y(0), …, y(k−2)) = x̂(k|k−2)`
///
/// The one-step predictor, and then HV-6 and HV-7 from there. A path does not tell when its
/// transitions were known: the caller answers for a delay of at least d − 1. The type that does is
/// [`PathAhead`](crate::model::PathAhead), by [`System::realised_ahead`](crate::model::System::realised_ahead); on it
/// [`predict_ahead`](crate::filter::predict_ahead) gives the same laws.
///
/// # Errors
///
/// [`BioreactorError::Exact`] where the filter stops: readings that a singular law excludes.
pub fn standard_predictions_exact(
    path: &Path<Rational>,
    ahead: usize,
) -> Result<Vec<Moments<Rational>>, BioreactorError> {
    let trace = filter(path)?;
    let one_ahead: Vec<_> = trace.records.into_iter().map(|record| record.predicted).collect();
    let next = |law: Moments<Rational>, transition: &Transition<Rational>| Moments {
        mean: &transition.matrix * law.mean + &transition.input,
        covariance: transition.matrix.congruence(&law.covariance) + &transition.noise,
        diffuse: None,
    };
    Ok(further_ahead(path, &one_ahead, ahead, next))
}

/// The means of the same laws in doubles, with the form of Joseph.
///
/// # Errors
///
/// [`BioreactorError::Standard`] where the filter stops.
pub fn standard_predictions(path: &Path<f64>, ahead: usize) -> Result<Vec<Matrix<f64>>, BioreactorError> {
    let mut values = float::filter(Form::Joseph, path)?;
    let one_ahead: Vec<_> = values.iter_mut().filter_map(|values| values.remove(&Quantity::PredictedMean)).collect();
    let next = |mean: Matrix<f64>, transition: &Transition<f64>| {
        let (a, b) = (&transition.matrix, &transition.input);
        Matrix::from_fn(2, 1, |i, _| a[(i, 0)] * mean[(0, 0)] + a[(i, 1)] * mean[(1, 0)] + b[(i, 0)])
    };
    Ok(further_ahead(path, &one_ahead, ahead, next))
}

/// From what is known of x_k given y_0, …, y_{k−1}, what is known given y_0, …, y_{k−d}.
fn further_ahead<T, L: Clone>(
    path: &Path<T>,
    one_ahead: &[L],
    ahead: usize,
    next: impl Fn(L, &Transition<T>) -> L,
) -> Vec<L> {
    let prediction = |k: usize| {
        let first = (k + 1).saturating_sub(ahead);
        let transitions =
            path.steps().get(first..k).unwrap_or_default().iter().filter_map(|step| step.transition.as_ref());
        Some(transitions.fold(one_ahead.get(first)?.clone(), &next))
    };
    (0..one_ahead.len()).filter_map(prediction).collect()
}
