//! Prediction d steps ahead, in every form.

use super::error::{FloatError, Obstacle};
use super::moments::{self, finite, finite_column};
use super::recursion::{Recursion, walk};
use super::transition::Transition;
use crate::model::{PathAhead, Timing};
use crate::trace::Moments;

/// A predictor: for each reading the laws of the next states.
pub(super) type Predict = fn(&PathAhead<f64>) -> Result<Vec<Vec<Moments<f64>>>, FloatError>;

/// The predictions of the form `R`.
///
/// # Errors
///
/// [`FloatError`] with the step, and what the filter computed before it.
pub(super) fn run<R: Recursion>(path: &PathAhead<f64>) -> Result<Vec<Vec<Moments<f64>>>, FloatError> {
    let mut predictions = Vec::with_capacity(path.path().steps().len());
    walk::<R>(path.path(), |k, belief| {
        predictions.push(laws::<R>(belief, k + 1, path)?);
        Ok(())
    })?;
    Ok(predictions)
}

/// The laws of x_next, x_{next+1}, …, from the belief with which the filter goes on.
fn laws<R: Recursion>(belief: &R::Belief, next: usize, path: &PathAhead<f64>) -> Result<Vec<Moments<f64>>, Obstacle> {
    let mut laws = Vec::new();
    let mut moved: Option<R::Belief> = None;
    while laws.len() < path.steps_ahead().get()
        && let Some(transition) = path.transition_into(next + laws.len())
    {
        // In departing timing the filter has made the first step already: the reading shares its noise.
        if !laws.is_empty() || path.path().timing() == Timing::Arriving {
            moved = Some(R::predicted(moved.as_ref().unwrap_or(belief), &Transition::of(transition))?);
        }
        let moments::Moments { mean, covariance } = R::moments(moved.as_ref().unwrap_or(belief))?;
        laws.push(Moments { mean: finite_column(&mean)?, covariance: finite(&covariance)?, diffuse: None });
    }
    Ok(laws)
}
