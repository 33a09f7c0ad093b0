//! φ, its iterates, its gain and its closed loop.

use super::{RiccatiError, Role};
use crate::matrix::{Matrix, PseudoInverseError, Shape};
use crate::scalar::{Field, OrderedField};

/// The map `φ(S) = A(S:W)Aᵀ + V`, which leads from the covariance before one observation to that before the next.
///
/// AK-2.5: `φ(S) = A(S:W)Aᵀ + V, S > 0`
///
/// Shapes and covariances are checked once, when it is made. V and W may be singular, and so may the arguments: the
/// parallel sum is taken with the pseudo-inverse. What needs V > 0 says so.
///
/// # Examples
///
/// ```
/// use exact_kalman::{matrix::Matrix, riccati::RiccatiMap, scalar::{ratio, Rational}};
///
/// let scalar = |value| Matrix::<Rational>::diagonal(&[value]);
/// let map = RiccatiMap::new(scalar(ratio(1, 1)), scalar(ratio(1, 1)), scalar(ratio(2, 1)))?;
/// // 1/(1/2 + 1/2) + 1 = 2: a fixed point.
/// assert_eq!(map.image(&scalar(ratio(2, 1))), scalar(ratio(2, 1)));
/// # Ok::<(), exact_kalman::riccati::RiccatiError<Rational>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RiccatiMap<S> {
    transition: Matrix<S>,
    state_noise: Matrix<S>,
    observation_noise: Matrix<S>,
}

impl<S: OrderedField> RiccatiMap<S> {
    /// The map of A, V and W.
    ///
    /// Shapes: all n×n.
    ///
    /// # Errors
    ///
    /// [`RiccatiError`] if the shapes do not fit, or V or W is not positive semidefinite, with a vector that proves it.
    pub fn new(
        transition: Matrix<S>,
        state_noise: Matrix<S>,
        observation_noise: Matrix<S>,
    ) -> Result<Self, RiccatiError<S>> {
        check_shape(Role::Transition, &transition, transition.rows())?;
        for (role, noise) in [(Role::StateNoise, &state_noise), (Role::ObservationNoise, &observation_noise)] {
            check_shape(role, noise, transition.rows())?;
            noise.ldl().map_err(|source| RiccatiError::NotSemidefinite { role, source })?;
        }
        Ok(Self { transition, state_noise, observation_noise })
    }

    /// The map of Mx(k), where x(k) is observed through a nonsingular M.
    ///
    /// AK-M: `y(k) = M x(k) + w(k), M nonsingular, is (1.1)–(1.2) for Mx(k), with MAM⁻¹ for A and MVMᵀ for V`
    ///
    /// Shapes: all n×n.
    ///
    /// # Errors
    ///
    /// As for [`RiccatiMap::new`]; [`RiccatiError::SensorsSingular`] if M has no inverse.
    pub fn with_sensors(
        sensors: &Matrix<S>,
        transition: &Matrix<S>,
        state_noise: &Matrix<S>,
        observation_noise: Matrix<S>,
    ) -> Result<Self, RiccatiError<S>> {
        check_shape(Role::Transition, transition, transition.rows())?;
        check_shape(Role::Sensors, sensors, transition.rows())?;
        check_shape(Role::StateNoise, state_noise, transition.rows())?;
        let inverse = sensors
            .inverse()
            .map_err(|_| RiccatiError::SensorsSingular { direction: sensors.kernel().select_columns(&[0]) })?;
        Self::new(sensors * transition * inverse, sensors.congruence(state_noise), observation_noise)
    }
}

impl<S: Field> RiccatiMap<S> {
    /// The map of matrices whose shapes and covariances the caller answers for, for identities that need no order.
    pub(crate) fn from_parts(transition: Matrix<S>, state_noise: Matrix<S>, observation_noise: Matrix<S>) -> Self {
        Self { transition, state_noise, observation_noise }
    }

    /// The number of states.
    pub fn states(&self) -> usize {
        self.transition.rows()
    }

    /// A, n×n.
    pub fn transition(&self) -> &Matrix<S> {
        &self.transition
    }

    /// V, n×n.
    pub fn state_noise(&self) -> &Matrix<S> {
        &self.state_noise
    }

    /// W, n×n.
    pub fn observation_noise(&self) -> &Matrix<S> {
        &self.observation_noise
    }

    /// AWAᵀ + V, which no image of φ exceeds.
    pub fn upper_bound(&self) -> Matrix<S> {
        self.transition.congruence(&self.observation_noise) + &self.state_noise
    }

    /// [`RiccatiMap::image`] over any field; an error only if there is no (certain) pseudo-inverse.
    pub(crate) fn try_image(&self, s: &Matrix<S>) -> Result<Matrix<S>, PseudoInverseError> {
        Ok(self.transition.congruence(&self.try_filtered_covariance(s)?) + &self.state_noise)
    }

    /// [`RiccatiMap::filtered_covariance`] over any field.
    pub(crate) fn try_filtered_covariance(&self, s: &Matrix<S>) -> Result<Matrix<S>, PseudoInverseError> {
        s.parallel_sum(&self.observation_noise)
    }

    /// [`RiccatiMap::gain`] over any field.
    pub(crate) fn try_gain(&self, s: &Matrix<S>) -> Result<Matrix<S>, PseudoInverseError> {
        Ok(s * self.try_information(s)?)
    }

    /// [`RiccatiMap::closed_loop`] over any field.
    pub(crate) fn try_closed_loop(&self, t: &Matrix<S>) -> Result<Matrix<S>, PseudoInverseError> {
        Ok(&self.transition * &self.observation_noise * self.try_information(t)?)
    }

    /// (S + W)⁺
    fn try_information(&self, s: &Matrix<S>) -> Result<Matrix<S>, PseudoInverseError> {
        let total = s + &self.observation_noise;
        total.inverse().or_else(|_| total.pseudo_inverse())
    }
}

impl<S: OrderedField> RiccatiMap<S> {
    /// φ(S), for S ≥ 0.
    ///
    /// AK-4.1: `S(k) = A[S(k−1) − S(k−1)(S(k−1) + W)⁻¹S(k−1)]Aᵀ + V = A(S(k−1):W)Aᵀ + V = φ(S(k−1)), k ≥ 2`
    ///
    /// It is monotone, and stays between V and AWAᵀ + V whatever S is:
    ///
    /// AK-4.2: `V ≤ φ(S) = A(S:W)Aᵀ + V = A{W − W(S + W)⁻¹W}Aᵀ + V ≤ AWAᵀ + V`
    ///
    /// Shapes: n×n.
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    pub fn image(&self, s: &Matrix<S>) -> Matrix<S> {
        certain(self.try_image(s))
    }

    /// φⁿ(S), for S ≥ 0; entries lengthen with n.
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    pub fn iterate(&self, s: &Matrix<S>, times: usize) -> Matrix<S> {
        (0..times).fold(s.clone(), |s, _| self.image(&s))
    }

    /// S:W, the covariance after an observation where S ≥ 0 is that before it.
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    pub fn filtered_covariance(&self, s: &Matrix<S>) -> Matrix<S> {
        certain(self.try_filtered_covariance(s))
    }

    /// Δ, the gain of an observation where S ≥ 0 is the covariance before it.
    ///
    /// AK-1.4b: `Δ(k) = S(k)(S(k) + W)⁺`
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    pub fn gain(&self, s: &Matrix<S>) -> Matrix<S> {
        certain(self.try_gain(s))
    }

    /// D, by which the filter's own errors move on where T ≥ 0 is the covariance before an observation.
    ///
    /// AK-D: `D = AW(T + W)⁻¹`
    ///
    /// If T is a fixed point and V > 0, all its eigenvalues lie inside the unit circle:
    ///
    /// AK-L4.3: `V > 0, T = φ(T)  ⇒  ρ(D) < 1`
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    pub fn closed_loop(&self, t: &Matrix<S>) -> Matrix<S> {
        certain(self.try_closed_loop(t))
    }

    /// (S + W)⁺
    pub(super) fn information(&self, s: &Matrix<S>) -> Matrix<S> {
        certain(self.try_information(s))
    }
}

/// What an ordered field has.
pub(super) fn certain<T>(value: Result<T, PseudoInverseError>) -> T {
    match value {
        Ok(value) => value,
        Err(error) => unreachable!("over an ordered field every matrix has a pseudo-inverse, but {error}"),
    }
}

fn check_shape<S>(role: Role, matrix: &Matrix<S>, order: usize) -> Result<(), RiccatiError<S>> {
    let (found, expected) = (matrix.shape(), Shape { rows: order, columns: order });
    if found == expected { Ok(()) } else { Err(RiccatiError::Shape { role, found, expected }) }
}
