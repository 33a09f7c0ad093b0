//! A system along data, realised for prediction.

use std::num::NonZero;

use super::realise::Realisation;
use super::{ModelError, Observation, Path, System, Timing, Transition};
use crate::scalar::OrderedField;

/// A path whose transitions are known d steps before they are over, and those beyond its last observation.
///
/// Made by [`System::realised_ahead`], which shows the rules of its transitions no more than a predictor may know.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PathAhead<T> {
    path: Path<T>,
    steps_ahead: NonZero<usize>,
    beyond: Vec<Transition<T>>,
}

impl<T> PathAhead<T> {
    /// The path up to the last observation. A filter may run on it as on any other.
    pub fn path(&self) -> &Path<T> {
        &self.path
    }

    /// d, the number of steps that are predicted.
    pub fn steps_ahead(&self) -> NonZero<usize> {
        self.steps_ahead
    }

    /// The transitions that follow those of the path, up to where the system has none: at most d − 1 (departing) or d
    /// (arriving). No reading shares their noise: `cross_noise` is zero.
    pub fn beyond(&self) -> &[Transition<T>] {
        &self.beyond
    }

    /// The transition from x_{k−1} into x_k, if there is one: that with index k (arriving) or k − 1 (departing).
    pub fn transition_into(&self, k: usize) -> Option<&Transition<T>> {
        let index = match self.path.timing() {
            Timing::Arriving => k,
            Timing::Departing => k.checked_sub(1)?,
        };
        match self.path.steps().get(index) {
            Some(step) => step.transition.as_ref(),
            None => self.beyond.get(index - self.path.steps().len()),
        }
    }

    /// The same over another scalar, or the first entry that has no image there.
    ///
    /// # Errors
    ///
    /// What `image` returns.
    pub fn try_map<U, E>(&self, mut image: impl FnMut(&T) -> Result<U, E>) -> Result<PathAhead<U>, E> {
        let path = self.path.try_map(&mut image)?;
        let beyond = self.beyond.iter().map(|transition| transition.try_map(&mut image)).collect::<Result<_, E>>()?;
        Ok(PathAhead { path, steps_ahead: self.steps_ahead, beyond })
    }
}

impl<S: OrderedField> System<S> {
    /// The system along the given observations, to be predicted d steps ahead of each.
    ///
    /// HV-C5: `A(k), B(k), u(k), C(k), D(k), F(k), G(k), v(k) are functions of y(0), …, y(k−d) for k ≥ d`
    ///
    /// A weaker condition suffices, and is kept by construction: the rule of an adapted coefficient of the transition
    /// into x_s is shown y_0, …, y_{s−d} (nothing for s < d), that of an observation coefficient with index k is shown
    /// y_0, …, y_{k−1}. A rule learns its k from [`Past::step`](super::Past::step). So are the inputs (HV-C2), and the first steps (HV-C5-start). For d = 1 these are the conditions of [`System::realised`].
    ///
    /// Lists of A, B, u, D or Q may go on beyond the last observation; where they end, prediction ends. Used are d − 1
    /// further entries in departing timing and d in arriving timing; what lies beyond these is not looked at. Values in
    /// lists are taken as known in time.
    ///
    /// # Errors
    ///
    /// Those of [`System::realised`], for the transitions beyond the last observation too.
    ///
    /// # Examples
    ///
    /// For two steps ahead, the transition from x_1 to x_2 must not know y_1:
    ///
    /// ```
    /// use std::num::NonZero;
    /// use exact_kalman::matrix::Matrix;
    /// use exact_kalman::model::{Before, Coefficient, Initial, Noise, Observation, System, Timing};
    /// use exact_kalman::scalar::{ratio, Rational};
    ///
    /// let one = Matrix::<Rational>::identity(1);
    /// let number_known = |past: exact_kalman::model::Past<'_, Rational>| Ok(Matrix::diagonal(&[ratio(i64::try_from(past.len()).unwrap_or(0), 1)]));
    /// let system = System {
    ///     timing: Timing::Departing,
    ///     initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), one.clone()),
    ///     transition: Coefficient::adapted(number_known),
    ///     observation: one.clone().into(),
    ///     noise: Noise::Covariances { process: one.clone().into(), cross: None, observation: one.into() },
    ///     input: None,
    ///     observation_input: None,
    /// };
    /// let readings = [1, 3].map(|y| Observation::complete([ratio(y, 1)]));
    /// let path = system.realised_ahead(&readings, NonZero::new(2).ok_or("zero")?)?;
    /// let known = |k: usize| path.transition_into(k).map(|transition| transition.matrix[(0, 0)].clone());
    /// assert_eq!([1, 2, 3].map(known), [0, 1, 2].map(|number| Some(ratio(number, 1))));
    /// assert_eq!(known(4), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn realised_ahead(
        &self,
        observations: &[Observation<S>],
        steps_ahead: NonZero<usize>,
    ) -> Result<PathAhead<S>, ModelError<S>> {
        let ahead = steps_ahead.get();
        let beyond = match self.timing {
            Timing::Arriving => ahead,
            Timing::Departing => ahead - 1,
        };
        let realisation = Realisation::of(self, observations, ahead)?;
        let path = realisation.path()?;
        // Without the transition that departs from the last observation none of those that follow can be reached.
        let reached = path.timing() == Timing::Arriving || path.steps().last().is_some_and(|s| s.transition.is_some());
        let indices = path.steps().len()..path.steps().len().saturating_add(if reached { beyond } else { 0 });
        let transitions = indices.map_while(|k| realisation.transition_beyond(k).transpose());
        let beyond = transitions.collect::<Result<_, _>>()?;
        Ok(PathAhead { path, steps_ahead, beyond })
    }
}
