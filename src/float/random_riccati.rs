//! The random equation of Riccati in `f64`.

use nalgebra::DMatrix;

use super::error::Obstacle;
use super::matrix_error::FloatMatrixError;
use super::moments::{dense, finite};
use super::symmetric::congruence;
use crate::matrix::Matrix;

/// F, H, Q and R of one time: d×d, m×d, d×d, m×m.
#[derive(Clone, Debug, PartialEq)]
pub struct FloatMode {
    /// F.
    pub transition: Matrix<f64>,
    /// H.
    pub observation: Matrix<f64>,
    /// Q, symmetric.
    pub process_noise: Matrix<f64>,
    /// R, symmetric.
    pub observation_noise: Matrix<f64>,
}

impl FloatMode {
    /// P(k+1) from P(k) by the form of Joseph, symmetric to the last bit (WG-52 with WG-53 in floating point).
    ///
    /// Shapes: P d×d and symmetric.
    ///
    /// # Errors
    ///
    /// [`FloatMatrixError::Singular`] unless HPHᵀ + R > 0 in `f64`, [`FloatMatrixError::NotFinite`].
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{float::FloatMode, matrix::Matrix};
    ///
    /// let scalar = |value| Matrix::column(vec![value]);
    /// let mode = FloatMode {
    ///     transition: scalar(2.0),
    ///     observation: scalar(1.0),
    ///     process_noise: scalar(1.0),
    ///     observation_noise: scalar(1.0),
    /// };
    /// assert_eq!(mode.step(&scalar(1.0))?, scalar(3.0));
    /// # Ok::<(), exact_kalman::float::FloatMatrixError>(())
    /// ```
    pub fn step(&self, covariance: &Matrix<f64>) -> Result<Matrix<f64>, FloatMatrixError> {
        Ok(finite(&self.dense_step(&dense(covariance))?)?)
    }

    fn dense_step(&self, covariance: &DMatrix<f64>) -> Result<DMatrix<f64>, Obstacle> {
        let (f, h) = (dense(&self.transition), dense(&self.observation));
        let (q, r) = (dense(&self.process_noise), dense(&self.observation_noise));
        let innovation = congruence(&h, covariance) + &r;
        let solved = innovation.cholesky().ok_or(Obstacle::Singular)?.solve(&(&h * covariance));
        let gain = &f * solved.transpose();
        let closed = &f - &gain * &h;
        Ok(congruence(&closed, covariance) + congruence(&gain, &r) + q)
    }
}

/// `∑ Φᵀ(i)Hᵀ(i)H(i)Φ(i)` over the modes i of a window, Φ(i) the product of the transitions before each (WG-6 in floating point).
///
/// # Errors
///
/// [`FloatMatrixError::NotFinite`].
///
/// # Panics
///
/// If there is no mode, or the shapes do not fit.
pub fn gramian(window: &[FloatMode]) -> Result<Matrix<f64>, FloatMatrixError> {
    let [first, ..] = window else { panic!("a window has at least one mode") };
    let states = first.transition.rows();
    let mut transition = DMatrix::identity(states, states);
    let mut sum = DMatrix::zeros(states, states);
    for mode in window {
        let h = dense(&mode.observation) * &transition;
        sum += congruence(&h.transpose(), &DMatrix::identity(h.nrows(), h.nrows()));
        transition = dense(&mode.transition) * transition;
    }
    Ok(finite(&sum)?)
}

/// E P(k) for k = 0, …, steps, over all paths of a Markov chain of modes (all of WG-1 in floating point).
///
/// `law` holds the probabilities of the first mode, `chain[(i, j)]` the probability that mode j follows mode i. Paths of probability zero
/// are left out; with n modes up to nᵏ are walked, each but once, keeping one covariance for each step.
///
/// # Errors
///
/// As for [`FloatMode::step`].
///
/// # Panics
///
/// If the shapes do not fit.
pub fn expected_covariances(
    modes: &[FloatMode],
    law: &[f64],
    chain: &Matrix<f64>,
    start: &Matrix<f64>,
    steps: usize,
) -> Result<Vec<Matrix<f64>>, FloatMatrixError> {
    let mut sums = vec![DMatrix::zeros(start.rows(), start.rows()); steps + 1];
    sums[0] = dense(start);
    let mut pending: Vec<(usize, usize, f64, DMatrix<f64>)> =
        law.iter().enumerate().map(|(mode, &weight)| (1, mode, weight, dense(start))).collect();
    while let Some((time, mode, weight, covariance)) = pending.pop() {
        if weight == 0.0 || time > steps {
            continue;
        }
        let next = modes[mode].dense_step(&covariance)?;
        sums[time] += &next * weight;
        pending.extend((0..modes.len()).map(|to| (time + 1, to, weight * chain[(mode, to)], next.clone())));
    }
    sums.iter().map(|sum| Ok(finite(sum)?)).collect()
}
