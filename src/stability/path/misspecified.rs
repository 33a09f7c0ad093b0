//! A filter that was given wrong noise covariances.

use crate::matrix::{Matrix, Shape};
use crate::scalar::OrderedField;
use crate::stability::Mode;

/// One time of a filter that believes in other noise than there is; F and H are those of the system.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Misspecified<S> {
    believed: Mode<S>,
    actual: Mode<S>,
}

/// The filter computes its gain for another F or H than that of the system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the believed and the actual mode differ in more than their noise")]
pub struct OtherSystem;

/// What the filter believes of its error, and what is true.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ErrorCovariances<S> {
    /// P(k) of the equation with the believed noise, d×d.
    pub believed: Matrix<S>,
    /// The covariance of x̃(k) under the actual noise, d×d.
    pub actual: Matrix<S>,
}

impl<S: OrderedField> Misspecified<S> {
    /// The filter is given `believed`, the system is `actual`.
    ///
    /// # Errors
    ///
    /// [`OtherSystem`] if their F or H differ.
    pub fn new(believed: Mode<S>, actual: Mode<S>) -> Result<Self, OtherSystem> {
        let same = believed.transition() == actual.transition() && believed.observation() == actual.observation();
        if same { Ok(Self { believed, actual }) } else { Err(OtherSystem) }
    }

    /// The mode that the filter is given.
    pub fn believed(&self) -> &Mode<S> {
        &self.believed
    }

    /// The mode of the system.
    pub fn actual(&self) -> &Mode<S> {
        &self.actual
    }
}

/// Believed and actual error covariances at the times 0, …, n along n modes: the error of WG-72 with the gain that the believed
/// covariances give and the noise that there is.
///
/// The actual one is linear in the actual start and noise. So if these are at most c times the believed ones, it stays at
/// most c times the believed one, on every path and at all times.
///
/// WG-72: `x̃(k+1) = F(k)(I − L(k)H(k))x̃(k) + w(k+1) − F(k)L(k)v(k)`
///
/// # Panics
///
/// If the start or a mode does not fit.
///
/// # Examples
///
/// A filter that believes in noise of variance 1 where there is 4:
///
/// ```
/// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}};
/// use exact_kalman::stability::{ErrorCovariances, Misspecified, Mode, error_covariances};
///
/// let scalar = |value| Matrix::<Rational>::diagonal(&[ratio(value, 1)]);
/// let mode = |r| Mode::new(scalar(1), scalar(1), scalar(1), scalar(r));
/// let step = Misspecified::new(mode(1)?, mode(4)?)?;
/// let start = ErrorCovariances { believed: scalar(1), actual: scalar(1) };
/// let found = error_covariances(&[step], start);
/// // 1·(1 − 1/2) + 1, and (1 − 1/2)²·1 + (1/2)²·4 + 1
/// assert_eq!(found[1].believed[(0, 0)], ratio(3, 2));
/// assert_eq!(found[1].actual[(0, 0)], ratio(9, 4));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn error_covariances<S: OrderedField>(
    path: &[Misspecified<S>],
    start: ErrorCovariances<S>,
) -> Vec<ErrorCovariances<S>> {
    let d = start.believed.rows();
    assert!(start.actual.shape() == (Shape { rows: d, columns: d }), "covariances of different shapes at the start");
    let mut covariances = vec![start];
    for (time, modes) in path.iter().enumerate() {
        let ErrorCovariances { believed, actual } = &covariances[time];
        let step = modes.believed.step(believed);
        let actual = modes.actual.lyapunov(actual, &step.gain);
        covariances.push(ErrorCovariances { believed: step.next, actual });
    }
    covariances
}
