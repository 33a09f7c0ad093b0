//! A system along one realised path of data.

use super::{Initial, Observation, Timing};
use crate::matrix::Matrix;

/// The realised transition with index k.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Transition<T> {
    /// A, n×n.
    pub matrix: Matrix<T>,
    /// B u, n×1.
    pub input: Matrix<T>,
    /// Q = D Dᵀ, n×n.
    pub noise: Matrix<T>,
    /// D Fᵀ, n×m: the covariance of the transition's noise with that of the observation of the same index.
    pub cross_noise: Matrix<T>,
}

/// Everything with index k.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step<T> {
    /// The transition; nothing where none is needed (arriving: before y_0 if the initial law is that of x_0;
    /// departing: after the last observation, if not given).
    pub transition: Option<Transition<T>>,
    /// C, m×n.
    pub observation: Matrix<T>,
    /// G v, m×1.
    pub observation_input: Matrix<T>,
    /// R = F Fᵀ, m×m.
    pub observation_noise: Matrix<T>,
    /// y_k
    pub reading: Observation<T>,
}

impl<T: PartialEq> Step<T> {
    /// Whether another step has the same law: both differ in their readings and inputs alone.
    pub(crate) fn differs_in_data_alone(&self, other: &Self) -> bool {
        let transitions = match (&self.transition, &other.transition) {
            (Some(own), Some(next)) => {
                own.matrix == next.matrix && own.noise == next.noise && own.cross_noise == next.cross_noise
            }
            (None, None) => true,
            _ => false,
        };
        transitions
            && self.observation == other.observation
            && self.observation_noise == other.observation_noise
            && self.reading.present() == other.reading.present()
    }
}

/// A system whose coefficients are frozen at their values along given observations.
///
/// Freezing is exact: given the path, the observations are affine in (x_0, w) with a unit triangular
/// dependence on earlier ones, so the conditional law is that of the frozen system (CKS-T).
///
/// A path is made by [`System::realised`](super::System::realised), which checks it, or as the image of one.
#[derive(Clone, Debug)]
pub struct Path<T> {
    timing: Timing,
    initial: Initial<T>,
    steps: Vec<Step<T>>,
    /// Whether all covariances are known to be positive semidefinite.
    semidefinite: bool,
}

/// What is known of the covariances does not make paths differ.
impl<T: PartialEq> PartialEq for Path<T> {
    fn eq(&self, other: &Self) -> bool {
        let Self { timing, initial, steps, semidefinite: _ } = self;
        (timing, initial, steps) == (&other.timing, &other.initial, &other.steps)
    }
}

impl<T: Eq> Eq for Path<T> {}

impl<T> Path<T> {
    /// A path whose parts the caller answers for; nothing is known of its covariances.
    pub(crate) fn from_parts(timing: Timing, initial: Initial<T>, steps: Vec<Step<T>>) -> Self {
        Self { timing, initial, steps, semidefinite: false }
    }

    /// A path whose covariances are positive semidefinite: those of the noise jointly, and the initial one unless it is
    /// [allowed](Initial::allow_indefinite) not to be.
    pub(super) fn semidefinite(timing: Timing, initial: Initial<T>, steps: Vec<Step<T>>) -> Self {
        let semidefinite = !initial.allow_indefinite;
        Self { timing, initial, steps, semidefinite }
    }

    /// The same law in another timing: what is known of the covariances stays known.
    pub(super) fn in_timing(&self, timing: Timing, initial: Initial<T>, steps: Vec<Step<T>>) -> Self {
        Self { timing, initial, steps, semidefinite: self.semidefinite }
    }

    /// Whether all covariances are known to be positive semidefinite, as those of a realised system are.
    pub(crate) fn is_semidefinite(&self) -> bool {
        self.semidefinite
    }

    /// Which transition shares noise with which observation.
    pub fn timing(&self) -> Timing {
        self.timing
    }

    /// The initial belief.
    pub fn initial(&self) -> &Initial<T> {
        &self.initial
    }

    /// The steps, one per observation.
    pub fn steps(&self) -> &[Step<T>] {
        &self.steps
    }

    /// n, the dimension of the state.
    pub fn states(&self) -> usize {
        self.initial.mean.rows()
    }

    /// m, the dimension of an observation.
    pub fn sensors(&self) -> usize {
        self.steps.first().map_or(0, |step| step.reading.dimension())
    }

    /// The same path over another scalar, or the first entry that has no image there.
    ///
    /// # Errors
    ///
    /// What `image` returns.
    pub fn try_map<U, E>(&self, mut image: impl FnMut(&T) -> Result<U, E>) -> Result<Path<U>, E> {
        let steps = self.steps.iter().map(|step| {
            Ok(Step {
                transition: step.transition.as_ref().map(|transition| transition.try_map(&mut image)).transpose()?,
                observation: step.observation.try_map(&mut image)?,
                observation_input: step.observation_input.try_map(&mut image)?,
                observation_noise: step.observation_noise.try_map(&mut image)?,
                reading: step.reading.try_map(&mut image)?,
            })
        });
        let steps = steps.collect::<Result<_, E>>()?;
        Ok(Path::from_parts(self.timing, self.initial.try_map(image)?, steps))
    }
}

impl<T> Transition<T> {
    pub(super) fn try_map<U, E>(&self, mut image: impl FnMut(&T) -> Result<U, E>) -> Result<Transition<U>, E> {
        Ok(Transition {
            matrix: self.matrix.try_map(&mut image)?,
            input: self.input.try_map(&mut image)?,
            noise: self.noise.try_map(&mut image)?,
            cross_noise: self.cross_noise.try_map(&mut image)?,
        })
    }
}
