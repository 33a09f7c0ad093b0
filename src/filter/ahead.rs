//! Prediction d steps ahead.

use super::FilterError;
use super::recursion::{Recursion, propagated};
use crate::gaussian::ConditionError;
use crate::model::PathAhead;
use crate::scalar::Scalar;
use crate::trace::{Moments, Record};

/// One step of the predictor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StepAhead<S> {
    /// What the filter says of x_k.
    pub record: Record<S>,
    /// The laws of x_{k+1}, …, x_{k+d} given y_0, …, y_k, as far as there are transitions. While a diffuse start is not
    /// resolved they have a diffuse part, and no finite covariance.
    pub ahead: Vec<Moments<S>>,
}

/// The predictions after each observation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TraceAhead<S> {
    /// The laws of x_0, …, x_{d−1} before any observation.
    pub start: Vec<Moments<S>>,
    /// One entry per observation.
    pub steps: Vec<StepAhead<S>>,
}

/// The conditional laws of the next d states given the observations so far, at every step.
///
/// HV-T1: `x(k+d) given Y(k) is Gaussian with mean x̂(k+d|k) and covariance P(k+d|k) as (3)–(7) compute them`
///
/// HV-M.x: `x̂(k+d|k) = E(x(k+d) | Y(k))`
///
/// HV-M.P: `P(k+d|k) = E[(x(k+d) − x̂(k+d|k))(x(k+d) − x̂(k+d|k))ᵀ | Y(k)]`
///
/// HV-6: `x̂(k+d|k) = A(k+d−1)x̂(k+d−1|k) + B(k+d−1)u(k+d−1)`
///
/// HV-7: `P(k+d|k) = A(k+d−1)P(k+d−1|k)Aᵀ(k+d−1) + D(k+d−1)Dᵀ(k+d−1)`
///
/// The first step is that of the filter, HV-3 to HV-5 in departing timing: y_k has seen the noise of the transition that
/// departs from k. No reading has seen that of a later one. In arriving timing HV-6 and HV-7 start from x_k given
/// y_0, …, y_k.
///
/// # Errors
///
/// [`FilterError`] with the step, for the reasons of [`filter`](super::filter); what was predicted before it is kept.
///
/// # Examples
///
/// A random walk seen through noise; after the reading 1 it is expected at 1/2, with a variance that grows by one a step:
///
/// ```
/// use std::num::NonZero;
/// use exact_kalman::filter::predict_ahead;
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
/// use exact_kalman::scalar::{ratio, Rational};
///
/// let one = Matrix::<Rational>::identity(1);
/// let walk = System {
///     timing: Timing::Departing,
///     initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), one.clone()),
///     transition: one.clone().into(),
///     observation: one.clone().into(),
///     noise: Noise::Covariances { process: one.clone().into(), cross: None, observation: one.into() },
///     input: None,
///     observation_input: None,
/// };
/// let path = walk.realised_ahead(&[Observation::complete([ratio(1, 1)])], NonZero::new(3).ok_or("zero")?)?;
/// let ahead = &predict_ahead(&path)?.steps[0].ahead;
/// let variances: Vec<_> = ahead.iter().map(|law| law.covariance[(0, 0)].clone()).collect();
/// assert_eq!(variances, [ratio(3, 2), ratio(5, 2), ratio(7, 2)]);
/// assert!(ahead.iter().all(|law| law.mean[(0, 0)] == ratio(1, 2)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn predict_ahead<S: Scalar>(path: &PathAhead<S>) -> Result<TraceAhead<S>, FilterError<S, TraceAhead<S>>> {
    let mut predictions = Predictions::new(path);
    let mut computed = TraceAhead { start: laws(&predictions.filter, 0, path), steps: Vec::new() };
    for step in &mut predictions {
        match step {
            Ok(step) => computed.steps.push(step),
            Err(source) => return Err(FilterError { step: computed.steps.len(), source, computed }),
        }
    }
    Ok(computed)
}

/// The predictor, one observation at a time: nothing but the state is kept.
///
/// It ends with the path, or with the reason why it cannot go on.
#[derive(Debug)]
pub struct Predictions<'a, S> {
    path: &'a PathAhead<S>,
    filter: Recursion<S>,
    done: usize,
}

impl<'a, S: Scalar> Predictions<'a, S> {
    /// The predictor before the first observation.
    pub fn new(path: &'a PathAhead<S>) -> Self {
        Self { path, filter: Recursion::new(path.path()), done: 0 }
    }
}

impl<S: Scalar> Iterator for Predictions<'_, S> {
    type Item = Result<StepAhead<S>, ConditionError<S>>;

    fn next(&mut self) -> Option<Self::Item> {
        let step = self.path.path().steps().get(self.done)?;
        self.done += 1;
        if let Err(reason) = self.filter.advance(step) {
            return Some(Err(reason));
        }
        let ahead = laws(&self.filter, self.done, self.path);
        // After it has stopped there is no state, and no record.
        self.filter.records.pop().map(|record| Ok(StepAhead { record, ahead }))
    }
}

/// The laws of x_next, x_{next+1}, …, given what the filter has seen.
fn laws<S: Scalar>(filter: &Recursion<S>, next: usize, path: &PathAhead<S>) -> Vec<Moments<S>> {
    let mut laws: Vec<_> = filter.next(path.transition_into(next)).into_iter().collect();
    while laws.len() < path.steps_ahead().get()
        && let (Some(last), Some(transition)) = (laws.last(), path.transition_into(next + laws.len()))
    {
        laws.push(propagated(last, transition));
    }
    laws
}
