//! The filter on numbers of 512 bits, right or with one fault.

use super::fault::Fault;
use super::inverse::{Inverse, Ranks};
use super::real::{Real, rationals, reals};
use crate::filter::Records;
use crate::matrix::Matrix;
use crate::model::{Before, Path, Step, Timing, Transition};
use crate::scalar::{Rational, Scalar};
use crate::trace::{Quantity, Record, Values};

/// The answers of a filter, step by step. It ends where it has none.
///
/// A diffuse start is exact until it is resolved.
pub(super) struct Recursion<'a> {
    path: &'a Path<Rational>,
    fault: &'a Fault,
    done: usize,
    /// While the start is diffuse.
    diffuse: Option<Records<'a, Rational>>,
    /// The law of the state that the next step observes.
    predicted: Option<Law>,
    ranks: Ranks,
    /// The filtered mean of the step before.
    before: Option<Matrix<Real>>,
    /// The gain of the first step, where it is kept.
    first_gain: Option<Matrix<Real>>,
    /// Whether the predicted covariance is kept.
    rests: bool,
    /// What else is kept.
    kept: Option<Kept>,
}

/// What is kept of a step where all rests.
struct Kept {
    innovation_covariance: Matrix<Real>,
    inverse: Matrix<Real>,
    filtered_covariance: Matrix<Real>,
    predicted_covariance: Matrix<Real>,
}

#[derive(Clone)]
struct Law {
    mean: Matrix<Real>,
    covariance: Matrix<Real>,
}

/// An observation, and what it says.
struct Seen {
    observed: Vec<usize>,
    matrix: Matrix<Real>,
    noise: Matrix<Real>,
    cross: Matrix<Real>,
    innovation: Matrix<Real>,
    innovation_covariance: Matrix<Real>,
}

/// The longest denominators that are carried while a start is diffuse.
const LONGEST: u64 = 1 << 14;

impl<'a> Recursion<'a> {
    /// The recursion along a path. There is none with a fault where noise is shared or the start is diffuse: what a
    /// wrong line does there is not one thing.
    pub(super) fn new(path: &'a Path<Rational>, fault: &'a Fault) -> Option<Self> {
        let initial = path.initial();
        let diffuse = initial.diffuse.as_ref().is_some_and(|part| !part.is_zero());
        let shares = |step: &Step<Rational>| step.transition.as_ref().is_some_and(|t| !t.cross_noise.is_zero());
        if !matches!(fault, Fault::None) && (diffuse || path.steps().iter().any(shares)) {
            return None;
        }
        if fault.is_silent(path) {
            return None;
        }
        let first = path.steps().first()?;
        let law = Law { mean: reals(&initial.mean), covariance: reals(&initial.covariance) };
        let predicted = match (initial.before, &first.transition) {
            (Before::Transition, Some(transition)) => moved(&law, transition, fault),
            _ => law,
        };
        Some(Self {
            path,
            fault,
            done: 0,
            diffuse: diffuse.then(|| Records::new(path)),
            predicted: Some(predicted),
            ranks: Ranks::new(path.sensors()),
            before: None,
            first_gain: None,
            rests: false,
            kept: None,
        })
    }

    fn by_records(&mut self) -> Option<Values<Rational>> {
        let record = self.diffuse.as_mut()?.next()?.ok()?;
        if record.denominator_bits() > LONGEST {
            return None;
        }
        if record.predicted.diffuse.is_some() {
            self.done += 1;
            return Some(without_gain(&record));
        }
        let law = &record.predicted;
        self.predicted = Some(Law { mean: reals(&law.mean), covariance: reals(&law.covariance) });
        self.diffuse = None;
        self.by_recursion()
    }

    fn by_recursion(&mut self) -> Option<Values<Rational>> {
        let predicted = self.predicted.take()?;
        let step = self.path.steps().get(self.done)?;
        let mut seen = self.seen(&predicted, step);
        let inverse = self.ranks.inverse(&seen.innovation_covariance, &seen.observed);
        let (mut gain, mut filtered) = self.updated(&predicted, &seen, &inverse, step);
        if let Some(kept) = &self.kept {
            gain = &seen.cross * &kept.inverse;
            filtered =
                Law { mean: &predicted.mean + &gain * &seen.innovation, covariance: kept.filtered_covariance.clone() };
            seen.innovation_covariance = kept.innovation_covariance.clone();
        }
        let mut values = Values::new();
        values.insert(Quantity::PredictedMean, rationals(&predicted.mean));
        values.insert(Quantity::PredictedCovariance, rationals(&predicted.covariance));
        values.insert(Quantity::FilteredMean, rationals(&filtered.mean));
        values.insert(Quantity::FilteredCovariance, rationals(&filtered.covariance));
        if !seen.observed.is_empty() {
            values.insert(Quantity::Innovation, rationals(&seen.innovation));
            values.insert(Quantity::InnovationCovariance, rationals(&seen.innovation_covariance));
        }
        self.done += 1;
        let next = self.next_law(&predicted, &filtered, &seen, &gain, &inverse, step);
        let rest = || Kept {
            innovation_covariance: seen.innovation_covariance.clone(),
            inverse: inverse.matrix().clone(),
            filtered_covariance: filtered.covariance.clone(),
            predicted_covariance: predicted.covariance.clone(),
        };
        self.predicted = next.map(|next| self.rested(next, &predicted, rest));
        self.before = Some(filtered.mean);
        Some(values)
    }

    fn seen(&self, predicted: &Law, step: &Step<Rational>) -> Seen {
        let observed = step.reading.present();
        let matrix = reals(&step.observation.select_rows(&observed));
        let noise = reals(&step.observation_noise.select(&observed, &observed));
        let mut cross = &predicted.covariance * matrix.transpose();
        let mut covariance = matrix.congruence(&predicted.covariance) + &noise;
        if let (Timing::Arriving, Some(transition)) = (self.path.timing(), &step.transition)
            && !transition.cross_noise.is_zero()
        {
            let shared = reals(&transition.cross_noise.select_columns(&observed));
            let mixed = &matrix * &shared;
            covariance = covariance + &mixed + mixed.transpose();
            cross = cross + shared;
        }
        let mean = match (self.fault, &self.before) {
            (Fault::InnovationOfTheStepBefore, Some(before)) => before,
            _ => &predicted.mean,
        };
        let offset = reals(&step.observation_input.select_rows(&observed));
        let innovation = reals(&step.reading.values()) - (&matrix * mean + offset);
        Seen { observed, matrix, noise, cross, innovation, innovation_covariance: covariance }
    }

    /// The gain, and the law given the observation.
    fn updated(
        &mut self,
        predicted: &Law,
        seen: &Seen,
        inverse: &Inverse,
        step: &Step<Rational>,
    ) -> (Matrix<Real>, Law) {
        let Law { mean, covariance: p } = predicted;
        let transition = || step.transition.as_ref().map(|transition| reals(&transition.matrix));
        let mut gain = match self.fault {
            Fault::GainWithoutNoise => {
                let without = &seen.innovation_covariance - &seen.noise;
                &seen.cross * self.ranks.inverse(&without, &seen.observed).matrix()
            }
            Fault::GainOfTheDiagonal => &seen.cross * inverse.of_diagonal(&seen.innovation_covariance),
            Fault::SmallVariancesIgnored(least) => {
                &seen.cross * inverse.of_those_above(&seen.innovation_covariance, least)
            }
            _ => &seen.cross * inverse.matrix(),
        };
        if matches!(self.fault, Fault::GainOfTheFirstStep) && !seen.observed.is_empty() {
            match &self.first_gain {
                Some(first) if first.columns() == gain.columns() => gain = first.clone(),
                Some(_) => {}
                None => self.first_gain = Some(gain.clone()),
            }
        }
        let n = mean.rows();
        let left = |gain: &Matrix<Real>| Matrix::identity(n) - gain * &seen.matrix;
        let move_of = |gain: &Matrix<Real>| gain * &seen.innovation;
        let ahead = transition().map(|a| a * &gain);
        let multiplied = &seen.cross * &seen.innovation_covariance;
        let used = match (self.fault, &ahead) {
            (Fault::GainWithoutInverse, _) => &multiplied,
            (Fault::PredictorGainForTheMean | Fault::PredictorGainForBoth, Some(ahead)) => ahead,
            _ => &gain,
        };
        let covariance = match self.fault {
            Fault::CovarianceNotUpdated => p.clone(),
            Fault::JosephWithoutNoise => left(&gain).congruence(p),
            Fault::JosephWithUnitNoise => left(&gain).congruence(p) + &gain * gain.transpose(),
            Fault::CovarianceUpdateAdds => p + gain.congruence(&seen.innovation_covariance),
            Fault::PredictorGainForBoth => left(used) * p,
            Fault::FilteredCovarianceRaised(by) => p - &gain * seen.cross.transpose() + Matrix::identity(n).scaled(by),
            _ => p - &gain * seen.cross.transpose(),
        };
        let mean = if matches!(self.fault, Fault::MeanNotUpdated) { mean.clone() } else { mean + move_of(used) };
        (gain, Law { mean, covariance })
    }

    /// The law of the state that the next step observes.
    fn next_law(
        &self,
        predicted: &Law,
        filtered: &Law,
        seen: &Seen,
        gain: &Matrix<Real>,
        inverse: &Inverse,
        step: &Step<Rational>,
    ) -> Option<Law> {
        if self.path.timing() == Timing::Arriving {
            let transition = self.path.steps().get(self.done)?.transition.as_ref()?;
            return Some(moved(filtered, transition, self.fault));
        }
        let transition = step.transition.as_ref()?;
        let mut next = moved(filtered, transition, self.fault);
        if matches!(self.fault, Fault::FilterGainInThePredictor) {
            next.mean =
                reals(&transition.matrix) * &predicted.mean + reals(&transition.input) + gain * &seen.innovation;
        }
        if !transition.cross_noise.is_zero() {
            // E of the transition's noise given the reading, which shares it.
            let shared = reals(&transition.cross_noise.select_columns(&seen.observed));
            let ahead = reals(&transition.matrix) * gain * shared.transpose();
            next.mean = next.mean + &shared * inverse.matrix() * &seen.innovation;
            next.covariance = next.covariance - &ahead - ahead.transpose() - shared.congruence(inverse.matrix());
        }
        Some(next)
    }

    /// The covariance of before, where it is kept.
    fn rested(&mut self, next: Law, before: &Law, rest: impl FnOnce() -> Kept) -> Law {
        if let Some(kept) = &self.kept {
            return Law { covariance: kept.predicted_covariance.clone(), ..next };
        }
        let change = || &next.covariance - &before.covariance;
        let is_less = |value: &Real, bound: &Real| value.minus(bound).value() < Rational::zero();
        self.rests |= match self.fault {
            Fault::CovarianceRests(tolerance) => {
                let bound = tolerance.times(tolerance);
                change().entries().iter().all(|entry| is_less(&entry.times(entry), &bound))
            }
            Fault::AllRest(bound) => {
                let squares = change().entries().iter().map(|entry| entry.times(entry)).reduce(|a, b| a.plus(&b));
                if self.done > 1 && squares.is_some_and(|sum| is_less(&sum, bound)) {
                    self.kept = Some(rest());
                }
                false
            }
            _ => false,
        };
        if self.rests { Law { covariance: before.covariance.clone(), ..next } } else { next }
    }
}

fn without_gain(record: &Record<Rational>) -> Values<Rational> {
    let mut values = record.values();
    values.remove(&Quantity::Gain);
    values
}

/// The law after a transition.
fn moved(law: &Law, transition: &Transition<Rational>, fault: &Fault) -> Law {
    let (a, q) = (reals(&transition.matrix), reals(&transition.noise));
    let (mean, p) = (&law.mean, &law.covariance);
    let mean = if matches!(fault, Fault::MeanNotMoved) { mean.clone() } else { &a * mean };
    let covariance = match fault {
        Fault::WithoutTranspose => &a * p * &a + q,
        Fault::OneSided => &a * p + q,
        Fault::NoiseThroughTransition => a.congruence(&(p + q)),
        Fault::CovarianceNotMoved => p + q,
        _ => a.congruence(p) + q,
    };
    Law { mean: mean + reals(&transition.input), covariance }
}

impl Iterator for Recursion<'_> {
    type Item = Values<Rational>;

    fn next(&mut self) -> Option<Values<Rational>> {
        if self.diffuse.is_some() { self.by_records() } else { self.by_recursion() }
    }
}
