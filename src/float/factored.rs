//! The walk of all forms that carry factors of P.
//!
//! With `P = W Λ Wᵀ` and the noise of a step as `w = D ω`, `v = F ω`, the state, the reading and the next state are linear in
//! independent sources with the weights Λ and those of ω. One row for each of them is the *array*:
//!
//! ```text
//! readings    C W   F          arriving: x = A x₋ + w is seen, so W stands for (A W₋  D), and F for (0  F)
//! state       W     0
//! ahead       A W   D          departing only
//! ```
//!
//! Cross noise is there because D and F share columns; no product of covariances is formed, and nothing is inverted. A form is a
//! way to make the other rows orthogonal to those of the readings, and one to have at most n columns again. Numbers of
//! the array that are nothing but rounding are set to zero where they arise ([`rank`](super::rank)).

use nalgebra::{DMatrix, DVector};

use super::error::Obstacle;
use super::factor::Factor;
use super::moments::Moments;
use super::observed::Observed;
use super::rank::{product, product_of_terms};
use super::recursion::{Recursion, Update};
use super::transition::{Departure, Transition};

/// A way to reduce the array.
pub(super) trait Reduction {
    /// The name: words, joined by hyphens.
    const NAME: &'static str;
    /// What it does, in one line.
    const DESCRIPTION: &'static str;

    /// The same covariance with at most n columns.
    fn compressed(factor: Factor) -> Result<Factor, Obstacle>;

    /// What the readings say of the other rows.
    fn conditioned(stage: &Stage<'_>, innovation: &DVector<f64>) -> Result<Conditioned, Obstacle>;
}

/// What a reading is made of, in common sources.
pub(super) struct Stage<'a> {
    /// W, n×k.
    pub(super) state: DMatrix<f64>,
    /// F, m×k.
    pub(super) noise: DMatrix<f64>,
    /// D, n×k, if a transition departs.
    pub(super) process: Option<DMatrix<f64>>,
    /// The weights of the k sources.
    pub(super) weights: DVector<f64>,
    /// C, m×n.
    pub(super) observation: &'a DMatrix<f64>,
    /// A, n×n; used if a transition departs.
    pub(super) transition: &'a DMatrix<f64>,
}

impl Stage<'_> {
    /// `C W + F`, in one product, so that what cancels between the two is seen to cancel; and the terms of each entry.
    pub(super) fn readings(&self) -> (DMatrix<f64>, DMatrix<f64>) {
        sum_of_image(self.observation, &self.state, &self.noise)
    }

    /// W above `A W + D`, for any W and D, and the terms of each entry.
    pub(super) fn others(&self, state: &DMatrix<f64>, process: Option<&DMatrix<f64>>) -> (DMatrix<f64>, DMatrix<f64>) {
        let Some(process) = process else { return (state.clone(), state.abs()) };
        let (ahead, terms) = sum_of_image(self.transition, state, process);
        (stacked(state, &ahead), stacked(&state.abs(), &terms))
    }
}

/// `a x + y`, entries that are nothing but rounding set to zero, and the terms of each entry.
fn sum_of_image(a: &DMatrix<f64>, x: &DMatrix<f64>, y: &DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
    product_of_terms(&side_by_side(a, &DMatrix::identity(y.nrows(), y.nrows())), &stacked(x, y))
}

/// The other rows given the readings.
pub(super) struct Conditioned {
    /// What is left of them, up to columns that are zero.
    pub(super) rest: Factor,
    /// What is added to their means.
    pub(super) correction: DVector<f64>,
    /// Their gain, if S is regular.
    pub(super) gain: Option<DMatrix<f64>>,
}

/// The belief of the form `R`.
#[derive(Clone, Debug)]
pub(super) struct Belief {
    mean: DVector<f64>,
    factor: Factor,
    /// F in the columns of the factor, where the reading that follows shares noise with the state.
    noise: Option<DMatrix<f64>>,
}

/// The recursion on factors that are reduced by `R`.
pub(super) struct Factored<R>(std::marker::PhantomData<R>);

impl<R: Reduction> Recursion for Factored<R> {
    const NAME: &'static str = R::NAME;
    const DESCRIPTION: &'static str = R::DESCRIPTION;
    type Belief = Belief;

    fn start(moments: Moments) -> Result<Belief, Obstacle> {
        let factor = R::compressed(Factor::of(&moments.covariance)?)?;
        Ok(Belief { mean: moments.mean, factor, noise: None })
    }

    fn moments(belief: &Belief) -> Result<Moments, Obstacle> {
        Ok(Moments { mean: belief.mean.clone(), covariance: belief.factor.covariance() })
    }

    fn predicted(belief: &Belief, transition: &Transition) -> Result<Belief, Obstacle> {
        let Transition { matrix: a, input, noise: q } = transition;
        let moved = Factor { rows: product(a, &belief.factor.rows), weights: belief.factor.weights.clone() };
        let factor = R::compressed(beside(&moved, &Factor::of(q)?))?;
        Ok(Belief { mean: a * &belief.mean + input, factor, noise: None })
    }

    /// The columns are kept as they are, since those of the noise belong to the reading too.
    fn arrived(belief: &Belief, transition: &Transition, observed: &Observed) -> Result<Belief, Obstacle> {
        let Transition { matrix: a, input, noise: q } = transition;
        let (process, noise) = joint_noise(q, &observed.state_noise, &observed.noise)?;
        let moved = Factor { rows: product(a, &belief.factor.rows), weights: belief.factor.weights.clone() };
        let noise = beside_zeros(moved.weights.len(), &noise);
        Ok(Belief { mean: a * &belief.mean + input, factor: beside(&moved, &process), noise: Some(noise) })
    }

    fn updated(
        belief: &Belief,
        observed: &Observed,
        departure: Option<&Departure<'_>>,
    ) -> Result<Update<Belief>, Obstacle> {
        let Belief { mean, factor, noise } = belief;
        let n = mean.len();
        let (own, transition) =
            (factor.rank(), departure.map_or(&observed.matrix, |departure| &departure.transition.matrix));
        let (state, process, noise) = match (noise, departure) {
            (Some(noise), _) => (factor.clone(), None, noise.clone()),
            (None, Some(Departure { transition, cross_noise })) => {
                let (process, noise) = joint_noise(&transition.noise, cross_noise, &observed.noise)?;
                let state = beside_zero_rows(factor, &process.weights);
                (state, Some(beside_zeros(own, &process.rows)), beside_zeros(own, &noise))
            }
            (None, None) => {
                let noise = Factor::of(&observed.noise)?;
                (beside_zero_rows(factor, &noise.weights), None, beside_zeros(own, &noise.rows))
            }
        };
        let Factor { rows: state, weights } = state;
        let stage = Stage { state, noise, process, weights, observation: &observed.matrix, transition };
        let innovation = &observed.value - &observed.matrix * mean;
        let innovation_covariance = Factor { rows: stage.readings().0, weights: stage.weights.clone() }.covariance();
        let Conditioned { rest, correction, gain } = R::conditioned(&stage, &innovation)?;
        let mut means = mean.clone();
        if let Some(Departure { transition, .. }) = departure {
            let ahead = &transition.matrix * mean + &transition.input;
            means = DVector::from_iterator(2 * n, means.iter().chain(&ahead).copied());
        }
        let means = means + correction;
        let belief = |first: usize| {
            let rows = rest.rows.rows(first, n).into_owned();
            let factor = R::compressed(Factor { rows, weights: rest.weights.clone() })?;
            Ok(Belief { mean: means.rows(first, n).into_owned(), factor, noise: None })
        };
        Ok(Update {
            innovation,
            innovation_covariance,
            gain: gain.map(|gain| gain.rows(0, n).into_owned()),
            filtered: belief(0)?,
            ahead: departure.map(|_| belief(n)).transpose()?,
        })
    }
}

/// D and F in common columns, from `(Q M; Mᵀ R)`.
fn joint_noise(q: &DMatrix<f64>, cross: &DMatrix<f64>, r: &DMatrix<f64>) -> Result<(Factor, DMatrix<f64>), Obstacle> {
    let (n, m) = cross.shape();
    let joint = stacked(&side_by_side(q, cross), &side_by_side(&cross.transpose(), r));
    let Factor { rows, weights } = Factor::of(&joint)?;
    Ok((Factor { rows: rows.rows(0, n).into_owned(), weights }, rows.rows(n, m).into_owned()))
}

fn side_by_side(left: &DMatrix<f64>, right: &DMatrix<f64>) -> DMatrix<f64> {
    let columns = left.ncols();
    DMatrix::from_fn(left.nrows(), columns + right.ncols(), |i, j| {
        if j < columns { left[(i, j)] } else { right[(i, j - columns)] }
    })
}

pub(super) fn stacked(above: &DMatrix<f64>, below: &DMatrix<f64>) -> DMatrix<f64> {
    let rows = above.nrows();
    DMatrix::from_fn(
        rows + below.nrows(),
        above.ncols(),
        |i, j| {
            if i < rows { above[(i, j)] } else { below[(i - rows, j)] }
        },
    )
}

/// The sum of two independent vectors.
fn beside(one: &Factor, other: &Factor) -> Factor {
    let weights = DVector::from_iterator(one.rank() + other.rank(), one.weights.iter().chain(&other.weights).copied());
    Factor { rows: side_by_side(&one.rows, &other.rows), weights }
}

/// The rows with more sources, of which they know nothing.
fn beside_zero_rows(factor: &Factor, weights: &DVector<f64>) -> Factor {
    let rows = DMatrix::zeros(factor.rows.nrows(), weights.len());
    beside(factor, &Factor { rows, weights: weights.clone() })
}

fn beside_zeros(columns: usize, rows: &DMatrix<f64>) -> DMatrix<f64> {
    side_by_side(&DMatrix::zeros(rows.nrows(), columns), rows)
}
