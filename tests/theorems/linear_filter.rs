//! The Theorem of Chen, Kumar and van Schuppen, and that of Hilgert and Vila one step ahead, on scalar models of two readings, with
//! the hypotheses on the noise dropped one by one.
//!
//! The truth is the joint law of everything, conditioned once by a formula written here; the filter is told the second moments
//! that it asks for, and nothing of what it supposes away.

use exact_kalman::filter::filter;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Noise, Observation, System, Timing};
use exact_kalman::scalar::{Rational, ratio};
use proptest::collection::vec;
use proptest::prelude::*;

use super::models::{Q, scalar};
use super::search::{counterexample, holds_where, holds_without};

/// Arriving: x₁ = a x₀ + w₁, y₁ = x₁ + v₁, x₂ = a x₁ + w₂, y₂ = x₂ + v₂, of the sources (x₀, w₁, v₁, w₂, v₂).
/// Departing: y₀ = x₀ + v₀, x₁ = a x₀ + w, y₁ = x₁ + v₁, of the sources (x₀, w, v₀, v₁).
#[derive(Clone, Debug)]
struct Model {
    timing: Timing,
    a: i64,
    /// The sources are this matrix times independent standard ones.
    factor: Q,
}

/// Which covariances of sources may differ from zero, besides those of a transition and its own reading, which the filter knows.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Dropped {
    Nothing,
    /// The noise of the first reading shares a source with x₀.
    StartIsIndependent,
    /// The noise of the second reading shares a source with that of the first.
    NoiseIsWhite,
}

fn size(timing: Timing) -> usize {
    match timing {
        Timing::Arriving => 5,
        Timing::Departing => 4,
    }
}

/// The row of the noise of the second reading.
fn last(timing: Timing) -> usize {
    size(timing) - 1
}

fn models(timing: Timing, dropped: Dropped) -> impl Strategy<Value = Model> {
    let n = size(timing);
    // Row 1 is the noise of a transition, row 2 that of its reading.
    let allowed = move |row: usize, column: usize| {
        row == column
            || (row, column) == (2, 1)
            || ((row, column) == (4, 3))
            || (dropped == Dropped::StartIsIndependent && (row, column) == (2, 0))
            || (dropped == Dropped::NoiseIsWhite && (row, column) == (last(timing), 2))
    };
    (-2_i64..3, vec(-2_i64..3, n * n)).prop_map(move |(a, entries)| {
        let entry = |i: usize, j: usize| if allowed(i, j) { entries[n * i + j] } else { 0 };
        Model { timing, a, factor: Matrix::from_fn(n, n, |i, j| ratio(entry(i, j), 1)) }
    })
}

/// The mean and the variance of the last state given the first reading, and given both.
type Laws = [(Rational, Rational); 2];

impl Model {
    fn covariance(&self) -> Q {
        &self.factor * self.factor.transpose()
    }

    /// From the joint law of the last state and both readings, where their covariance is regular.
    fn truth(&self, y: [i64; 2]) -> Option<Laws> {
        let a = self.a;
        let image = match self.timing {
            Timing::Arriving => Matrix::from_integers(&[[a * a, a, 0, 1, 0], [a, 1, 1, 0, 0], [a * a, a, 0, 1, 1]]),
            Timing::Departing => Matrix::from_integers(&[[a, 1, 0, 0], [1, 0, 1, 0], [a, 1, 0, 1]]),
        };
        let joint: Q = Matrix::congruence(&image, &self.covariance());
        let given = |count: usize| {
            let weights = joint.block(0..1, 1..1 + count) * joint.block(1..1 + count, 1..1 + count).inverse().ok()?;
            let data = Matrix::column(y[..count].iter().map(|&y| ratio(y, 1)).collect());
            let explained = &weights * joint.block(1..1 + count, 0..1);
            Some(((weights * data)[(0, 0)].clone(), &joint[(0, 0)] - &explained[(0, 0)]))
        };
        Some([given(1)?, given(2)?])
    }

    /// The same by the filter, which is told P₀, Q, R and the covariances of a transition and its reading; nothing if it refuses.
    fn filtered(&self, y: [i64; 2]) -> Option<Laws> {
        let all = self.covariance();
        let entry = |i: usize, j: usize| scalar(all[(i, j)].clone());
        let zero = || scalar(ratio(0, 1));
        // No transition departs after the last reading.
        let (before, process, cross, observation) = match self.timing {
            Timing::Arriving => {
                (Before::Transition, [entry(1, 1), entry(3, 3)], [entry(1, 2), entry(3, 4)], [entry(2, 2), entry(4, 4)])
            }
            Timing::Departing => {
                (Before::Observation, [entry(1, 1), zero()], [entry(1, 2), zero()], [entry(2, 2), entry(3, 3)])
            }
        };
        let system = System {
            timing: self.timing,
            initial: Initial::new(before, zero(), entry(0, 0)),
            transition: scalar(ratio(self.a, 1)).into(),
            observation: scalar(ratio(1, 1)).into(),
            noise: Noise::Covariances {
                process: Coefficient::per_step(process),
                cross: Some(Coefficient::per_step(cross)),
                observation: Coefficient::per_step(observation),
            },
            input: None,
            observation_input: None,
        };
        let data = y.map(|value| Observation::complete([ratio(value, 1)]));
        let trace = filter(&system.realised(&data).expect("the second moments of a model")).ok()?;
        let record = trace.records.last().expect("two readings");
        let of =
            |law: &exact_kalman::trace::Moments<Rational>| (law.mean[(0, 0)].clone(), law.covariance[(0, 0)].clone());
        Some([of(&record.predicted), of(&record.filtered)])
    }
}

/// Any readings are possible.
fn is_regular(model: &Model) -> bool {
    model.truth([0, 0]).is_some()
}

fn is_right(model: &Model) -> bool {
    [[1, 0], [0, 1], [3, -2]].iter().all(|&y| model.filtered(y) == model.truth(y))
}

/// CKS-T, HV-T1: with white noise and a start independent of it the filter has the law of the state given the readings, and the
/// law one step ahead, in both timings.
#[test]
fn the_filter_has_the_conditional_law() {
    for timing in [Timing::Arriving, Timing::Departing] {
        holds_where(models(timing, Dropped::Nothing), is_regular, is_right);
    }
}

/// CKS-T, HV-T1: without white noise, and without a start that is independent of it, the filter answers, and is wrong.
#[test]
fn the_filter_needs_white_noise_and_an_independent_start() {
    for timing in [Timing::Arriving, Timing::Departing] {
        for (dropped, row, column) in [(Dropped::StartIsIndependent, 2, 0), (Dropped::NoiseIsWhite, last(timing), 2)] {
            let model = counterexample(models(timing, dropped), |model| !is_regular(model) || is_right(model));
            assert_ne!(model.factor[(row, column)], ratio(0, 1), "{model:?}");
            assert!(model.filtered([0, 1]).is_some(), "{model:?}");
        }
    }
}

/// X on atoms, a noise on atoms; one reading y = X + v.
type Atoms = (Vec<i64>, Vec<i64>);

fn atoms() -> impl Strategy<Value = Atoms> {
    let symmetric = || vec(0_i64..4, 1..3).prop_map(|half| half.iter().flat_map(|&x| [x, -x]).collect::<Vec<_>>());
    (symmetric(), symmetric())
}

/// E(X | y) by enumeration against what one step says for the second moments.
fn is_best((states, noises): &Atoms) -> bool {
    let variance = |atoms: &[i64]| ratio(atoms.iter().map(|x| x * x).sum(), i64::try_from(atoms.len()).expect("few"));
    let (p, r) = (variance(states), variance(noises));
    let sum = &p + &r;
    if sum == ratio(0, 1) {
        return true;
    }
    let gain = p / sum;
    states.iter().flat_map(|x| noises.iter().map(move |v| x + v)).all(|y| {
        let explaining: Vec<i64> = states.iter().copied().filter(|x| noises.contains(&(y - x))).collect();
        let weight = |x: i64| i64::try_from(noises.iter().filter(|&&v| v == y - x).count()).expect("few");
        let mass: i64 = explaining.iter().map(|&x| weight(x)).sum();
        ratio(explaining.iter().map(|&x| x * weight(x)).sum(), mass) == &gain * ratio(y, 1)
    })
}

/// CKS-T, CKS-L1, CKS-L3i: without normality the same equations do not give the conditional mean, and with normality they do,
/// whatever the two variances.
#[test]
fn the_conditional_mean_needs_normality() {
    let (states, noises) = counterexample(atoms(), is_best);
    // Either variance zero would leave nothing to estimate, or nothing to estimate it by.
    assert!(states.iter().any(|&x| x != 0) && noises.iter().any(|&v| v != 0), "{states:?}, {noises:?}");
    holds_without((0_i64..9, 1_i64..9), |&(p, r)| {
        let factor = Matrix::diagonal(&[p, 0, r, 1].map(|deviation| ratio(deviation, 1)));
        is_right(&Model { timing: Timing::Departing, a: 1, factor })
    });
}
