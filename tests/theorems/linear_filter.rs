//! The Theorem of Chen, Kumar and van Schuppen (and that of Hilgert and Vila one step ahead) on scalar models of two steps, with
//! its hypotheses on the noise dropped one by one.
//!
//! The truth is the joint law of everything, conditioned once by a formula written here; the filter is told the second moments
//! that it asks for, and nothing of what it supposes away.

use exact_kalman::filter::filter;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
use exact_kalman::scalar::{Rational, ratio};
use proptest::collection::vec;
use proptest::prelude::*;

use super::models::{Q, scalar};
use super::search::{counterexample, holds_without};

/// x₁ = a x₀ + w, y₀ = x₀ + v₀, y₁ = x₁ + v₁; sources (x₀, v₀, w, v₁) = L·(independent standard ones).
#[derive(Clone, Debug)]
struct Model {
    a: i64,
    /// Row by row: the factor of the covariance of (x₀, v₀, w, v₁).
    factor: Vec<i64>,
}

/// Which covariances of sources may differ from zero, besides cov(w, v₀), which the departing filter knows.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Dropped {
    Nothing,
    /// x₀ and v₀ share noise.
    StartIsIndependent,
    /// v₀ and v₁ share noise.
    NoiseIsWhite,
}

fn models(dropped: Dropped) -> impl Strategy<Value = Model> {
    (-2_i64..3, vec(-2_i64..3, 16)).prop_map(move |(a, mut factor)| {
        // Columns are the independent sources; these rows have which of them?
        let allowed = |row: usize, column: usize| match (row, column) {
            (0, 0) | (1, 1) | (2, 1 | 2) | (3, 3) => true,
            (1, 0) => dropped == Dropped::StartIsIndependent,
            (3, 1) => dropped == Dropped::NoiseIsWhite,
            _ => false,
        };
        for row in 0..4 {
            for column in 0..4 {
                if !allowed(row, column) {
                    factor[4 * row + column] = 0;
                }
            }
        }
        Model { a, factor }
    })
}

impl Model {
    fn covariance(&self) -> Q {
        let factor = Matrix::from_fn(4, 4, |i, j| ratio(self.factor[4 * i + j], 1));
        &factor * factor.transpose()
    }

    /// var(x₁ | y₀, y₁) and the weights of y₀ and y₁ in its mean, from the joint law of (x₁, y₀, y₁).
    fn truth(&self) -> Option<(Rational, Q)> {
        let a = self.a;
        let image = Matrix::<Rational>::from_integers(&[[a, 0, 1, 0], [1, 1, 0, 0], [a, 0, 1, 1]]);
        let joint = image.congruence(&self.covariance());
        let weights = joint.block(0..1, 1..3) * joint.block(1..3, 1..3).inverse().ok()?;
        let explained = (&weights * joint.block(1..3, 0..1))[(0, 0)].clone();
        Some((&joint[(0, 0)] - explained, weights))
    }

    /// The same by the filter, which is told P₀, Q, R and cov(w, v₀), and sees y = (y₀, y₁).
    fn filtered(&self, y: [i64; 2]) -> Option<(Rational, Rational)> {
        let all = self.covariance();
        let entry = |i: usize, j: usize| scalar(all[(i, j)].clone());
        let per_step = |values: [Q; 2]| exact_kalman::model::Coefficient::per_step(values);
        let system = System {
            timing: Timing::Departing,
            initial: Initial::new(Before::Observation, scalar(ratio(0, 1)), entry(0, 0)),
            transition: scalar(ratio(self.a, 1)).into(),
            observation: scalar(ratio(1, 1)).into(),
            noise: Noise::Covariances {
                process: per_step([entry(2, 2), scalar(ratio(0, 1))]),
                cross: Some(per_step([entry(2, 1), scalar(ratio(0, 1))])),
                observation: per_step([entry(1, 1), entry(3, 3)]),
            },
            input: None,
            observation_input: None,
        };
        let data = y.map(|value| Observation::complete([ratio(value, 1)]));
        let trace = filter(&system.realised(&data).ok()?).ok()?;
        let last = &trace.records.last()?.filtered;
        Some((last.covariance[(0, 0)].clone(), last.mean[(0, 0)].clone()))
    }
}

fn is_right(model: &Model) -> bool {
    let Some((variance, weights)) = model.truth() else { return true };
    [[1, 0], [0, 1], [3, -2]].iter().all(|&y| {
        let Some((found, mean)) = model.filtered(y) else { return true };
        let expected = (&weights * Matrix::from_integers(&[[y[0]], [y[1]]]))[(0, 0)].clone();
        found == variance && mean == expected
    })
}

proptest! {
    /// CKS-T, HV-T1: with white noise and a start independent of it the filter has the law given the data.
    #[test]
    fn the_filter_has_the_conditional_law(model in models(Dropped::Nothing)) {
        prop_assert!(is_right(&model));
    }
}

/// CKS-T, HV-T1: without white noise, and without a start that is independent of it, the filter is wrong.
#[test]
fn the_filter_needs_white_noise_and_an_independent_start() {
    for (dropped, row, column) in [(Dropped::StartIsIndependent, 1, 0), (Dropped::NoiseIsWhite, 3, 1)] {
        let model = counterexample(models(dropped), is_right);
        assert_ne!(model.factor[4 * row + column], 0, "{model:?}");
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

/// CKS-T: without normality the same equations do not give the conditional mean, and with normality they do, whatever the
/// two variances.
#[test]
fn the_conditional_mean_needs_normality() {
    let (states, noises) = counterexample(atoms(), is_best);
    assert!(states.len() * noises.len() > 1);
    holds_without((0_i64..9, 1_i64..9), |&(p, r)| {
        let model = Model { a: 1, factor: vec![p, 0, 0, 0, 0, r, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1] };
        is_right(&model)
    });
}
