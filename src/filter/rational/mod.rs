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
//! terms of J keep that. The mean is one more column. What d has of the primes of u, which are
//! those of the data's denominators, is moved from d to u and cancelled: numbers grow about as those in lowest terms do.
//!
//! Where states or sensors are several, the same elimination is done modulo many primes, and the integers follow from
//! their remainders: see [`Route::Multimodular`].
//!
//! A zero pivot of a positive semidefinite J has a zero row: it is passed over, and the innovation must vanish
//! there, else the data have probability zero.

mod effort;
mod elimination;
mod error;
mod exact_division;
mod image;
mod law;
mod laws;
mod residues;
mod state;
mod step;

use std::collections::BTreeMap;

pub use effort::{Effort, FRACTIONS_PART, Route, Wanted};
use elimination::{Eliminated, Joint, Stop};
pub use error::{RationalFilterError, StopReason};
use laws::{Laws, StepLaws};
use residues::Residues;
use state::State;
pub use step::{RationalStep, StepValues};

use super::recursion::Recursion;
use super::update::{Sensors, update};
use crate::matrix::Fractions;
use crate::model::{Path, Step, Timing};
use crate::scalar::Rational;
use crate::trace::Quantity;

/// Denominators with fewer bits than this are not worth a set of primes.
const SHORTEST: u64 = 512;

/// From this length in bits on, the primes are so many that what takes their number squared is felt.
const LONGEST: u64 = 1 << 19;

/// The scale of a state is taken modulo each prime anew at each step; it is short but where states decay unobserved.
const LONGEST_SCALE: u64 = 1 << 14;

/// The values of [`filter`](super::filter()) except the gain, by faster routes.
///
/// They are equal to those of the recursion, and come as integers over denominators: fractions in lowest terms, or
/// rounded, are made of them when they are asked for.
///
/// Steps with a diffuse part, and paths that run with an indefinite initial covariance, go through the recursion.
///
/// # Errors
///
/// [`RationalFilterError`] for the reasons of [`filter`](super::filter()), or when numbers outgrow the limit.
pub fn filter_rational(path: &Path<Rational>, effort: Effort) -> Result<Vec<RationalStep>, RationalFilterError> {
    let mut computed = Vec::with_capacity(path.steps().len());
    for step in RationalFilter::new(path, effort) {
        match step {
            Ok(step) => computed.push(step),
            Err(reason) => return Err(RationalFilterError { step: computed.len(), reason, computed }),
        }
    }
    Ok(computed)
}

/// The filter on exact rationals, one step at a time: nothing but the state is kept.
///
/// It ends with the path, or with the reason why it cannot go on.
#[derive(Debug)]
pub struct RationalFilter<'a> {
    path: &'a Path<Rational>,
    effort: Effort,
    laws: Laws<'a>,
    stage: Stage,
    /// Images of the state modulo primes, if they have followed it.
    residues: Option<Residues>,
    /// The number of steps done.
    done: usize,
    predicted_already: bool,
}

/// What a filter holds between two steps.
#[derive(Debug)]
enum Stage {
    /// A state of fractions, with a diffuse part or indefinite; the length of its longest denominator.
    Fractions(Box<Recursion<Rational>>, u64),
    Integers(Box<State>),
    Ended,
}

/// The results of a step, and the state with which the next one begins.
type Advanced = (RationalStep, Option<State>);

impl<'a> RationalFilter<'a> {
    /// The filter before the first step of a path.
    pub fn new(path: &'a Path<Rational>, effort: Effort) -> Self {
        let start = Recursion::new(path);
        let predicted_already = start.is_predicted();
        let stage = Stage::Fractions(Box::new(start), 0);
        Self { path, effort, laws: Laws::default(), stage, residues: None, done: 0, predicted_already }
    }

    /// The length in bits of the denominators of the state's covariance.
    pub fn bits(&self) -> u64 {
        match &self.stage {
            Stage::Fractions(_, bits) => *bits,
            Stage::Integers(state) => state.bits(),
            Stage::Ended => 0,
        }
    }

    fn advance(&mut self, step: &'a Step<Rational>) -> Option<Result<RationalStep, StopReason>> {
        match std::mem::replace(&mut self.stage, Stage::Ended) {
            Stage::Fractions(start, bits) => {
                match start.plain_state().filter(|_| !self.path.initial().allow_indefinite) {
                    Some(moments) => Some(self.on_integers(&State::of(moments), step)),
                    None => self.by_recursion(start, bits, step).transpose(),
                }
            }
            Stage::Integers(state) => Some(self.on_integers(&state, step)),
            Stage::Ended => None,
        }
    }

    fn by_recursion(
        &mut self,
        mut start: Box<Recursion<Rational>>,
        bits: u64,
        step: &Step<Rational>,
    ) -> Result<Option<RationalStep>, StopReason> {
        self.within(bits, FRACTIONS_PART)?;
        start.advance(step)?;
        self.predicted_already = start.is_predicted();
        // A path has a transition wherever a later observation depends on it; without one the filter ends.
        let Some(record) = start.records.pop() else { return Ok(None) };
        self.stage = Stage::Fractions(start, record.denominator_bits());
        Ok(Some(RationalStep::of(&record, self.effort.wanted)))
    }

    fn on_integers(&mut self, state: &State, step: &'a Step<Rational>) -> Result<RationalStep, StopReason> {
        self.within(state.bits(), 1)?;
        let timing = self.path.timing();
        let transition = step.transition.as_ref().filter(|_| timing == Timing::Arriving && !self.predicted_already);
        self.predicted_already = timing == Timing::Departing;
        let is_modular = self.is_modular(state, step);
        let laws = self.laws.of(step, transition, timing);
        let residues = if is_modular { Some(self.residues.get_or_insert_default()) } else { None };
        let (results, next) = match residues {
            Some(residues) => modular(residues, state, laws, timing, self.effort.wanted),
            None => fraction_free(state, laws, timing, self.effort.wanted),
        }
        .map_err(|Stop| reason(&laws.predicted(state), step, timing))?;
        if !is_modular {
            // They have not followed.
            self.residues = None;
        }
        self.stage = next.map_or(Stage::Ended, |state| Stage::Integers(Box::new(state)));
        Ok(results)
    }

    /// Whether a step is made modulo primes.
    ///
    /// Elimination works through each entry once for each pivot, remainders put each together once: with at most three
    /// states and sensors together that is about the same, with more of them it is not.
    fn is_modular(&self, state: &State, step: &Step<Rational>) -> bool {
        let size = step.observation.columns() + step.observation.rows();
        let scale = state.scale.bits().max(state.mean_scale.bits());
        // The lengths of integers are known beforehand where covariances are semidefinite.
        self.path.is_semidefinite()
            && match self.effort.route {
                Route::Fastest => size > 3 && (SHORTEST..LONGEST).contains(&state.bits()) && scale < LONGEST_SCALE,
                Route::FractionFree => false,
                Route::Multimodular => true,
            }
    }

    /// Whether a length is within the limit, or within such a part of it.
    fn within(&self, bits: u64, part: u64) -> Result<(), StopReason> {
        match self.effort.maximal_bits.map(|limit| limit / part) {
            Some(limit) if bits > limit => Err(StopReason::TooLong { bits, limit }),
            _ => Ok(()),
        }
    }
}

impl Iterator for RationalFilter<'_> {
    type Item = Result<RationalStep, StopReason>;

    fn next(&mut self) -> Option<Self::Item> {
        let path = self.path;
        let step = path.steps().get(self.done)?;
        self.done += 1;
        self.advance(step)
    }
}

/// One observation, by elimination on integers.
fn fraction_free(state: &State, laws: StepLaws<'_>, timing: Timing, wanted: Wanted) -> Result<Advanced, Stop> {
    let predicted = laws.predicted(state);
    let joint = Joint::of(&predicted, laws.observation);
    let mut values = BTreeMap::new();
    if wanted == Wanted::Everything {
        insert_predicted(&mut values, &predicted, &joint);
    }
    Ok(handed_out(values, joint.eliminated()?, timing))
}

/// One observation, modulo primes; what is handed out of the time before it is worked out on integers.
fn modular(
    residues: &mut Residues,
    state: &State,
    laws: StepLaws<'_>,
    timing: Timing,
    wanted: Wanted,
) -> Result<Advanced, Stop> {
    let eliminated = residues.advance(state, laws)?;
    let mut values = BTreeMap::new();
    if wanted == Wanted::Everything {
        let predicted = laws.predicted(state);
        insert_predicted(&mut values, &predicted, &Joint::of(&predicted, laws.observation));
    }
    Ok(handed_out(values, eliminated, timing))
}

fn insert_predicted(values: &mut BTreeMap<Quantity, Fractions>, predicted: &State, joint: &Joint<'_>) {
    let [mean, covariance] = predicted.fractions();
    values.insert(Quantity::PredictedMean, mean);
    values.insert(Quantity::PredictedCovariance, covariance);
    if let Some([innovation, covariance]) = joint.innovation() {
        values.insert(Quantity::Innovation, innovation);
        values.insert(Quantity::InnovationCovariance, covariance);
    }
}

/// The values of the step, and the state with which the next one begins.
fn handed_out(mut values: BTreeMap<Quantity, Fractions>, eliminated: Eliminated, timing: Timing) -> Advanced {
    let Eliminated { filtered, departed, rank } = eliminated;
    let [mean, covariance] = filtered.fractions();
    values.insert(Quantity::FilteredMean, mean);
    values.insert(Quantity::FilteredCovariance, covariance);
    let next = match timing {
        Timing::Arriving => Some(filtered),
        Timing::Departing => departed,
    };
    (RationalStep { values, innovation_rank: rank }, next)
}

/// The reason why the elimination stopped, with its witness, in the words of the recursion.
fn reason(predicted: &State, step: &Step<Rational>, timing: Timing) -> StopReason {
    match update(predicted.moments(), &Sensors::of(step), timing) {
        Err(reason) => reason.into(),
        Ok(_) => StopReason::NotSemidefinite,
    }
}
