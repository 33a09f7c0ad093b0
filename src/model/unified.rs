//! One step in one form for both timings, and for the equation of control.

use super::Timing;
use crate::matrix::Matrix;
use crate::scalar::Rational;

/// A step whose matrices do not change: `x₊ = A x + w`, `y = H x + v`, with `cov(w; v) = [[Q, S], [Sᵀ, R]]`.
///
/// Its equation of Riccati is `P = A P Aᵀ + Q − (A P Hᵀ + S)(H P Hᵀ + R)⁻¹(A P Hᵀ + S)ᵀ`. P is the covariance of the
/// predicted state where transitions depart, and of the filtered one where they arrive.
///
/// # Examples
///
/// ```
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::model::{Timing, UnifiedStep};
/// use exact_kalman::scalar::ratio;
///
/// let number = |value| Matrix::from_fn(1, 1, |_, _| ratio(value, 1));
/// let step = UnifiedStep::new(
///     Timing::Arriving, number(2), &number(3), number(5), &number(0), number(7));
/// assert_eq!(step.observation, number(6));
/// assert_eq!(step.cross_noise, number(15));
/// assert_eq!(step.observation_noise, number(52));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnifiedStep {
    /// A, n×n.
    pub transition: Matrix<Rational>,
    /// H, m×n.
    pub observation: Matrix<Rational>,
    /// Q, n×n.
    pub process_noise: Matrix<Rational>,
    /// S, n×m.
    pub cross_noise: Matrix<Rational>,
    /// R, m×m.
    pub observation_noise: Matrix<Rational>,
}

impl UnifiedStep {
    /// The step of a system: A, C, Q, S and R are its own where transitions depart; where they arrive,
    /// `H = C A`, `S + Q Cᵀ` and `R + C Q Cᵀ + C S + Sᵀ Cᵀ` are those of the state before the transition.
    ///
    /// # Panics
    ///
    /// If shapes do not fit.
    pub fn new(
        timing: Timing,
        transition: Matrix<Rational>,
        observation: &Matrix<Rational>,
        process_noise: Matrix<Rational>,
        cross_noise: &Matrix<Rational>,
        observation_noise: Matrix<Rational>,
    ) -> Self {
        if timing == Timing::Departing {
            let (observation, cross_noise) = (observation.clone(), cross_noise.clone());
            return Self { transition, observation, process_noise, cross_noise, observation_noise };
        }
        let mixed = observation * cross_noise;
        Self {
            observation: observation * &transition,
            cross_noise: &process_noise * observation.transpose() + cross_noise,
            observation_noise: observation_noise + observation.congruence(&process_noise) + &mixed + mixed.transpose(),
            transition,
            process_noise,
        }
    }

    /// n
    pub fn states(&self) -> usize {
        self.transition.rows()
    }

    /// m
    pub fn sensors(&self) -> usize {
        self.observation.rows()
    }
}
