//! What one window of observations tells of the state at its start.

use crate::matrix::{LdlError, Matrix};
use crate::scalar::OrderedField;
use crate::stability::{Mode, Window};

/// The Gramian G(k+h,k) of the observations of one window, k = `start`, h = `length`.
///
/// WG-6: `G(k+h,k) = ∑[i=k..k+h−1] Φᵀ(i,k)Hᵀ(i)H(i)Φ(i,k),  𝒢(k) = σ{F(i), H(i), i ≤ k}`
///
/// The entry k of the path is the mode of time k; for [`Window::Printed`] i = k+1, …, k+h. The result is d×d.
///
/// # Panics
///
/// If the path is empty or ends before the window, or its modes differ in d.
///
/// # Examples
///
/// ```
/// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}, stability::{Mode, Window, gramian}};
///
/// let scalar = |value| Matrix::<Rational>::diagonal(&[ratio(value, 1)]);
/// let mode = |f, h| Mode::new(scalar(f), scalar(h), scalar(1), scalar(1));
/// let path = [mode(2, 1)?, mode(1, 3)?, mode(1, 5)?];
/// assert_eq!(gramian(&path, Window::Shifted, 0, 2), scalar(1 + 36));
/// assert_eq!(gramian(&path, Window::Printed, 0, 2), scalar(36 + 100));
/// # Ok::<(), exact_kalman::stability::ModeError<Rational>>(())
/// ```
pub fn gramian<S: OrderedField>(path: &[Mode<S>], window: Window, start: usize, length: usize) -> Matrix<S> {
    let d = path[0].states();
    let times = window.times(start, length);
    let mut transition = Matrix::identity(d);
    let mut sum = Matrix::zeros(d, d);
    for (time, mode) in path.iter().enumerate().take(times.end).skip(start) {
        if times.contains(&time) {
            let seen = mode.observation() * &transition;
            sum = sum + seen.transpose() * seen;
        }
        transition = mode.transition() * transition;
    }
    sum
}

/// A direction v ≠ 0 with vᵀGv ≤ δvᵀv: proof that λ_min(G) > δ is false, for anyone to recompute.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a direction of the state is seen too little")]
pub struct Unseen<S> {
    /// v, d×1.
    pub direction: Matrix<S>,
    /// vᵀGv.
    pub value: S,
}

/// Whether λ_min(G) > δ, exactly, by `G − δI > 0`; eigenvalues are not computed.
///
/// WG-A-delta: `A_δ(k) = {λ_min(G(k+h,k)) > δ},  δ > 0`
///
/// With δ = 0 it asks whether G is positive definite.
///
/// # Errors
///
/// [`Unseen`] with a direction if not.
///
/// # Panics
///
/// If G is not symmetric.
///
/// # Examples
///
/// ```
/// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}, stability::excites};
///
/// // Eigenvalues 1 and 3.
/// let gramian = Matrix::<Rational>::from_integers(&[[2, 1], [1, 2]]);
/// assert!(excites(&gramian, &ratio(99, 100)).is_ok());
/// let unseen = excites(&gramian, &ratio(1, 1)).unwrap_err();
/// assert_eq!((unseen.direction, unseen.value), (Matrix::from_integers(&[[-1], [1]]), ratio(2, 1)));
/// ```
pub fn excites<S: OrderedField>(gramian: &Matrix<S>, threshold: &S) -> Result<(), Unseen<S>> {
    let n = gramian.rows();
    let direction = match (gramian - Matrix::identity(n).scaled(threshold)).ldl() {
        Ok(ldl) => {
            let Some(place) = ldl.pivots.iter().position(S::is_zero) else { return Ok(()) };
            // With Lᵀv = eⱼ the form vᵀLDLᵀv is the pivot j, which is 0.
            let unit = Matrix::from_fn(n, 1, |i, _| if i == place { S::one() } else { S::zero() });
            ldl.lower.transpose().solve(&unit).unwrap_or_else(|error| unreachable!("a unit triangle: {error}"))
        }
        Err(LdlError::Indefinite(proof)) => proof.witness,
        Err(LdlError::Asymmetric { row, column }) => panic!("the Gramian is not symmetric at ({row}, {column})"),
    };
    let value = direction.transpose().congruence(gramian)[(0, 0)].clone();
    Err(Unseen { direction, value })
}
