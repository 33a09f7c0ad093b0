//! The joint Gaussian of everything, conditioned once: the second route to every number of the filter.

use super::FilterError;
use crate::gaussian::{ConditionError, Gaussian};
use crate::matrix::Matrix;
use crate::model::{Before, Path, PathAhead, Step, Timing, Transition};
use crate::scalar::Field;

/// The conditional laws of x_k without and with y_k.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OneShot<S> {
    /// x_k given y_0, …, y_{k−1}.
    pub predicted: Gaussian<S>,
    /// x_k given y_0, …, y_k.
    pub filtered: Gaussian<S>,
}

/// The conditional laws of all states by conditioning the joint Gaussian of the initial state and all noises.
///
/// Every x_k and y_k is an affine image of (x_0, w_1, …, w_T) (CKS-1a, CKS-1b); their joint law follows by CKS-L2i and is
/// conditioned by CKS-L3i, for each k on its own. Nothing recursive is involved. The cost grows with the third
/// power of T: this is for checking, not for use.
///
/// # Errors
///
/// [`FilterError`] with the step whose observations contradict each other, or whose pseudo-inverse does not exist
/// (`computed` is empty); at step 0 [`ConditionError::Diffuse`] for a diffuse start, which has no covariance.
pub fn one_shot<S: Field>(path: &Path<S>) -> Result<Vec<OneShot<S>>, FilterError<S>> {
    refuse_diffuse(path)?;
    let images = Images::of(path, &[]);
    let steps = 0..path.steps().len();
    steps
        .map(|k| {
            let laws =
                images.given(k, k).and_then(|predicted| Ok(OneShot { predicted, filtered: images.given(k, k + 1)? }));
            laws.map_err(|source| FilterError { step: k, source, computed: Vec::new() })
        })
        .collect()
}

/// The laws of the next d states given the first observations, each by conditioning the joint Gaussian once: entry j holds
/// those of x_j, …, x_{j+d−1} given y_0, …, y_{j−1}, as far as there are transitions.
///
/// # Errors
///
/// As for [`one_shot`].
pub fn one_shot_ahead<S: Field>(path: &PathAhead<S>) -> Result<Vec<Vec<Gaussian<S>>>, FilterError<S>> {
    refuse_diffuse(path.path())?;
    let images = Images::of(path.path(), path.beyond());
    let laws = (0..=path.path().steps().len()).map(|known| {
        let states = known..images.states.len().min(known.saturating_add(path.steps_ahead().get()));
        let laws = states.map(|k| images.given(k, known)).collect::<Result<_, _>>();
        laws.map_err(|source| FilterError { step: known.saturating_sub(1), source, computed: Vec::new() })
    });
    laws.collect()
}

fn refuse_diffuse<S: Field>(path: &Path<S>) -> Result<(), FilterError<S>> {
    if path.initial().diffuse.as_ref().is_some_and(|part| !part.is_zero()) {
        return Err(FilterError { step: 0, source: ConditionError::Diffuse, computed: Vec::new() });
    }
    Ok(())
}

/// An affine function of the sources (x_0, noises): `matrix · sources + offset`.
#[derive(Clone)]
struct Affine<S> {
    matrix: Matrix<S>,
    offset: Matrix<S>,
}

impl<S: Field> Affine<S> {
    /// `a · self + b`
    fn mapped(&self, a: &Matrix<S>, b: &Matrix<S>) -> Self {
        Self { matrix: a * &self.matrix, offset: a * &self.offset + b }
    }

    fn plus_source(&self, place: usize) -> Self {
        let mut sum = self.clone();
        for i in 0..sum.matrix.rows() {
            let entry = sum.matrix[(i, place + i)].plus(&S::one());
            sum.matrix[(i, place + i)] = entry;
        }
        sum
    }
}

/// States and observed entries as affine functions of the sources.
struct Images<S> {
    sources: Gaussian<S>,
    /// Those beyond the last observation included.
    states: Vec<Affine<S>>,
    readings: Vec<(Affine<S>, Matrix<S>)>,
}

impl<S: Field> Images<S> {
    fn of(path: &Path<S>, beyond: &[Transition<S>]) -> Self {
        let initial = path.initial();
        let (n, m) = (path.states(), path.sensors());
        let start = law(initial.mean.clone(), initial.covariance.clone());
        let sources = path.steps().iter().fold(start, |sources, step| sources.joined(&noise(step, n)));
        let unobserved = |transition: &Transition<S>| law(Matrix::zeros(n, 1), transition.noise.clone());
        let sources = beyond.iter().fold(sources, |sources, transition| sources.joined(&unobserved(transition)));
        // The sources of step k: first n for its transition, then m for its observation; beyond the last, n each.
        let last = path.steps().len();
        let place = |k: usize| n + k.min(last) * (n + m) + k.saturating_sub(last) * n;
        let total = sources.dimension();
        let start =
            Affine { matrix: Matrix::identity(n).beside(&Matrix::zeros(n, total - n)), offset: Matrix::zeros(n, 1) };
        let moved = |state: &Affine<S>, transition: &Transition<S>, k: usize| {
            state.mapped(&transition.matrix, &transition.input).plus_source(place(k))
        };
        let (mut states, mut readings, mut state) = (Vec::new(), Vec::new(), start);
        // Whether the path leads to a state beyond the last observed one.
        let mut ahead = false;
        for (k, step) in path.steps().iter().enumerate() {
            if let (Some(transition), Timing::Arriving) = (&step.transition, path.timing())
                && (k > 0 || initial.before == Before::Transition)
            {
                state = moved(&state, transition, k);
            }
            let observed = step.reading.present();
            let reading = state.mapped(&step.observation, &step.observation_input).plus_source(place(k) + n);
            let rows =
                Affine { matrix: reading.matrix.select_rows(&observed), offset: reading.offset.select_rows(&observed) };
            readings.push((rows, step.reading.values()));
            states.push(state.clone());
            if let (Some(transition), Timing::Departing) = (&step.transition, path.timing()) {
                state = moved(&state, transition, k);
                ahead = k + 1 == last;
            }
        }
        if ahead {
            states.push(state.clone());
        }
        for (k, transition) in (last..).zip(beyond) {
            state = moved(&state, transition, k);
            states.push(state.clone());
        }
        Self { sources, states, readings }
    }

    /// The law of x_k given the first `known` observations.
    fn given(&self, k: usize, known: usize) -> Result<Gaussian<S>, ConditionError<S>> {
        let state = &self.states[k];
        let (mut all, mut values) = (state.clone(), Matrix::zeros(0, 1));
        for (reading, value) in &self.readings[..known] {
            all.matrix = all.matrix.above(&reading.matrix);
            all.offset = all.offset.above(&reading.offset);
            values = values.above(value);
        }
        let n = state.matrix.rows();
        let observed: Vec<usize> = (n..n + values.rows()).collect();
        let joint = self.sources.affine(&all.matrix, &all.offset);
        Ok(joint.conditioned(&observed, &values)?.law)
    }
}

/// The joint law of the noises with the index of `step`, n for its transition and m for its observation.
fn noise<S: Field>(step: &Step<S>, n: usize) -> Gaussian<S> {
    let m = step.observation_noise.rows();
    let (process, cross) = match &step.transition {
        Some(transition) => (transition.noise.clone(), transition.cross_noise.clone()),
        None => (Matrix::zeros(n, n), Matrix::zeros(n, m)),
    };
    let covariance = process.beside(&cross).above(&cross.transpose().beside(&step.observation_noise));
    law(Matrix::zeros(n + m, 1), covariance)
}

/// A law whose moments a path has checked.
fn law<S: Field>(mean: Matrix<S>, covariance: Matrix<S>) -> Gaussian<S> {
    match Gaussian::new(mean, covariance) {
        Ok(law) => law,
        Err(error) => unreachable!("a path holds symmetric covariances, but {error}"),
    }
}
