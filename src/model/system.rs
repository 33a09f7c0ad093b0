//! The description of a system.

use super::{Coefficient, Initial};

/// Which transition a noise is shared with: the two conventions of the literature are two different models.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Timing {
    /// Transition k leads from k−1 *into* k, and its noise may be correlated with the noise of y_k (CKS).
    /// Coefficients with index k may depend on y_0, …, y_{k−1}.
    Arriving,
    /// Transition k leads *from* k to k+1, and its noise may be correlated with the noise of y_k (HV, SM and
    /// the common textbook). Observation coefficients with index k may depend on y_0, …, y_{k−1}, transition
    /// coefficients on y_0, …, y_k.
    Departing,
}

/// The driving noise of transition and observation, with common index k.
#[derive(Clone, Debug)]
pub enum Noise<S> {
    /// `D_k w` in the transition and `F_k w` in the observation, with one w ~ N(0, I) (CKS-A1).
    Factors {
        /// D, n×q.
        process: Coefficient<S>,
        /// F, m×q.
        observation: Coefficient<S>,
    },
    /// Covariances of the two noises and between them.
    Covariances {
        /// Q = D Dᵀ, n×n.
        process: Coefficient<S>,
        /// D Fᵀ, n×m; none means zero.
        cross: Option<Coefficient<S>>,
        /// R = F Fᵀ, m×m.
        observation: Coefficient<S>,
    },
}

/// A known input: `B u`, or u itself if there is no matrix.
#[derive(Clone, Debug)]
pub struct Input<S> {
    /// B (or G), n×p (or m×p).
    pub matrix: Option<Coefficient<S>>,
    /// u (or v), p×1.
    pub vector: Coefficient<S>,
}

/// The system CKS (1) in arriving timing, HV (1) in departing timing.
///
/// CKS-1a: `x(t+1) = A(t)x(t) + B(t)u(t) + D(t)w(t+1)`
///
/// CKS-1b: `y(t) = C(t−1)x(t) + G(t−1)v(t−1) + F(t−1)w(t)`
///
/// In departing timing it is HV (1), whose states are numbered from 1 and whose y(0) comes before them:
///
/// HV-1a: `x(k+1) = A(k)x(k) + B(k)u(k) + D(k)w(k), k ≥ 1`
///
/// HV-1b: `y(k) = C(k−1)x(k) + G(k−1)v(k−1) + F(k−1)w(k), k ≥ 1`
///
/// The fields are a description and nothing is checked here; [`System::realised`] checks it all.
///
/// # Examples
///
/// A random walk seen through noise, over three readings:
///
/// ```
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
/// use exact_kalman::scalar::{ratio, Rational};
///
/// let one = Matrix::<Rational>::identity(1);
/// let walk = System {
///     timing: Timing::Departing,
///     initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), one.clone()),
///     transition: one.clone().into(),
///     observation: one.clone().into(),
///     noise: Noise::Covariances { process: one.clone().into(), cross: None, observation: one.into() },
///     input: None,
///     observation_input: None,
/// };
/// let readings: Vec<_> = (1..=3).map(|y| Observation::complete([ratio(y, 1)])).collect();
/// assert_eq!(walk.realised(&readings)?.steps().len(), 3);
/// # Ok::<(), exact_kalman::model::ModelError<Rational>>(())
/// ```
#[derive(Clone, Debug)]
pub struct System<S> {
    /// Which transition shares noise with which observation.
    pub timing: Timing,
    /// The initial belief (CKS-A2).
    pub initial: Initial<S>,
    /// A, n×n.
    pub transition: Coefficient<S>,
    /// C, m×n.
    pub observation: Coefficient<S>,
    /// D and F, or their products.
    pub noise: Noise<S>,
    /// B u, added to the state.
    pub input: Option<Input<S>>,
    /// G v, added to the observation.
    pub observation_input: Option<Input<S>>,
}
