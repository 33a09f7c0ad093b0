//! One step in one form for both timings: what is read and where the state goes, as affine images of the state before.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::One;

use super::dyadics::{Dyadics, odd_denominator};
use super::packed::Packed;
use super::readings::Readings;
use crate::matrix::Matrix;
use crate::model::{Step, Timing, Transition};
use crate::scalar::Rational;

/// `z = A x + b + w` with cov(w) = Q and, with the noise of what is read, S.
#[derive(Clone, Debug)]
pub(super) struct Target {
    /// A, over e; nothing for the identity.
    pub(super) map: Option<Packed>,
    /// Q, over w.
    pub(super) noise: Packed,
    /// S, over w.
    pub(super) cross: Packed,
    /// Which exact input belongs to it.
    pub(super) input: Input,
}

/// Where b comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Input {
    None,
    Transition,
}

/// `y = H x + c + v` with cov(v) = R, and the targets that are wanted beside it. All that is not dyadic stands over odd integers:
/// maps over e, covariances over w = e² l.
#[derive(Clone, Debug)]
pub(super) struct Law {
    pub(super) odd: BigInt,
    pub(super) lift: BigInt,
    pub(super) noise_odd: BigInt,
    /// Which of the entries of a reading are used, and what the others are.
    pub(super) readings: Readings,
    /// H, over e; no rows where nothing is read.
    pub(super) observation: Packed,
    /// R, over w.
    pub(super) noise: Packed,
    /// The state before the reading, if it is not the one that is carried: with the map and the noise of the state given it.
    pub(super) predicted: Option<Target>,
    /// The state given the reading.
    pub(super) filtered: Target,
    /// The state after the departing transition, given the reading.
    pub(super) ahead: Option<Target>,
}

/// A matrix over an odd integer.
fn packed(matrix: &Matrix<Rational>, odd: &BigInt) -> Packed {
    Packed::from(&Dyadics::of(matrix, odd))
}

/// A target in fractions.
struct Exact {
    /// Nothing for the identity.
    map: Option<Matrix<Rational>>,
    noise: Matrix<Rational>,
    cross: Matrix<Rational>,
    input: Input,
}

/// What differs from step to step though the law does not: over one odd integer, a multiple of e.
#[derive(Clone, Debug)]
pub(super) struct Data {
    pub(super) odd: BigInt,
    /// o/e
    pub(super) lift: BigInt,
    /// y − c, and for the arriving timing − C b.
    pub(super) seen: Packed,
    /// b of the transition.
    pub(super) input: Option<Packed>,
}

impl Law {
    /// The law of a step; `arrives` if its transition leads to the state that is read and is still to be made.
    pub(super) fn of(step: &Step<Rational>, timing: Timing, arrives: bool) -> Self {
        let readings = Readings::of(step);
        let observed = &readings.kept;
        let c = step.observation.select_rows(observed);
        let r = step.observation_noise.select(observed, observed);
        let (n, m) = (c.columns(), observed.len());
        let shared = |transition: &Transition<Rational>| transition.cross_noise.select_columns(observed);
        let stays =
            |cross: Matrix<Rational>| Exact { map: None, noise: Matrix::zeros(n, n), cross, input: Input::None };
        let moves = |transition: &Transition<Rational>, cross: Matrix<Rational>| Exact {
            map: Some(transition.matrix.clone()),
            noise: transition.noise.clone(),
            cross,
            input: Input::Transition,
        };
        let law = match (&step.transition, timing) {
            (Some(transition), Timing::Arriving) if arrives => {
                let (q, s) = (&transition.noise, shared(transition));
                let cross = q * c.transpose() + &s;
                let mixed = &c * &s;
                let noise = r + c.congruence(q) + &mixed + mixed.transpose();
                let predicted = moves(transition, Matrix::zeros(n, m));
                Self::over(&(&c * &transition.matrix), &noise, Some(&predicted), &moves(transition, cross), None)
            }
            (Some(transition), Timing::Departing) => {
                let ahead = moves(transition, shared(transition));
                Self::over(&c, &r, None, &stays(Matrix::zeros(n, m)), Some(&ahead))
            }
            (transition, _) => {
                // The noise of y_0 may be shared with x_0 in the arriving timing.
                let cross = match transition {
                    Some(transition) if timing == Timing::Arriving => shared(transition),
                    _ => Matrix::zeros(n, m),
                };
                let mixed = &c * &cross;
                let noise = r + &mixed + mixed.transpose();
                Self::over(&c, &noise, None, &stays(cross), None)
            }
        };
        Self { readings, ..law }
    }

    /// A transition alone: nothing is read.
    pub(super) fn of_transition(transition: &Transition<Rational>) -> Self {
        let n = transition.matrix.rows();
        let moves = Exact {
            map: Some(transition.matrix.clone()),
            noise: transition.noise.clone(),
            cross: Matrix::zeros(n, 0),
            input: Input::Transition,
        };
        Self::over(&Matrix::zeros(0, transition.matrix.columns()), &Matrix::zeros(0, 0), None, &moves, None)
    }

    /// The input of a transition with this law.
    pub(super) fn input(&self, transition: &Transition<Rational>) -> Data {
        let odd = odd_denominator(self.odd.clone(), transition.input.entries());
        Data {
            seen: packed(&Matrix::zeros(0, 1), &odd),
            input: Some(packed(&transition.input, &odd)),
            lift: odd.div_floor(&self.odd),
            odd,
        }
    }

    fn over(
        observation: &Matrix<Rational>,
        noise: &Matrix<Rational>,
        predicted: Option<&Exact>,
        filtered: &Exact,
        ahead: Option<&Exact>,
    ) -> Self {
        let targets = || predicted.into_iter().chain([filtered]).chain(ahead);
        let maps = targets().filter_map(|target| target.map.as_ref()).chain([observation]);
        let odd = maps.fold(BigInt::one(), |odd, map| odd_denominator(odd, map.entries()));
        let square = &odd * &odd;
        let noises = targets().flat_map(|target| [&target.noise, &target.cross]).chain([noise]);
        let noise_odd = noises.fold(square.clone(), |odd, noise| odd_denominator(odd, noise.entries()));
        let target = |exact: &Exact| Target {
            map: exact.map.as_ref().map(|map| packed(map, &odd)),
            noise: packed(&exact.noise, &noise_odd).symmetric(),
            cross: packed(&exact.cross, &noise_odd),
            input: exact.input,
        };
        Self {
            observation: packed(observation, &odd),
            noise: packed(noise, &noise_odd).symmetric(),
            predicted: predicted.map(target),
            filtered: target(filtered),
            ahead: ahead.map(target),
            lift: &noise_odd / square,
            readings: Readings::default(),
            odd,
            noise_odd,
        }
    }

    /// The reading and the inputs of a step with this law.
    pub(super) fn data(&self, step: &Step<Rational>, arrives: bool) -> Data {
        let mut seen = self.readings.seen(step);
        let input = step.transition.as_ref().map(|transition| &transition.input);
        if let Some(input) = input.filter(|input| arrives && !input.is_zero()) {
            seen = seen - step.observation.select_rows(&self.readings.kept) * input;
        }
        let entries = seen.entries().iter().chain(input.into_iter().flat_map(Matrix::entries));
        let odd = odd_denominator(self.odd.clone(), entries);
        Data {
            seen: packed(&seen, &odd),
            input: input.map(|input| packed(input, &odd)),
            lift: odd.div_floor(&self.odd),
            odd,
        }
    }
}
