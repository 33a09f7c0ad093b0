//! The exact values by a second route: the joint law of the initial state and all noises, conditioned.

use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Path, Timing};
use exact_kalman::scalar::Rational;
use exact_kalman::trace::{Quantity, Values};

/// An affine function of the sources: `matrix · z + offset`.
#[derive(Clone)]
struct Affine {
    matrix: Matrix<Rational>,
    offset: Matrix<Rational>,
}

impl Affine {
    /// `a · self + b`
    fn image(&self, a: &Matrix<Rational>, b: &Matrix<Rational>) -> Self {
        Self { matrix: a * &self.matrix, offset: a * &self.offset + b }
    }

    fn plus(&self, other: &Self) -> Self {
        Self { matrix: &self.matrix + &other.matrix, offset: &self.offset + &other.offset }
    }
}

/// The exact values of each step.
///
/// The sources z are the initial state and, for each step, the pair (process noise, observation noise) with its
/// joint covariance. Every state and observation is written as an affine function of z, without a recursion for
/// any moment; then the one joint law is conditioned.
pub(crate) fn values(path: &Path<Rational>) -> Vec<Values<Rational>> {
    let (n, m, steps) = (path.states(), path.sensors(), path.steps());
    let mut sources =
        Gaussian::new(path.initial().mean.clone(), path.initial().covariance.clone()).expect("a covariance");
    for step in steps {
        let (process, cross) = step.transition.as_ref().map_or_else(
            || (Matrix::zeros(n, n), Matrix::zeros(n, m)),
            |transition| (transition.noise.clone(), transition.cross_noise.clone()),
        );
        let joint = process.beside(&cross).above(&cross.transpose().beside(&step.observation_noise));
        sources = sources.joined(&Gaussian::new(Matrix::zeros(n + m, 1), joint).expect("a covariance"));
    }
    let dimension = sources.dimension();
    let source = |first: usize, count: usize| {
        let rows: Vec<usize> = (first..first + count).collect();
        Affine { matrix: Matrix::identity(dimension).select_rows(&rows), offset: Matrix::zeros(count, 1) }
    };
    let process_noise = |k: usize| source(n + k * (n + m), n);
    let observation_noise = |k: usize| source(n + k * (n + m) + n, m);

    let mut states: Vec<Affine> = Vec::new();
    let mut observations: Vec<Affine> = Vec::new();
    for (k, step) in steps.iter().enumerate() {
        let before = states.last().cloned().unwrap_or_else(|| source(0, n));
        let (leading, noise) = match path.timing() {
            Timing::Arriving => (step.transition.as_ref(), k),
            Timing::Departing if k == 0 => (None, 0),
            Timing::Departing => (steps[k - 1].transition.as_ref(), k - 1),
        };
        let state = match leading {
            Some(transition) => before.image(&transition.matrix, &transition.input).plus(&process_noise(noise)),
            None => before,
        };
        observations.push(state.image(&step.observation, &step.observation_input).plus(&observation_noise(k)));
        states.push(state);
    }
    (0..steps.len()).map(|k| at(k, path, &sources, &states[k], &observations)).collect()
}

/// The values of step k, from the joint law of (x_k, y_0, …, y_k).
fn at(
    k: usize,
    path: &Path<Rational>,
    sources: &Gaussian<Rational>,
    state: &Affine,
    observations: &[Affine],
) -> Values<Rational> {
    let n = path.states();
    let mut all = state.clone();
    let mut readings = Matrix::zeros(0, 1);
    let mut past = 0;
    for (j, step) in path.steps().iter().enumerate().take(k + 1) {
        let present = step.reading.present();
        if j == k {
            past = readings.rows();
        }
        all.matrix = all.matrix.above(&observations[j].matrix.select_rows(&present));
        all.offset = all.offset.above(&observations[j].offset.select_rows(&present));
        readings = readings.above(&step.reading.values());
    }
    let joint = sources.affine(&all.matrix, &all.offset);
    let places = |range: std::ops::Range<usize>| range.map(|i| n + i).collect::<Vec<_>>();

    let mut values = Values::new();
    let filtered = joint.conditioned(&places(0..readings.rows()), &readings).expect("data that are possible").law;
    values.insert(Quantity::FilteredMean, filtered.mean().clone());
    values.insert(Quantity::FilteredCovariance, filtered.covariance().clone());
    let before =
        joint.conditioned(&places(0..past), &readings.block(0..past, 0..1)).expect("data that are possible").law;
    let state: Vec<usize> = (0..n).collect();
    let predicted = before.marginal(&state);
    values.insert(Quantity::PredictedMean, predicted.mean().clone());
    values.insert(Quantity::PredictedCovariance, predicted.covariance().clone());
    if readings.rows() > past {
        let last = readings.block(past..readings.rows(), 0..1);
        let update = before.conditioned(&places(0..last.rows()), &last).expect("data that are possible");
        values.insert(Quantity::Innovation, update.innovation);
        values.insert(Quantity::InnovationCovariance, update.innovation_covariance);
        values.insert(Quantity::Gain, update.gain);
    }
    values
}
