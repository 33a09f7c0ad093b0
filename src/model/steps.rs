//! A system along data, one step at a time.

use std::ops::Range;

use super::realise::Realisation;
use super::{ModelError, Observation, Step, System};
use crate::scalar::OrderedField;

/// The steps of a [`Path`](super::Path), each evaluated and checked when it is asked for: made by [`System::steps`].
#[derive(Debug)]
pub struct Steps<'a, S> {
    realisation: Realisation<'a, S>,
    left: Range<usize>,
}

impl<S: OrderedField> System<S> {
    /// The steps of [`System::realised`], in their order; shapes of readings, lengths of lists and the initial law are checked at once.
    ///
    /// For data that are passed once: no step is kept. Before the last is there, none is known to belong to a sound system.
    ///
    /// # Errors
    ///
    /// [`ModelError`], here or in place of the first step that is wrong: together the one error of [`System::realised`].
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::matrix::Matrix;
    /// use exact_kalman::model::{Before, Coefficient, Initial, ModelError, Noise, Observation, System, Timing};
    /// use exact_kalman::scalar::{ratio, Rational};
    ///
    /// let one = Matrix::<Rational>::identity(1);
    /// let variances = [4, 1, -1].map(|r| Some(Matrix::diagonal(&[ratio(r, 1)])));
    /// let system = System {
    ///     timing: Timing::Departing,
    ///     initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), one.clone()),
    ///     transition: one.clone().into(),
    ///     observation: one.clone().into(),
    ///     noise: Noise::Covariances { process: one.into(), cross: None, observation: Coefficient::PerStep(variances.into()) },
    ///     input: None,
    ///     observation_input: None,
    /// };
    /// let readings = [1, 2, 3].map(|y| Observation::complete([ratio(y, 1)]));
    /// let mut steps = system.steps(&readings)?;
    /// assert_eq!(steps.len(), 3);
    /// assert!(steps.by_ref().take(2).all(|step| step.is_ok()));
    /// assert!(matches!(steps.next(), Some(Err(ModelError::Indefinite { .. }))));
    /// # Ok::<(), ModelError<Rational>>(())
    /// ```
    pub fn steps<'a>(&'a self, observations: &'a [Observation<S>]) -> Result<Steps<'a, S>, ModelError<S>> {
        let realisation = Realisation::of(self, observations, 1)?;
        realisation.check_initial()?;
        Ok(Steps { realisation, left: 0..observations.len() })
    }
}

impl<S: OrderedField> Iterator for Steps<'_, S> {
    type Item = Result<Step<S>, ModelError<S>>;

    fn next(&mut self) -> Option<Self::Item> {
        self.left.next().map(|k| self.realisation.step(k))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.left.size_hint()
    }
}

impl<S: OrderedField> ExactSizeIterator for Steps<'_, S> {}
