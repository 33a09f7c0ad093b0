//! Products of transitions along a path.

use std::ops::Range;

use crate::matrix::Matrix;
use crate::scalar::OrderedField;
use crate::stability::Mode;

/// A transition has no inverse, so that no state can be told from a later one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the transition of time {time} has no inverse: its rank is {rank}")]
pub struct SingularTransition {
    /// The latest such time.
    pub time: usize,
    /// The rank of F(time), below d.
    pub rank: usize,
}

/// Φ(k,i) for the times i = `times.start` ≤ k = `times.end`: what takes x(i) to x(k) where there is no noise.
///
/// WG-Phi: `Φ(k,i) = F(k−1)⋯F(i) for k ≥ i+1,  Φ(i,i) = I,  Φ(i,k) = Φ⁻¹(k,i)`
///
/// The entry k of the path is the mode of time k. The result is d×d.
///
/// # Panics
///
/// If the path is empty or ends before the times, or its modes differ in d.
///
/// # Examples
///
/// ```
/// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}, stability::{Mode, inverse_transition_matrix, transition_matrix}};
///
/// let scalar = |value| Matrix::<Rational>::diagonal(&[ratio(value, 1)]);
/// let mode = |f| Mode::new(scalar(f), scalar(1), scalar(1), scalar(1));
/// let path = [mode(2)?, mode(3)?, mode(5)?];
/// assert_eq!(transition_matrix(&path, 1..3), scalar(15));
/// assert_eq!(inverse_transition_matrix(&path, 1..3)?, Matrix::diagonal(&[ratio(1, 15)]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn transition_matrix<S: OrderedField>(path: &[Mode<S>], times: Range<usize>) -> Matrix<S> {
    let start = Matrix::identity(path[0].states());
    path[times].iter().fold(start, |product, mode| mode.transition() * product)
}

/// Φ(i,k) = Φ⁻¹(k,i) for the times i = `times.start` ≤ k = `times.end`: against the direction of time.
///
/// # Errors
///
/// [`SingularTransition`] if one of F(i), …, F(k−1) is singular: then there is none.
///
/// # Panics
///
/// As for [`transition_matrix`].
pub fn inverse_transition_matrix<S: OrderedField>(
    path: &[Mode<S>],
    times: Range<usize>,
) -> Result<Matrix<S>, SingularTransition> {
    let mut product = Matrix::identity(path[0].states());
    for time in times.rev() {
        let transition = path[time].transition();
        let singular = |_| SingularTransition { time, rank: transition.rank() };
        product = transition.inverse().map_err(singular)? * product;
    }
    Ok(product)
}
