//! The law of P(k) over all paths of a process.

use std::cmp::Ordering;

use super::ModeProcess;
use crate::matrix::{LdlError, Matrix, Shape};
use crate::scalar::OrderedField;

/// One value of P(k), and how likely it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CovarianceState<S> {
    /// P(k), d×d.
    pub covariance: Matrix<S>,
    /// The probability of all paths that lead here.
    pub probability: S,
    /// One of these paths, the first in lexicographic order: k modes.
    pub path: Vec<usize>,
    /// Which of the different laws of the next mode holds here.
    next_law: usize,
}

/// The law of P(k) from a known P(0), step by step.
///
/// Two paths are one state if they give the same P(k) and leave the next mode the same law: nothing later can tell them
/// apart, so merging them is exact. Among the modes of an independent process all laws are the same.
///
/// Cost: one step costs (number of states)·(modes that can follow) steps of WG-1 and the sorting of the results. The number of
/// states is at most multiplied by the number of modes at each step, and the digits of a state grow with every step; a
/// limit on the number of states is part of the question. Example 1.1 never merges: 4096 states after 12 steps, in 0.2 s
/// altogether. The sums cost more than the law in the end, as they hold the denominators of all states: E P(12) has 10⁵ bits and
/// takes 0.1 s, E P(15) has 10⁶ and takes 7 s.
///
/// # Examples
///
/// Example 1.1 with f = 3/2, where one observation of four is lost:
///
/// ```
/// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}, stability::{CovarianceLaw, Mode, ModeProcess}};
///
/// let scalar = |value| Matrix::<Rational>::diagonal(&[value]);
/// let mode = |h| Mode::new(scalar(ratio(3, 2)), scalar(ratio(h, 1)), scalar(ratio(1, 1)), scalar(ratio(1, 1)));
/// let link = ModeProcess::independent(vec![mode(0)?, mode(1)?], vec![ratio(1, 4), ratio(3, 4)])?;
/// let mut law = CovarianceLaw::start(&link, scalar(ratio(0, 1)), 1000)?;
/// law.advance()?;
/// law.advance()?;
/// // 9/4·(1/4 + 3/8) + 1
/// assert_eq!(law.mean(), scalar(ratio(77, 32)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct CovarianceLaw<'p, S> {
    process: &'p ModeProcess<S>,
    limit: usize,
    time: usize,
    states: Vec<CovarianceState<S>>,
    /// The different laws of a next mode: modes of positive probability only.
    laws: Vec<Vec<(usize, S)>>,
    /// Which of them holds after each mode.
    law_after: Vec<usize>,
}

/// Why a matrix is no P(0).
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StartError<S> {
    /// It has the wrong shape.
    #[error("the covariance of the start is {found}, where {expected} is needed")]
    Shape {
        /// d×d.
        expected: Shape,
        /// Its shape.
        found: Shape,
    },
    /// It is no covariance.
    #[error("the covariance of the start: {0}")]
    NotSemidefinite(LdlError<S>),
}

/// P(k) takes more values than allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("P({time}) takes more than {limit} values; the law is that of P({}) still", time - 1)]
pub struct TooManyStates {
    /// k.
    pub time: usize,
    /// The number that is allowed.
    pub limit: usize,
}

impl<'p, S: OrderedField> CovarianceLaw<'p, S> {
    /// The law at time 0, where P(0) is `start` for certain. No later law will have more than `limit` states.
    ///
    /// # Errors
    ///
    /// [`StartError`] if P(0) is not d×d or no covariance.
    pub fn start(process: &'p ModeProcess<S>, start: Matrix<S>, limit: usize) -> Result<Self, StartError<S>> {
        let (found, expected) = (start.shape(), Shape { rows: process.states(), columns: process.states() });
        if found != expected {
            return Err(StartError::Shape { expected, found });
        }
        start.ldl().map_err(StartError::NotSemidefinite)?;
        let mut laws: Vec<&[S]> = vec![process.initial()];
        let mut law_after = Vec::with_capacity(process.modes().len());
        for mode in 0..process.modes().len() {
            let law = process.transition().row(mode);
            let place = laws.iter().position(|known| *known == law).unwrap_or(laws.len());
            if place == laws.len() {
                laws.push(law);
            }
            law_after.push(place);
        }
        let states = vec![CovarianceState { covariance: start, probability: S::one(), path: Vec::new(), next_law: 0 }];
        Ok(Self { process, limit, time: 0, states, laws: laws.into_iter().map(positive).collect(), law_after })
    }

    /// The law one step later.
    ///
    /// # Errors
    ///
    /// [`TooManyStates`]; the law stays that of the last step then.
    pub fn advance(&mut self) -> Result<(), TooManyStates> {
        let mut next: Vec<CovarianceState<S>> = Vec::new();
        for state in &self.states {
            for (mode, probability) in &self.laws[state.next_law] {
                next.push(self.after(state, *mode, probability));
            }
        }
        let next = merged(next);
        if next.len() > self.limit {
            return Err(TooManyStates { time: self.time + 1, limit: self.limit });
        }
        self.states = next;
        self.time += 1;
        Ok(())
    }

    fn after(&self, state: &CovarianceState<S>, mode: usize, probability: &S) -> CovarianceState<S> {
        CovarianceState {
            covariance: self.process.modes()[mode].step(&state.covariance).next,
            probability: state.probability.times(probability),
            path: state.path.iter().copied().chain([mode]).collect(),
            next_law: self.law_after[mode],
        }
    }

    /// k.
    pub fn time(&self) -> usize {
        self.time
    }

    /// The states, with positive probabilities that add up to one. The same P(k) occurs twice where the next mode has different
    /// laws.
    pub fn states(&self) -> &[CovarianceState<S>] {
        &self.states
    }

    /// The mean of any function of P(k).
    pub fn expectation(&self, of: impl Fn(&Matrix<S>) -> S) -> S {
        total(self.states.iter().map(|state| state.probability.times(&of(&state.covariance))).collect())
    }

    /// E P(k), entry by entry.
    pub fn mean(&self) -> Matrix<S> {
        self.mean_power(1)
    }

    /// E P(k)ˢ, a power of matrices; with s = 0 the identity.
    ///
    /// WG-D1.1: `{A(k)} is L_r-stable (r > 0) if sup_k E‖A(k)‖^r < ∞`
    ///
    /// The norm is irrational in general, but `‖P‖ˢ ≤ tr Pˢ ≤ d‖P‖ˢ`, as P ≥ 0: the trace of this matrix stays bounded exactly
    /// if P(k) is L_s-stable.
    pub fn mean_power(&self, exponent: u32) -> Matrix<S> {
        let d = self.process.states();
        let powers: Vec<Matrix<S>> =
            self.states.iter().map(|state| power(&state.covariance, exponent).scaled(&state.probability)).collect();
        Matrix::from_fn(d, d, |i, j| total(powers.iter().map(|power| power[(i, j)].clone()).collect()))
    }

    /// The state whose P(k) has the largest trace; among several the first.
    pub fn worst(&self) -> &CovarianceState<S> {
        // The last of several largest is taken, so they are turned round.
        let worst = self.states.iter().rev().max_by_key(|state| state.covariance.trace());
        worst.unwrap_or_else(|| unreachable!("probabilities add up to one"))
    }
}

fn positive<S: OrderedField>(law: &[S]) -> Vec<(usize, S)> {
    law.iter().cloned().enumerate().filter(|(_, probability)| *probability > S::zero()).collect()
}

fn order<S: OrderedField>(one: &CovarianceState<S>, other: &CovarianceState<S>) -> Ordering {
    let covariances = || one.covariance.entries().cmp(other.covariance.entries());
    one.next_law.cmp(&other.next_law).then_with(covariances)
}

fn merged<S: OrderedField>(mut states: Vec<CovarianceState<S>>) -> Vec<CovarianceState<S>> {
    states.sort_by(|one, other| order(one, other).then_with(|| one.path.cmp(&other.path)));
    states.dedup_by(|later, kept| {
        let same = order(later, kept) == Ordering::Equal;
        if same {
            kept.probability = kept.probability.plus(&later.probability);
        }
        same
    });
    states
}

fn power<S: OrderedField>(matrix: &Matrix<S>, exponent: u32) -> Matrix<S> {
    (0..exponent).fold(Matrix::identity(matrix.rows()), |power, _| power * matrix)
}

/// A sum by halves: its parts stay as short as can be.
fn total<S: OrderedField>(mut terms: Vec<S>) -> S {
    while terms.len() > 1 {
        terms =
            terms.chunks(2).map(|pair| pair.iter().skip(1).fold(pair[0].clone(), |sum, term| sum.plus(term))).collect();
    }
    terms.pop().unwrap_or_else(S::zero)
}
