//! The filter for the model of Anderson and others, step by step.

use super::RiccatiMap;
use super::map::certain;
use crate::matrix::{Matrix, PseudoInverseError};
use crate::scalar::{Field, OrderedField};

/// What one step does to the covariance.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CovarianceStep<S> {
    /// S(k), the covariance of x(k) before y(k).
    pub predicted: Matrix<S>,
    /// Δ(k), the gain.
    pub gain: Matrix<S>,
    /// P(k), the covariance of x(k) after y(k).
    pub filtered: Matrix<S>,
}

impl<S: OrderedField> RiccatiMap<S> {
    /// One step from P(k−1) ≥ 0, with the A, V and W of this map; where they change, each step has a map of its own.
    ///
    /// AK-1.4a: `S(k) = A P(k−1)Aᵀ + V, k ≥ 1`
    ///
    /// AK-1.4b: `Δ(k) = S(k)(S(k) + W)⁺`
    ///
    /// AK-1.4c: `P(k) = (I − Δ(k))S(k)`
    ///
    /// The last is S(k):W, for singular V and W as well. The recursion starts with
    ///
    /// AK-1.4-start: `P(0) = cov x(0)`
    ///
    /// Shapes: n×n.
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    ///
    /// # Examples
    ///
    /// The scalar system A = 9/10, V = 4, W = 1, from a known x(0):
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, riccati::RiccatiMap, scalar::{ratio, Rational}};
    ///
    /// let scalar = |value| Matrix::<Rational>::diagonal(&[value]);
    /// let map = RiccatiMap::new(scalar(ratio(9, 10)), scalar(ratio(4, 1)), scalar(ratio(1, 1)))?;
    /// let step = map.step(&scalar(ratio(0, 1)));
    /// assert_eq!(step.gain, scalar(ratio(4, 5)));
    /// let mean = map.filtered_mean(&step.gain, &scalar(ratio(100, 1)), &scalar(ratio(95, 1)));
    /// assert_eq!(mean, scalar(ratio(94, 1)));
    /// # Ok::<(), exact_kalman::riccati::RiccatiError<Rational>>(())
    /// ```
    pub fn step(&self, last: &Matrix<S>) -> CovarianceStep<S> {
        certain(self.try_step(last))
    }
}

impl<S: Field> RiccatiMap<S> {
    /// [`RiccatiMap::step`] over any field; an error only if there is no (certain) pseudo-inverse.
    pub(crate) fn try_step(&self, last: &Matrix<S>) -> Result<CovarianceStep<S>, PseudoInverseError> {
        let predicted = self.transition().congruence(last) + self.state_noise();
        let gain = self.try_gain(&predicted)?;
        let filtered = &predicted - &gain * &predicted;
        Ok(CovarianceStep { predicted, gain, filtered })
    }

    /// x(k|k), given the gain, x(k−1|k−1) and y(k).
    ///
    /// AK-1.3a: `x(k|k) = (I − Δ(k))A x(k−1|k−1) + Δ(k)y(k), k ≥ 1`
    ///
    /// It is the projection of x(k) on the span of 1, y(1), …, y(k), if it starts with the mean:
    ///
    /// AK-1.3-start: `x(0|0) = E x(0)`
    ///
    /// Shapes: `gain` n×n, the others n×1.
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    pub fn filtered_mean(&self, gain: &Matrix<S>, last: &Matrix<S>, observation: &Matrix<S>) -> Matrix<S> {
        let predicted = self.transition() * last;
        &predicted + gain * (observation - &predicted)
    }

    /// x(t|k), `steps` = t − k ahead of x(k|k); for t > k it is y(t|k) as well.
    ///
    /// AK-1.3b: `x(t|k) = A^(t−k) x(k|k), t > k`
    ///
    /// AK-1.3c: `y(t|k) = x(t|k), t > k`
    ///
    /// Shapes: n×1.
    ///
    /// # Panics
    ///
    /// If the shape does not fit.
    pub fn predicted_mean(&self, filtered: &Matrix<S>, steps: usize) -> Matrix<S> {
        (0..steps).fold(filtered.clone(), |mean, _| self.transition() * mean)
    }
}
