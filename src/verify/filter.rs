//! The certificate of a filter, step by step.

use super::belief::Belief;
use super::document::{BeliefDocument, StepDocument};
use super::rejection::{Condition, Rejection, wrong};
use super::step::{Innovation, check_order, check_size, proved};
use super::table::Table;
use super::unified::{Target, Unified};
use crate::matrix::{Matrix, Shape};
use crate::model::{Before, Initial, Step, Timing, Transition};
use crate::scalar::Rational;

/// What is proved of a step.
#[derive(Clone, Debug)]
pub struct ProvedStep {
    /// The state that is read, before the reading: with a transition that arrives, the one after it.
    pub predicted: Belief,
    /// The state given the reading.
    pub filtered: Belief,
    /// The state after the transition that departs, given the reading.
    pub ahead: Option<Belief>,
    /// The bits to which all entries of all of them are known, in their units; nothing where they are known exactly.
    pub bits: Option<u64>,
}

/// Checks the steps of a certificate against those of a path, one after the other; it remembers one belief.
///
/// The steps and the initial law are those of [`System::steps`](crate::model::System::steps) or of a [`Path`](crate::model::Path), in
/// their order and none left out: that their covariances are such was checked there.
#[derive(Debug)]
pub struct FilterCheck {
    timing: Timing,
    before: Before,
    belief: Belief,
    done: usize,
}

impl FilterCheck {
    /// The belief with which a path begins, checked.
    ///
    /// # Errors
    ///
    /// [`Rejection`]; also for a diffuse start, of which no certificate speaks.
    pub fn begin(timing: Timing, initial: &Initial<Rational>, start: &BeliefDocument) -> Result<Self, Rejection> {
        let n = initial.mean.rows();
        if !has_shape(&initial.mean, n, 1) || !has_shape(&initial.covariance, n, n) {
            return Err(wrong(Condition::Shape, "the moments with which the case begins do not fit each other"));
        }
        if initial.diffuse.iter().any(|part| !part.is_zero()) {
            return Err(wrong(Condition::Case, "the start is diffuse: no certificate speaks of such a case"));
        }
        if start.gain.is_some() || start.balance.is_some() {
            return Err(wrong(Condition::Members, "`start` has neither `gain` nor `balance`"));
        }
        let belief = Belief::of(start, n)?;
        let mean = Table::of(n, 1, |i, j| &initial.mean[(i, j)]);
        let covariance = Table::of(n, n, |i, j| &initial.covariance[(i, j)]);
        check_size(
            [belief.magnitude(), mean.magnitude(), covariance.magnitude()].into_iter().max().unwrap_or(0),
            n,
            0,
        )?;
        belief.encloses(&mean, &covariance)?;
        Ok(Self { timing, before: initial.before, belief, done: 0 })
    }

    /// How many steps were checked.
    pub fn done(&self) -> usize {
        self.done
    }

    /// Checks what is said of the next step.
    ///
    /// # Errors
    ///
    /// [`Rejection`].
    pub fn step(&mut self, step: &Step<Rational>, document: &StepDocument) -> Result<ProvedStep, Rejection> {
        let at = self.done;
        let proved = self.checked(step, document).map_err(|rejection| Rejection { step: Some(at), ..rejection })?;
        self.belief = proved.ahead.as_ref().unwrap_or(&proved.filtered).clone();
        self.done += 1;
        Ok(proved)
    }

    /// That all steps were checked, of so many that the path has.
    ///
    /// # Errors
    ///
    /// [`Rejection`].
    pub fn end(&self, steps: usize) -> Result<(), Rejection> {
        if self.done == steps {
            return Ok(());
        }
        Err(wrong(Condition::Order, format!("{} of {steps} steps are certified", self.done)))
    }

    fn checked(&self, step: &Step<Rational>, document: &StepDocument) -> Result<ProvedStep, Rejection> {
        let n = self.belief.states();
        if !fits(step, n) {
            return Err(wrong(Condition::Shape, format!("the step of the case is none of n = {n} states")));
        }
        check_order(n, step.reading.dimension())?;
        if document.step != self.done {
            return Err(wrong(Condition::Order, format!("it is called {}", document.step)));
        }
        let is_first = self.done == 0 && self.before == Before::Observation;
        let arrives = self.timing == Timing::Arriving && !is_first && step.transition.is_some();
        let law = Unified::of(step, self.timing, arrives)?;
        check_size(law.magnitude(), n, law.observation.rows)?;
        let law = match &document.kept {
            None => law,
            Some(kept) => law.select(&places(step, kept)?)?,
        };
        let belief = &self.belief;
        let innovation = match &document.whitening {
            Some(whitening) if law.observation.rows > 0 => Some(Innovation::of(belief, &law, whitening)?),
            None if law.observation.rows == 0 => None,
            Some(_) => return Err(wrong(Condition::Members, "a `whitening` where nothing is read")),
            None => return Err(wrong(Condition::Members, "`whitening` is missing")),
        };
        let optional = |name: &str, target: &Option<Target>, document: &Option<BeliefDocument>, innovation| match (
            target, document,
        ) {
            (Some(target), Some(document)) => {
                proved(belief, &law, target, innovation, document).map(Some).map_err(|found| named(name, found))
            }
            (None, None) => Ok(None),
            (Some(_), None) => Err(wrong(Condition::Members, format!("`{name}` is missing"))),
            (None, Some(_)) => Err(wrong(Condition::Members, format!("there is no such state as `{name}`"))),
        };
        let predicted = optional("predicted", &law.predicted, &document.predicted, None)?;
        let filtered = proved(belief, &law, &law.filtered, innovation.as_ref(), &document.filtered);
        let filtered = filtered.map_err(|found| named("filtered", found))?;
        let ahead = optional("ahead", &law.ahead, &document.ahead, innovation.as_ref())?;
        let predicted = predicted.unwrap_or_else(|| belief.clone());
        let bits =
            [predicted.bits(belief), filtered.bits(&predicted), ahead.as_ref().and_then(|it| it.bits(&filtered))];
        Ok(ProvedStep { bits: bits.into_iter().flatten().min(), predicted, filtered, ahead })
    }
}

fn has_shape(matrix: &Matrix<Rational>, rows: usize, columns: usize) -> bool {
    matrix.shape() == Shape { rows, columns }
}

/// Whether the matrices of a step have the shapes of n states, and of the sensors of its reading.
fn fits(step: &Step<Rational>, n: usize) -> bool {
    let Step { transition, observation, observation_input, observation_noise, reading } = step;
    let m = reading.dimension();
    has_shape(observation, m, n)
        && has_shape(observation_input, m, 1)
        && has_shape(observation_noise, m, m)
        && transition.iter().all(|Transition { matrix, input, noise, cross_noise }| {
            has_shape(matrix, n, n) && has_shape(input, n, 1) && has_shape(noise, n, n) && has_shape(cross_noise, n, m)
        })
}

fn named(name: &str, Rejection { line, step, condition, message }: Rejection) -> Rejection {
    Rejection { line, step, condition, message: format!("`{name}`: {message}") }
}

/// The places of the sensors that are kept among those that are observed.
fn places(step: &Step<Rational>, kept: &[usize]) -> Result<Vec<usize>, Rejection> {
    let observed = step.reading.present();
    if !kept.is_sorted_by(|a, b| a < b) {
        return Err(wrong(Condition::Kept, "`kept` is not in increasing order"));
    }
    let place = |sensor| observed.binary_search(sensor).ok();
    kept.iter()
        .map(place)
        .collect::<Option<_>>()
        .ok_or_else(|| wrong(Condition::Kept, "a sensor in `kept` is not observed"))
}
