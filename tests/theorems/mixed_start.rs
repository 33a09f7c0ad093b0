//! Theorem 1 of Sowers and Makowski for a start of atoms and scalar models of two readings, with its hypotheses on the noise dropped
//! one by one.
//!
//! The truth is the joint law of everything given ξ = z, conditioned once by a formula written here, and the likelihood of the
//! readings in it; the theorem is told the second moments that it asks for.

use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Noise, Observation, System, Timing};
use exact_kalman::nongaussian::{InitialLaw, statistics};
use exact_kalman::scalar::{Rational, ratio};
use proptest::collection::vec;
use proptest::prelude::*;

use super::models::{Q, scalar};
use super::search::{counterexample, holds_where};

/// X(0) = ξ, X(t+1) = a X(t) + W(t+1), Y(t) = h X(t) + V(t+1), of the sources (W(1), V(1), W(2), V(2)).
#[derive(Clone, Debug)]
struct Model {
    a: i64,
    h: i64,
    /// The sources are this matrix times independent standard ones, …
    factor: Q,
    /// … and so many times ξ in V(1).
    shared: i64,
    readings: [i64; 2],
}

/// The values of ξ.
const ATOMS: [i64; 3] = [0, 1, -2];

#[derive(Clone, Copy, PartialEq, Eq)]
enum Dropped {
    Nothing,
    /// V(1) contains a multiple of ξ.
    StartIsIndependent,
    /// V(2) shares a source with V(1).
    NoiseIsWhite,
}

fn models(dropped: Dropped) -> impl Strategy<Value = Model> {
    // Of one time the two noises may be correlated.
    let allowed = move |row: usize, column: usize| {
        row == column
            || matches!((row, column), (1, 0) | (3, 2))
            || (dropped == Dropped::NoiseIsWhite && (row, column) == (3, 1))
    };
    let shared = if dropped == Dropped::StartIsIndependent { -2_i64..3 } else { 0_i64..1 };
    (-2_i64..3, -2_i64..3, vec(-2_i64..3, 16), shared, [-3_i64..4, -3_i64..4]).prop_map(
        move |(a, h, entries, shared, readings)| {
            let entry = |i: usize, j: usize| if allowed(i, j) { entries[4 * i + j] } else { 0 };
            Model { a, h, factor: Matrix::from_fn(4, 4, |i, j| ratio(entry(i, j), 1)), shared, readings }
        },
    )
}

/// For each atom z: the mean and the variance of X(2) given the readings, and the logarithm of their likelihood, up to what is the
/// same for all.
type Laws = Vec<[Rational; 3]>;

/// The same with 0 for the first logarithm.
fn relative(mut laws: Laws) -> Laws {
    let first = laws[0][2].clone();
    for law in &mut laws {
        law[2] = &law[2] - &first;
    }
    laws
}

impl Model {
    fn covariance(&self) -> Q {
        &self.factor * self.factor.transpose()
    }

    /// X(2), Y(0) and Y(1) by rows: their coefficients of (ξ, W(1), V(1), W(2), V(2)).
    fn rows(&self) -> Q {
        let (a, h) = (self.a, self.h);
        Matrix::from_integers(&[[a * a, a, 0, 1, 0], [h, 0, 1, 0, 0], [h * a, h, 0, 0, 1]])
    }

    fn truth(&self) -> Option<Laws> {
        let rows = self.rows();
        let joint = rows.block(0..3, 1..5).congruence(&self.covariance());
        let inverse = joint.block(1..3, 1..3).inverse().ok()?;
        let gain = joint.block(0..1, 1..3) * &inverse;
        let variance = &joint[(0, 0)] - &(&gain * joint.block(1..3, 0..1))[(0, 0)];
        let data = Matrix::from_integers(&self.readings.map(|y| [y]));
        let law = |z: i64| {
            let mean: Q = &rows * Matrix::from_integers(&[[z], [0], [self.shared * z], [0], [0]]);
            let away = &data - mean.block(1..3, 0..1);
            let square = away.transpose().congruence(&inverse)[(0, 0)].clone();
            [&mean[(0, 0)] + &(&gain * away)[(0, 0)], variance.clone(), square * ratio(-1, 2)]
        };
        Some(relative(ATOMS.into_iter().map(law).collect()))
    }

    /// The same by the theorem; nothing where a reading has no noise.
    fn found(&self) -> Option<Laws> {
        let all = self.covariance();
        let entry = |i: usize, j: usize| scalar(all[(i, j)].clone());
        let zero = || scalar(ratio(0, 1));
        let system = System {
            timing: Timing::Departing,
            initial: Initial::new(Before::Observation, zero(), zero()),
            transition: scalar(ratio(self.a, 1)).into(),
            observation: scalar(ratio(self.h, 1)).into(),
            noise: Noise::Covariances {
                process: Coefficient::per_step([entry(0, 0), entry(2, 2)]),
                cross: Some(Coefficient::per_step([entry(0, 1), entry(2, 3)])),
                observation: Coefficient::per_step([entry(1, 1), entry(3, 3)]),
            },
            input: None,
            observation_input: None,
        };
        let data = self.readings.map(|value| Observation::complete([ratio(value, 1)]));
        let path = system.realised(&data).expect("the second moments of a model");
        let now = statistics(&path).ok()?.pop()?;
        let atoms = ATOMS.map(|z| (ratio(1, 3), scalar(ratio(z, 1))));
        let posterior = now.posterior(&InitialLaw::atoms(atoms).expect("a law"));
        let law = |part: &exact_kalman::nongaussian::PosteriorComponent<Rational>| {
            assert_eq!((&part.evidence.weight, &part.evidence.determinant), (&ratio(1, 3), &ratio(1, 1)));
            [part.state.mean()[(0, 0)].clone(), part.state.covariance()[(0, 0)].clone(), part.evidence.exponent.clone()]
        };
        Some(relative(posterior.components.iter().map(law).collect()))
    }
}

/// Every reading is noisy (SM-A2), and any two readings are possible.
fn is_noisy(model: &Model) -> bool {
    let all = model.covariance();
    all[(1, 1)] > ratio(0, 1) && all[(3, 3)] > ratio(0, 1) && model.truth().is_some()
}

fn is_right(model: &Model) -> bool {
    model.found() == model.truth()
}

/// SM-T1: for a start of atoms the theorem has the law of the state in each atom, and the odds of the atoms.
#[test]
fn the_theorem_has_the_conditional_law() {
    holds_where(models(Dropped::Nothing), is_noisy, is_right);
}

/// SM-T1: without white noise, and without a start that is independent of it, the theorem answers, and is wrong.
#[test]
fn the_theorem_needs_white_noise_and_an_independent_start() {
    for dropped in [Dropped::StartIsIndependent, Dropped::NoiseIsWhite] {
        let model = counterexample(models(dropped), |model| !is_noisy(model) || is_right(model));
        assert!(model.found().is_some(), "{model:?}");
        match dropped {
            Dropped::NoiseIsWhite => assert_ne!(model.factor[(3, 1)], ratio(0, 1), "{model:?}"),
            _ => assert_ne!(model.shared, 0, "{model:?}"),
        }
    }
}
