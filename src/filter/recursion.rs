//! The recursion of the Theorem, as one reads it.

use super::FilterError;
use super::diffuse::{self, Observed};
use super::update::{Sensors, update};
use crate::gaussian::ConditionError;
use crate::matrix::Matrix;
use crate::model::{Before, Path, Step, Timing, Transition};
use crate::scalar::Scalar;
use crate::trace::{Moments, Record, Trace};

/// The conditional law of the state given the observations so far, at every step.
///
/// CKS-T: `x(t) is conditionally Gaussian given (y(0), …, y(t)), with mean x̂(t) and covariance P(t)`
///
/// CKS-R: `R(t) = A(t)P(t)Aᵀ(t) + D(t)Dᵀ(t)`
///
/// In departing timing the prediction is conditioned on the noise that y_k shares with the transition that
/// departs from k (HV, d = 1). Missing entries drop their rows. A diffuse start runs on the two leading
/// orders of its series in 1/κ until no diffuse part is left.
///
/// # Errors
///
/// [`FilterError`] with the step: data of probability zero, or a pseudo-inverse that does not exist (finite
/// fields) or cannot be decided. What was computed before it is kept.
///
/// # Examples
///
/// A variable of variance 1 read twice with noise of variance 1; the readings are 1 and 2:
///
/// ```
/// use exact_kalman::filter::filter;
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
/// use exact_kalman::scalar::{ratio, Rational};
///
/// let one = Matrix::<Rational>::identity(1);
/// let constant = System {
///     timing: Timing::Departing,
///     initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), one.clone()),
///     transition: one.clone().into(),
///     observation: one.clone().into(),
///     noise: Noise::Covariances { process: Matrix::zeros(1, 1).into(), cross: None, observation: one.into() },
///     input: None,
///     observation_input: None,
/// };
/// let path = constant.realised(&[Observation::complete([ratio(1, 1)]), Observation::complete([ratio(2, 1)])])?;
/// let last = &filter(&path)?.records[1];
/// assert_eq!(last.filtered.mean[(0, 0)], ratio(1, 1));
/// assert_eq!(last.filtered.covariance[(0, 0)], ratio(1, 3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn filter<S: Scalar>(path: &Path<S>) -> Result<Trace<S>, FilterError<S>> {
    let mut filter = Recursion::new(path);
    for step in path.steps() {
        if let Err(source) = filter.advance(step) {
            return Err(FilterError { step: filter.records.len(), source, computed: filter.records });
        }
    }
    Ok(filter.into_trace())
}

/// The record of a step, and the law with which the next one begins.
type Advanced<S> = (Record<S>, Option<Moments<S>>);

/// The filter between two observations.
#[derive(Debug)]
pub(super) struct Recursion<S> {
    timing: Timing,
    /// In departing timing the law of the next state; in arriving timing that of the last one.
    state: Option<Moments<S>>,
    /// Whether the law is already that of the state which the next observation sees.
    predicted: bool,
    pub(super) records: Vec<Record<S>>,
}

impl<S: Scalar> Recursion<S> {
    pub(super) fn new(path: &Path<S>) -> Self {
        let initial = path.initial();
        let moments = Moments {
            mean: initial.mean.clone(),
            covariance: initial.covariance.clone(),
            diffuse: diffuse::part(initial.diffuse.clone()),
        };
        let predicted = initial.before == Before::Observation;
        Self { timing: path.timing(), state: Some(moments), predicted, records: Vec::new() }
    }

    /// The law with which the next step begins, if it has no diffuse part.
    pub(super) fn plain_state(&self) -> Option<&Moments<S>> {
        self.state.as_ref().filter(|moments| moments.diffuse.is_none())
    }

    /// Whether the law with which the next step begins is already that of the state which it observes.
    pub(super) fn is_predicted(&self) -> bool {
        self.predicted
    }

    /// The law of the state that the next step observes, if `transition` leads into it.
    pub(super) fn next(&self, transition: Option<&Transition<S>>) -> Option<Moments<S>> {
        let state = self.state.as_ref()?;
        if self.predicted { Some(state.clone()) } else { Some(propagated(state, transition?)) }
    }

    pub(super) fn advance(&mut self, step: &Step<S>) -> Result<(), ConditionError<S>> {
        // A path has a transition wherever a later observation depends on it; without a state there is none.
        let Some(state) = self.state.take() else { return Ok(()) };
        let sensors = Sensors::of(step);
        let predicted = match (&step.transition, self.timing) {
            (Some(transition), Timing::Arriving) if !self.predicted => propagated(&state, transition),
            _ => state,
        };
        let (record, next) = if predicted.diffuse.is_some() {
            self.diffuse_step(predicted, &sensors, step)?
        } else {
            self.plain_step(predicted, &sensors, step)?
        };
        self.records.push(record);
        self.state = next;
        self.predicted = self.timing == Timing::Departing;
        Ok(())
    }

    fn plain_step(
        &self,
        predicted: Moments<S>,
        sensors: &Sensors<S>,
        step: &Step<S>,
    ) -> Result<Advanced<S>, ConditionError<S>> {
        let updated = update(predicted, sensors, self.timing)?;
        let next = match self.timing {
            Timing::Arriving => Some(updated.record.filtered.clone()),
            Timing::Departing => {
                step.transition.as_ref().map(|t| departed(&updated.record, &updated.pseudo_inverse, t, sensors))
            }
        };
        Ok((updated.record, next))
    }

    fn diffuse_step(
        &self,
        predicted: Moments<S>,
        sensors: &Sensors<S>,
        step: &Step<S>,
    ) -> Result<Advanced<S>, ConditionError<S>> {
        let observed = Observed::of(predicted, sensors, self.timing);
        let departed = match (self.timing, &step.transition) {
            (Timing::Departing, Some(transition)) => Some(observed.departed(transition, sensors)?),
            _ => None,
        };
        let record = observed.record(sensors)?;
        let next = match self.timing {
            Timing::Arriving => Some(record.filtered.clone()),
            Timing::Departing => departed,
        };
        Ok((record, next))
    }

    pub(super) fn into_trace(self) -> Trace<S> {
        let ahead = if self.timing == Timing::Departing { self.state } else { None };
        Trace { records: self.records, ahead }
    }
}

/// CKS-8: `E(x(t+1) | Y(t)) = A(t)E(x(t) | Y(t)) + B(t)u(t)`
///
/// CKS-R: `R(t) = A(t)P(t)Aᵀ(t) + D(t)Dᵀ(t)`
pub(super) fn propagated<S: Scalar>(state: &Moments<S>, transition: &Transition<S>) -> Moments<S> {
    let a = &transition.matrix;
    Moments {
        mean: a * &state.mean + &transition.input,
        covariance: a.congruence(&state.covariance) + &transition.noise,
        diffuse: diffuse::part(state.diffuse.as_ref().map(|part| a.congruence(part))),
    }
}

/// The next state given y_k, when the transition departs from k and shares its noise with y_k: the mean is
/// Ax⁻ + Bu + (AΓ + DFᵀ)S⁺ν, with x⁻ = x̂(k|k−1), Γ = P⁻Cᵀ, ν the innovation and S its covariance.
///
/// HV-3: `x̂(k+1|k) = A(k)x̂(k|k−1) + B(k)u(k) + K(k)[y(k) − C(k−1)x̂(k|k−1) − G(k−1)v(k−1)]`
///
/// HV-4: `P(k+1|k) = A(k)P(k|k−1)Aᵀ(k) + D(k)Dᵀ(k) − K(k)[C(k−1)P(k|k−1)Aᵀ(k) + F(k−1)Dᵀ(k)]`
///
/// HV-5: `K(k) = [A(k)P(k|k−1)Cᵀ(k−1) + D(k)Fᵀ(k−1)][C(k−1)P(k|k−1)Cᵀ(k−1) + F(k−1)Fᵀ(k−1)]⁺`
fn departed<S: Scalar>(
    record: &Record<S>,
    pseudo_inverse: &Matrix<S>,
    transition: &Transition<S>,
    sensors: &Sensors<S>,
) -> Moments<S> {
    let before = propagated(&record.predicted, transition);
    let cross = &transition.matrix * &record.cross_covariance + &sensors.cross_noise;
    let gain = &cross * pseudo_inverse;
    Moments {
        mean: before.mean + &gain * &record.innovation,
        covariance: before.covariance - gain * cross.transpose(),
        diffuse: None,
    }
}
