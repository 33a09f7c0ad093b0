//! The extended Kalman predictor: the recursion on a nonlinear system, made linear anew at each step.

mod error;
mod system;
mod trace;

use std::fmt::{Debug, Display};
use std::num::NonZeroUsize;

use nalgebra::{DMatrix, DVector};

pub use error::{ExtendedError, ExtendedObstacle};
pub use system::{AdditiveNoise, ExtendedSystem, Function, Linearisation, Linearised};
pub use trace::{ExtendedStep, ExtendedTrace};

use super::error::Obstacle;
use super::moments::{Moments, dense, dense_column, finite, finite_column};
use super::symmetric::{congruence, with_transpose};
use crate::model::Observation;
use crate::trace::Moments as Law;

/// The extended Kalman predictor, up to `ahead` = d steps ahead.
///
/// With f and h linear at the points that [`Linearisation`] names, A and C their derivatives there, P the covariance
/// of x̂(k|k−1) and ν = y − h(x̂(k|k−1)):
///
/// ```text
/// S = C P Cᵀ + R              K = P Cᵀ S⁻¹                K₊ = (A P Cᵀ + DFᵀ) S⁻¹
/// P(k+1|k) = (A − K₊C) P (A − K₊C)ᵀ + Q + K₊ R K₊ᵀ − DFᵀK₊ᵀ − K₊FDᵀ
/// x̂(k+j+1|k) = f(x̂(k+j|k)),  P(k+j+1|k) = A P(k+j|k) Aᵀ + Q,  A at x̂(k+j|k), j ≥ 1
/// ```
///
/// On a linear system both forms are the ordinary predictor. Missing entries of a reading drop their rows. f is asked
/// for indices up to that of the last reading plus d − 1.
///
/// # Errors
///
/// [`ExtendedError`] with the step and the steps before it. What fails before the first reading counts as step 0.
///
/// # Panics
///
/// If a shape does not fit.
///
/// # Examples
///
/// `x₊ = x² + w, y = x + v`: the form decides where the slope is taken.
///
/// ```
/// use std::convert::Infallible;
/// use std::num::NonZeroUsize;
/// use exact_kalman::float::{predict_extended, AdditiveNoise, ExtendedSystem, Linearisation, Linearised};
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::model::Observation;
///
/// let scalar = |value: f64| Matrix::column(vec![value]);
/// let square = |_, x: &Matrix<f64>| {
///     let x = x[(0, 0)];
///     Ok::<_, Infallible>(Linearised { value: scalar(x * x), jacobian: scalar(2.0 * x) })
/// };
/// let itself = |_, x: &Matrix<f64>| Ok(Linearised { value: x.clone(), jacobian: scalar(1.0) });
/// let noise = |_| AdditiveNoise { process: scalar(0.5), cross: scalar(0.0), observation: scalar(1.0) };
/// for (linearisation, expected) in [(Linearisation::Prediction, 8.0), (Linearisation::Filtered, 9.0)] {
///     let (mean, covariance) = (&scalar(2.0), &scalar(1.0));
///     let system =
///         ExtendedSystem { mean, covariance, transition: &square, observation: &itself, noise: &noise, linearisation };
///     let trace = predict_extended(&system, &[Observation::complete([4.0])], NonZeroUsize::MIN)?;
///     assert_eq!(trace.steps[0].filtered.mean, scalar(3.0));
///     assert_eq!(trace.steps[0].ahead[0].mean, scalar(expected));
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn predict_extended<E: Debug + Display>(
    system: &ExtendedSystem<'_, E>,
    readings: &[Observation<f64>],
    ahead: NonZeroUsize,
) -> Result<ExtendedTrace, ExtendedError<E>> {
    let mut steps: Vec<ExtendedStep> = Vec::with_capacity(readings.len());
    let start = Moments { mean: dense_column(system.mean), covariance: dense(system.covariance) };
    let prior = match system.laws_from(0, start.clone(), ahead) {
        Ok(prior) => prior,
        Err(source) => return Err(ExtendedError { step: 0, source, computed: steps }),
    };
    let mut belief = start;
    for (k, reading) in readings.iter().enumerate() {
        let step = system.step(k, belief, reading, ahead);
        let (step, next) = match step {
            Ok(done) => done,
            Err(source) => return Err(ExtendedError { step: k, source, computed: steps }),
        };
        steps.push(step);
        belief = next;
    }
    Ok(ExtendedTrace { prior, steps })
}

/// The observed rows of one observation, linear.
struct Sensors {
    /// C
    matrix: DMatrix<f64>,
    /// ν
    innovation: DVector<f64>,
    /// D Fᵀ
    cross: DMatrix<f64>,
    /// R
    noise: DMatrix<f64>,
}

impl<E> ExtendedSystem<'_, E> {
    /// Reading k: the step, and the law of x_{k+1}.
    fn step(
        &self,
        k: usize,
        belief: Moments,
        reading: &Observation<f64>,
        ahead: NonZeroUsize,
    ) -> Result<(ExtendedStep, Moments), ExtendedObstacle<E>> {
        let predicted = shown(&belief)?;
        let (filtered, next) = if reading.present().is_empty() {
            let next = self.propagated(k, &belief)?;
            (belief, next)
        } else {
            self.conditioned(k, &belief, reading)?
        };
        let filtered = shown(&filtered)?;
        let ahead = self.laws_from(k + 1, next.clone(), ahead)?;
        Ok((ExtendedStep { predicted, filtered, ahead }, next))
    }

    /// The laws of x_k and x_{k+1} given y_k.
    fn conditioned(
        &self,
        k: usize,
        belief: &Moments,
        reading: &Observation<f64>,
    ) -> Result<(Moments, Moments), ExtendedObstacle<E>> {
        let Moments { mean, covariance: p } = belief;
        let (sensors, q) = self.sensors(k, mean, reading)?;
        let Sensors { matrix: c, innovation, cross, noise: r } = &sensors;
        let factors = (congruence(c, p) + r).lu();
        let over_s = |matrix: &DMatrix<f64>| {
            factors.solve(&matrix.transpose()).map(|found| found.transpose()).ok_or(ExtendedObstacle::Singular)
        };
        let gain = over_s(&(p * c.transpose()))?;
        let closed = DMatrix::identity(p.nrows(), p.nrows()) - &gain * c;
        let filtered =
            Moments { mean: mean + &gain * innovation, covariance: congruence(&closed, p) + congruence(&gain, r) };
        let point = match self.linearisation {
            Linearisation::Prediction => mean,
            Linearisation::Filtered => &filtered.mean,
        };
        let (value, a) = self.transition_at(k, point)?;
        let gain_ahead = over_s(&(&a * p * c.transpose() + cross))?;
        let correction = match self.linearisation {
            Linearisation::Prediction => &gain_ahead * innovation,
            // f has seen Kν already; what is left is the mean of the noise.
            Linearisation::Filtered => over_s(cross)? * innovation,
        };
        let closed = &a - &gain_ahead * c;
        let shared = with_transpose(&(cross * gain_ahead.transpose()));
        let covariance = congruence(&closed, p) + q + congruence(&gain_ahead, r) - shared;
        Ok((filtered, Moments { mean: value + correction, covariance }))
    }

    /// The observation equation at x̂, its observed rows; and Q.
    fn sensors(
        &self,
        k: usize,
        mean: &DVector<f64>,
        reading: &Observation<f64>,
    ) -> Result<(Sensors, DMatrix<f64>), ExtendedObstacle<E>> {
        let present = reading.present();
        let n = mean.nrows();
        let AdditiveNoise { process, cross, observation } = (self.noise)(k);
        let Linearised { value, jacobian } =
            (self.observation)(k, &finite_column(mean)?).map_err(ExtendedObstacle::Undefined)?;
        let m = reading.dimension();
        assert!(value.rows() == m && value.columns() == 1, "the observation at step {k} is {}", value.shape());
        assert!(jacobian.rows() == m && jacobian.columns() == n, "its derivative is {}", jacobian.shape());
        let (expected, given) = (value.select_rows(&present), reading.values());
        let sensors = Sensors {
            matrix: dense(&jacobian.select_rows(&present)),
            innovation: DVector::from_fn(present.len(), |i, _| given[(i, 0)] - expected[(i, 0)]),
            cross: dense(&cross.select_columns(&present)),
            noise: dense(&observation.select(&present, &present)),
        };
        Ok((sensors, dense(&process)))
    }

    fn transition_at(
        &self,
        k: usize,
        point: &DVector<f64>,
    ) -> Result<(DVector<f64>, DMatrix<f64>), ExtendedObstacle<E>> {
        let Linearised { value, jacobian } =
            (self.transition)(k, &finite_column(point)?).map_err(ExtendedObstacle::Undefined)?;
        let n = point.nrows();
        assert!(value.rows() == n && value.columns() == 1, "the transition at step {k} is {}", value.shape());
        assert!(jacobian.rows() == n && jacobian.columns() == n, "its derivative is {}", jacobian.shape());
        Ok((dense_column(&value), dense(&jacobian)))
    }

    /// The law after transition k, whose noise is independent of all that was observed.
    fn propagated(&self, k: usize, before: &Moments) -> Result<Moments, ExtendedObstacle<E>> {
        let (mean, a) = self.transition_at(k, &before.mean)?;
        let noise = dense(&(self.noise)(k).process);
        Ok(Moments { mean, covariance: congruence(&a, &before.covariance) + noise })
    }

    /// The laws of x_k, …, x_{k+d−1}, the first of which is given.
    fn laws_from(&self, k: usize, first: Moments, count: NonZeroUsize) -> Result<Vec<Law<f64>>, ExtendedObstacle<E>> {
        let mut laws = vec![shown(&first)?];
        let mut law = first;
        for step in k..k + count.get() - 1 {
            law = self.propagated(step, &law)?;
            laws.push(shown(&law)?);
        }
        Ok(laws)
    }
}

fn shown<E>(moments: &Moments) -> Result<Law<f64>, ExtendedObstacle<E>> {
    Ok(Law { mean: finite_column(&moments.mean)?, covariance: finite(&moments.covariance)?, diffuse: None })
}

impl<E> From<Obstacle> for ExtendedObstacle<E> {
    fn from(obstacle: Obstacle) -> Self {
        match obstacle {
            Obstacle::Singular | Obstacle::Indefinite | Obstacle::NoInverse(_) => Self::Singular,
            Obstacle::NotFinite | Obstacle::Unconverged => Self::NotFinite,
        }
    }
}
