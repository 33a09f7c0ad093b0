//! The filter on integer matrices over one denominator, without a greatest common divisor of large numbers.
//!
//! A covariance is `P = N / (u d)` with integers N, u, d. Where the observed entries y and the targets x are
//! `E x₋ + noise` with `E = Eᵢ/e` and noise covariance `Qᵢ/w`, e² | w, their joint covariance is `J / (w u d)`:
//!
//! > `J = (w/e²) Eᵢ N Eᵢᵀ + u d Qᵢ`
//!
//! Symmetric fraction-free elimination of the entries of y, *with d as its first divisor*, leaves N₊ in place of
//! a target: `P₊ = N₊ / (w u d₊)`, d₊ the last pivot. All divisions are exact: the k-minors of N are divisible by
//! d^(k−1), since N is itself what an elimination with last pivot d has left (Sylvester's identity), and both
//! terms of J keep that. The mean is one more column. Powers of two, all that doubles have in their denominators,
//! are moved from d to u and cancelled by shifts.
//!
//! A zero pivot of a positive semidefinite J has a zero row: it is passed over, and the innovation must vanish
//! there, else the data have probability zero.

mod elimination;
mod error;
mod rounding;
mod state;

use elimination::{Eliminated, Joint, Stop};
pub use error::{FractionFreeError, StopReason};
pub use rounding::Precision;
use state::State;

use super::recursion::Recursion;
use super::update::{Sensors, update};
use crate::matrix::Matrix;
use crate::model::{Path, Step, Timing};
use crate::scalar::Rational;
use crate::trace::{Moments, Quantity, Record, Values};

/// The results of one step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FractionFreeStep {
    /// The named values, all but the gain.
    pub values: Values<Rational>,
    /// The rank of the innovation covariance, exactly.
    pub innovation_rank: usize,
}

/// How far the fraction-free filter goes, and what it hands out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// How results are handed out.
    pub precision: Precision,
    /// The length in bits that denominators may reach, if there is a limit; a sixteenth of it in steps that go through
    /// the recursion.
    pub maximal_bits: Option<u64>,
}

impl From<Precision> for Effort {
    fn from(precision: Precision) -> Self {
        Self { precision, maximal_bits: None }
    }
}

/// The values of [`filter`](super::filter) except the gain, by a faster route.
///
/// With [`Precision::Exact`] they are equal to those of the recursion; with [`Precision::Rounded`] each entry is
/// the exact one rounded to that many significant bits, which spares the greatest common divisors of lowest terms.
///
/// Steps with a diffuse part, and paths that run with an indefinite initial covariance, go through the recursion.
///
/// # Errors
///
/// [`FractionFreeError`] for the reasons of [`filter`](super::filter), or when numbers outgrow the limit.
pub fn filter_fraction_free(
    path: &Path<Rational>,
    effort: impl Into<Effort>,
) -> Result<Vec<FractionFreeStep>, FractionFreeError> {
    let Effort { precision, maximal_bits } = effort.into();
    let semidefinite = !path.initial().allow_indefinite;
    let mut start = Recursion::new(path);
    let mut predicted_already = start.is_predicted();
    let mut done: Vec<FractionFreeStep> = Vec::new();
    let mut state: Option<State> = None;
    for (k, step) in path.steps().iter().enumerate() {
        let stopped = |reason, computed| FractionFreeError { step: k, reason, computed };
        if state.is_none() {
            let Some(moments) = start.plain_state().filter(|_| semidefinite) else {
                start.advance(step).map_err(|source| stopped(source.into(), done.clone()))?;
                let Some(record) = start.records.last() else { break };
                done.push(rounded(record, precision));
                // Fractions in lowest terms cost so much more than integers that they may grow so much less.
                if let Some(limit) = maximal_bits.map(|limit| limit / 16).filter(|limit| length(record) > *limit) {
                    return Err(stopped(StopReason::TooLong { bits: length(record), limit }, done));
                }
                predicted_already = start.is_predicted();
                continue;
            };
            state = Some(State::of(moments));
        }
        // A path has a transition wherever a later observation depends on it.
        let Some(current) = state.take() else { break };
        if let Some(limit) = maximal_bits.filter(|limit| current.bits() > *limit) {
            return Err(stopped(StopReason::TooLong { bits: current.bits(), limit }, done));
        }
        let predicted = match (&step.transition, path.timing()) {
            (Some(transition), Timing::Arriving) if !predicted_already => current.propagated(transition),
            _ => current,
        };
        predicted_already = path.timing() == Timing::Departing;
        match advanced(&predicted, step, path.timing(), precision) {
            Ok((results, next)) => {
                done.push(results);
                state = next;
            }
            Err(Stop) => return Err(stopped(reason(&predicted, step, path.timing()), done)),
        }
    }
    Ok(done)
}

/// One observation: the values of the step, and the state with which the next one begins.
fn advanced(
    predicted: &State,
    step: &Step<Rational>,
    timing: Timing,
    precision: Precision,
) -> Result<(FractionFreeStep, Option<State>), Stop> {
    let sensors = Sensors::of(step);
    let joint = Joint::of(predicted, &sensors, step.transition.as_ref(), timing);
    let mut values = Values::new();
    predicted.put(&mut values, [Quantity::PredictedMean, Quantity::PredictedCovariance], precision);
    if !sensors.observed.is_empty() {
        let (innovation, covariance) = joint.innovation(precision);
        values.insert(Quantity::Innovation, innovation);
        values.insert(Quantity::InnovationCovariance, covariance);
    }
    let Eliminated { filtered, departed, rank } = joint.eliminated()?;
    filtered.put(&mut values, [Quantity::FilteredMean, Quantity::FilteredCovariance], precision);
    let next = match timing {
        Timing::Arriving => Some(filtered),
        Timing::Departing => departed,
    };
    Ok((FractionFreeStep { values, innovation_rank: rank }, next))
}

/// The reason why the elimination stopped, with its witness, in the words of the recursion.
fn reason(predicted: &State, step: &Step<Rational>, timing: Timing) -> StopReason {
    match update(predicted.moments(), &Sensors::of(step), timing) {
        Err(reason) => reason.into(),
        Ok(_) => StopReason::NotSemidefinite,
    }
}

/// The length in bits of the longest denominator that goes on to the next step.
fn length(record: &Record<Rational>) -> u64 {
    let Moments { covariance, diffuse, .. } = &record.filtered;
    let entries = covariance.entries().iter().chain(diffuse.iter().flat_map(Matrix::entries));
    entries.map(|entry| entry.denom().bits()).max().unwrap_or(0)
}

fn rounded(record: &Record<Rational>, precision: Precision) -> FractionFreeStep {
    let values = record.values().into_iter().filter(|(quantity, _)| *quantity != Quantity::Gain);
    let values = values.map(|(quantity, matrix)| (quantity, matrix.map(|entry| precision.of(entry)))).collect();
    FractionFreeStep { values, innovation_rank: record.innovation_rank }
}
