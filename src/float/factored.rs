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
use super::rank::{Computed, product, side_by_side, stacked};
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
    pub(super) state: Computed,
    /// F, m×k.
    pub(super) noise: Computed,
    /// D, n×k, if a transition departs.
    pub(super) process: Option<Computed>,
    /// The weights of the k sources.
    pub(super) weights: DVector<f64>,
    /// C, m×n.
    pub(super) observation: &'a DMatrix<f64>,
    /// A, n×n; used if a transition departs.
    pub(super) transition: &'a DMatrix<f64>,
}

impl Stage<'_> {
    /// `C W + F`, in one product, so that what cancels between the two is seen to cancel.
    pub(super) fn readings(&self) -> Computed {
        sum_of_image(self.observation, &self.state, &self.noise)
    }

    /// W above `A W + D`, for any W and D.
    pub(super) fn others(&self, state: &Computed, process: Option<&Computed>) -> Computed {
        let Some(process) = process else { return state.clone() };
        state.above(&sum_of_image(self.transition, state, process))
    }
}

/// `a x + y`, entries that are nothing but rounding set to zero.
fn sum_of_image(a: &DMatrix<f64>, x: &Computed, y: &Computed) -> Computed {
    let rows = y.entries.nrows();
    x.above(y).image(&side_by_side(a, &DMatrix::identity(rows, rows)))
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
    /// W and F in the columns of the factor, where the reading that follows shares noise with the state.
    shared: Option<(Computed, Computed)>,
}

/// The recursion on factors that are reduced by `R`.
pub(super) struct Factored<R>(std::marker::PhantomData<R>);

impl<R: Reduction> Recursion for Factored<R> {
    const NAME: &'static str = R::NAME;
    const DESCRIPTION: &'static str = R::DESCRIPTION;
    type Belief = Belief;

    fn start(moments: Moments) -> Result<Belief, Obstacle> {
        let factor = R::compressed(Factor::of(&moments.covariance)?)?;
        Ok(Belief { mean: moments.mean, factor, shared: None })
    }

    fn moments(belief: &Belief) -> Result<Moments, Obstacle> {
        Ok(Moments { mean: belief.mean.clone(), covariance: belief.factor.covariance() })
    }

    fn predicted(belief: &Belief, transition: &Transition) -> Result<Belief, Obstacle> {
        let Transition { matrix: a, input, noise: q } = transition;
        let moved = Factor { rows: product(a, &belief.factor.rows), weights: belief.factor.weights.clone() };
        let factor = R::compressed(beside(&moved, &Factor::of(q)?))?;
        Ok(Belief { mean: a * &belief.mean + input, factor, shared: None })
    }

    /// The columns are kept as they are, since those of the noise belong to the reading too.
    fn arrived(belief: &Belief, transition: &Transition, observed: &Observed) -> Result<Belief, Obstacle> {
        let Transition { matrix: a, input, noise: q } = transition;
        let JointNoise { process, noise, weights } = JointNoise::of(q, &observed.state_noise, &observed.noise)?;
        let own = belief.factor.rank();
        let state = Computed::from(belief.factor.rows.clone()).image(a).beside(&process);
        let weights =
            DVector::from_iterator(own + weights.len(), belief.factor.weights.iter().chain(&weights).copied());
        let factor = Factor { rows: state.entries.clone(), weights };
        Ok(Belief { mean: a * &belief.mean + input, factor, shared: Some((state, noise.behind_zeros(own))) })
    }

    fn updated(
        belief: &Belief,
        observed: &Observed,
        departure: Option<&Departure<'_>>,
    ) -> Result<Update<Belief>, Obstacle> {
        let Belief { mean, factor, shared } = belief;
        let n = mean.len();
        let (own, transition) =
            (factor.rank(), departure.map_or(&observed.matrix, |departure| &departure.transition.matrix));
        let independent = |process: Option<Computed>, noise: Computed, sources: DVector<f64>| {
            let Factor { rows, weights } = beside_zero_rows(factor, &sources);
            (Computed::from(rows), process.map(|rows| rows.behind_zeros(own)), noise.behind_zeros(own), weights)
        };
        let (state, process, noise, weights) = match (shared, departure) {
            (Some((state, noise)), _) => (state.clone(), None, noise.clone(), factor.weights.clone()),
            (None, Some(Departure { transition, cross_noise })) => {
                let joint = JointNoise::of(&transition.noise, cross_noise, &observed.noise)?;
                independent(Some(joint.process), joint.noise, joint.weights)
            }
            (None, None) => {
                let (noise, sources) = Factor::computed(&observed.noise)?;
                independent(None, noise, sources)
            }
        };
        let stage = Stage { state, noise, process, weights, observation: &observed.matrix, transition };
        let innovation = &observed.value - &observed.matrix * mean;
        let innovation_covariance =
            Factor { rows: stage.readings().entries, weights: stage.weights.clone() }.covariance();
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
            Ok(Belief { mean: means.rows(first, n).into_owned(), factor, shared: None })
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

/// D and F in common columns.
struct JointNoise {
    process: Computed,
    noise: Computed,
    weights: DVector<f64>,
}

impl JointNoise {
    /// From `(Q M; Mᵀ R)`.
    fn of(q: &DMatrix<f64>, cross: &DMatrix<f64>, r: &DMatrix<f64>) -> Result<Self, Obstacle> {
        let (n, m) = cross.shape();
        let joint = stacked(&side_by_side(q, cross), &side_by_side(&cross.transpose(), r));
        let (rows, weights) = Factor::computed(&joint)?;
        Ok(Self { process: rows.rows(0, n), noise: rows.rows(n, m), weights })
    }
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
