//! One step of the random Riccati equation, and its Lyapunov form.

use super::Mode;
use crate::matrix::{Matrix, PseudoInverseError};
use crate::scalar::{Field, OrderedField};

/// One step from P(k), with the parts that the theory names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RiccatiStep<S> {
    /// L(k), d×m.
    pub gain: Matrix<S>,
    /// F(k)(I − L(k)H(k)), d×d.
    pub closed_loop: Matrix<S>,
    /// Q̄(k), d×d.
    pub noise: Matrix<S>,
    /// P(k+1), d×d.
    pub next: Matrix<S>,
}

impl<S: OrderedField> Mode<S> {
    /// One step of the equation from P(k) ≥ 0.
    ///
    /// WG-1: `P(k+1) = F(k)P(k)Fᵀ(k) − F(k)P(k)Hᵀ(k)[H(k)P(k)Hᵀ(k) + R(k)]⁻¹H(k)P(k)Fᵀ(k) + Q(k)`
    ///
    /// WG-53: `L(k) = P(k)Hᵀ(k)[H(k)P(k)Hᵀ(k) + R(k)]⁻¹,  Q̄(k) = F(k)L(k)R(k)Lᵀ(k)Fᵀ(k) + Q(k)`
    ///
    /// A singular bracket has its pseudo-inverse instead.
    ///
    /// # Panics
    ///
    /// If P is not d×d.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}, stability::Mode};
    ///
    /// let scalar = |value| Matrix::<Rational>::diagonal(&[ratio(value, 1)]);
    /// let mode = Mode::new(scalar(2), scalar(1), scalar(1), scalar(1))?;
    /// // 4·1 − 4·1/2 + 1
    /// assert_eq!(mode.step(&scalar(1)).next, scalar(3));
    /// # Ok::<(), exact_kalman::stability::ModeError<Rational>>(())
    /// ```
    pub fn step(&self, covariance: &Matrix<S>) -> RiccatiStep<S> {
        match self.try_step(covariance) {
            Ok(step) => step,
            Err(error) => unreachable!("over an ordered field every matrix has a pseudo-inverse, but {error}"),
        }
    }
}

impl<S: Field> Mode<S> {
    /// [`Mode::step`] over any field; an error only if there is no (certain) pseudo-inverse.
    pub(crate) fn try_step(&self, covariance: &Matrix<S>) -> Result<RiccatiStep<S>, PseudoInverseError> {
        let cross = covariance * self.observation().transpose();
        let innovation = self.observation().congruence(covariance) + self.observation_noise();
        let gain = &cross * innovation.inverse().or_else(|_| innovation.pseudo_inverse())?;
        let next = self.transition().congruence(&(covariance - &gain * cross.transpose())) + self.process_noise();
        let closed_loop = self.closed_loop(&gain);
        let noise = self.closed_loop_noise(&gain);
        Ok(RiccatiStep { gain, closed_loop, noise, next })
    }

    /// F(I − LH) for any gain L, d×m.
    ///
    /// # Panics
    ///
    /// If the shape does not fit.
    pub fn closed_loop(&self, gain: &Matrix<S>) -> Matrix<S> {
        self.transition() - self.transition() * gain * self.observation()
    }

    /// FLRLᵀFᵀ + Q for any gain L, d×m.
    ///
    /// # Panics
    ///
    /// If the shape does not fit.
    pub fn closed_loop_noise(&self, gain: &Matrix<S>) -> Matrix<S> {
        (self.transition() * gain).congruence(self.observation_noise()) + self.process_noise()
    }

    /// The covariance of the next error under any gain L, d×m: for that of [`Mode::step`] it is P(k+1), for others no less.
    ///
    /// WG-52: `P(k+1) = F(k)(I − L(k)H(k))P(k)(I − L(k)H(k))ᵀFᵀ(k) + Q̄(k)`
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    pub fn lyapunov(&self, covariance: &Matrix<S>, gain: &Matrix<S>) -> Matrix<S> {
        self.closed_loop(gain).congruence(covariance) + self.closed_loop_noise(gain)
    }
}
