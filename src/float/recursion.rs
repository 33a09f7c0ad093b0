//! The walk along a path, the same for all forms.

use nalgebra::{DMatrix, DVector};

use super::error::{FloatError, Obstacle};
use super::moments::{Moments, dense, dense_column, finite, finite_column};
use super::observed::Observed;
use super::transition::{Departure, Transition};
use crate::model::{Path, Step, Timing};
use crate::trace::{Quantity, Values};

/// A form: what it carries from step to step, and how.
pub(super) trait Recursion {
    /// The name: words, joined by hyphens.
    const NAME: &'static str;
    /// What it does, in one line.
    const DESCRIPTION: &'static str;
    /// What is carried: the moments, or something they can be computed from.
    type Belief;

    /// The belief with the given moments.
    fn start(moments: Moments) -> Result<Self::Belief, Obstacle>;

    /// The moments of a belief.
    fn moments(belief: &Self::Belief) -> Result<Moments, Obstacle>;

    /// The belief after a transition whose noise is independent of all that was observed.
    fn predicted(belief: &Self::Belief, transition: &Transition) -> Result<Self::Belief, Obstacle>;

    /// The belief after a transition whose noise is shared with that of the reading which follows (arriving timing).
    ///
    /// `observed` holds what is shared, also for [`updated`](Self::updated); a form that keeps no noise apart needs no more.
    fn arrived(belief: &Self::Belief, transition: &Transition, _observed: &Observed) -> Result<Self::Belief, Obstacle> {
        Self::predicted(belief, transition)
    }

    /// The belief after a reading and, if a transition departs from it, the belief after that.
    fn updated(
        belief: &Self::Belief,
        observed: &Observed,
        departure: Option<&Departure<'_>>,
    ) -> Result<Update<Self::Belief>, Obstacle>;
}

/// A form that carries the moments themselves.
pub(super) trait MomentRecursion {
    /// The name: words, joined by hyphens.
    const NAME: &'static str;
    /// What it does, in one line.
    const DESCRIPTION: &'static str;

    /// As [`Recursion::predicted`].
    fn predicted(belief: &Moments, transition: &Transition) -> Result<Moments, Obstacle>;

    /// As [`Recursion::updated`].
    fn updated(
        belief: &Moments,
        observed: &Observed,
        departure: Option<&Departure<'_>>,
    ) -> Result<Update<Moments>, Obstacle>;
}

impl<R: MomentRecursion> Recursion for R {
    const NAME: &'static str = <R as MomentRecursion>::NAME;
    const DESCRIPTION: &'static str = <R as MomentRecursion>::DESCRIPTION;
    type Belief = Moments;

    fn start(moments: Moments) -> Result<Moments, Obstacle> {
        Ok(moments)
    }

    fn moments(belief: &Moments) -> Result<Moments, Obstacle> {
        Ok(belief.clone())
    }

    fn predicted(belief: &Moments, transition: &Transition) -> Result<Moments, Obstacle> {
        <R as MomentRecursion>::predicted(belief, transition)
    }

    fn updated(
        belief: &Moments,
        observed: &Observed,
        departure: Option<&Departure<'_>>,
    ) -> Result<Update<Moments>, Obstacle> {
        <R as MomentRecursion>::updated(belief, observed, departure)
    }
}

/// What a reading says.
pub(super) struct Update<B> {
    /// ν
    pub(super) innovation: DVector<f64>,
    /// S
    pub(super) innovation_covariance: DMatrix<f64>,
    /// K, of Moore and Penrose; nothing where S is singular and the form uses another one.
    pub(super) gain: Option<DMatrix<f64>>,
    /// The law of the state given the reading too.
    pub(super) filtered: B,
    /// The law of the next state, if a transition departs.
    pub(super) ahead: Option<B>,
}

/// The form `R` along a path.
///
/// # Errors
///
/// [`FloatError`] with the step, and what was computed before it.
pub(super) fn run<R: Recursion>(path: &Path<f64>) -> Result<Vec<Values<f64>>, FloatError> {
    walk::<R>(path, |_, _| Ok(()))
}

/// The form `R` along a path, with something to be done after each step: `after` is given the step and the belief with
/// which the next one begins.
///
/// # Errors
///
/// As for [`run`].
pub(super) fn walk<R: Recursion>(
    path: &Path<f64>,
    mut after: impl FnMut(usize, &R::Belief) -> Result<(), Obstacle>,
) -> Result<Vec<Values<f64>>, FloatError> {
    let initial = path.initial();
    // A part P∞ = 0 is no diffuse part; a NaN in it is no zero either.
    if initial.diffuse.iter().any(|part| part.entries().iter().any(|&entry| entry != 0.0)) {
        return Err(FloatError::Diffuse);
    }
    let moments = Moments { mean: dense_column(&initial.mean), covariance: dense(&initial.covariance) };
    let mut computed = Vec::with_capacity(path.steps().len());
    let mut belief = match R::start(moments) {
        Ok(belief) => belief,
        Err(obstacle) => return Err(obstacle.after(computed)),
    };
    for step in path.steps() {
        let done = one::<R>(belief, step, path.timing(), path.states())
            .and_then(|(values, next)| after(computed.len(), &next).map(|()| (values, next)));
        match done {
            Ok((values, next)) => {
                computed.push(values);
                belief = next;
            }
            Err(obstacle) => return Err(obstacle.after(computed)),
        }
    }
    Ok(computed)
}

/// One step: its values, and the belief with which the next begins.
fn one<R: Recursion>(
    belief: R::Belief,
    step: &Step<f64>,
    timing: Timing,
    states: usize,
) -> Result<(Values<f64>, R::Belief), Obstacle> {
    let transition = step.transition.as_ref().map(Transition::of);
    let observed = Observed::at(step, timing, states);
    let (predicted, departing) = match (timing, transition) {
        (Timing::Arriving, Some(transition)) => match observed.as_ref().filter(|observed| observed.shares_noise()) {
            Some(observed) => (R::arrived(&belief, &transition, observed)?, None),
            None => (R::predicted(&belief, &transition)?, None),
        },
        (Timing::Arriving, None) => (belief, None),
        (Timing::Departing, transition) => (belief, transition),
    };
    let mut values = Values::new();
    insert_moments(&mut values, (Quantity::PredictedMean, Quantity::PredictedCovariance), &R::moments(&predicted)?)?;
    let Some(observed) = observed else {
        // Nothing was learned, and no noise is shared with an observation.
        insert_moments(&mut values, (Quantity::FilteredMean, Quantity::FilteredCovariance), &R::moments(&predicted)?)?;
        let next = departing.map(|transition| R::predicted(&predicted, &transition)).transpose()?;
        return Ok((values, next.unwrap_or(predicted)));
    };
    let departure = departing.as_ref().zip(step.transition.as_ref()).map(|(transition, given)| Departure {
        transition,
        cross_noise: dense(&given.cross_noise.select_columns(&step.reading.present())),
    });
    let update = R::updated(&predicted, &observed, departure.as_ref())?;
    values.insert(Quantity::Innovation, finite_column(&update.innovation)?);
    values.insert(Quantity::InnovationCovariance, finite(&update.innovation_covariance)?);
    if let Some(gain) = &update.gain {
        values.insert(Quantity::Gain, finite(gain)?);
    }
    let filtered = R::moments(&update.filtered)?;
    insert_moments(&mut values, (Quantity::FilteredMean, Quantity::FilteredCovariance), &filtered)?;
    Ok((values, update.ahead.unwrap_or(update.filtered)))
}

fn insert_moments(
    values: &mut Values<f64>,
    (mean, covariance): (Quantity, Quantity),
    moments: &Moments,
) -> Result<(), Obstacle> {
    values.insert(mean, finite_column(&moments.mean)?);
    values.insert(covariance, finite(&moments.covariance)?);
    Ok(())
}
