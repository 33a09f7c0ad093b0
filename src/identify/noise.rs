//! V and W from the covariances of residuals.

use super::ResidualCovariances;
use crate::matrix::{Matrix, SolveError};
use crate::scalar::Field;

/// V and W, or estimates of them; estimates need not be positive semidefinite.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoiseCovariances<S> {
    /// V, p×p.
    pub process: Matrix<S>,
    /// W, p×p.
    pub observation: Matrix<S>,
}

/// A is singular: B(1) and B(2) do not determine V and W.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SingularTransition<S> {
    /// A vector x ≠ 0 with A x = 0, p×1.
    pub kernel: Matrix<S>,
}

impl<S: std::fmt::Display> std::fmt::Display for SingularTransition<S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("the transition matrix is singular, so the noise covariances are not determined")?;
        let entries: Vec<String> = self.kernel.entries().iter().map(ToString::to_string).collect();
        let text = entries.join(", ");
        if text.len() <= 120 { write!(f, ": it maps [{text}] to zero") } else { Ok(()) }
    }
}

impl<S: std::fmt::Debug + std::fmt::Display> std::error::Error for SingularTransition<S> {}

/// V and W from A, B(1) and B(2); with estimates for A, B(1) and B(2) the estimates AK-B.hat.
///
/// AK-B.W: `W = ½{B(1) + A⁻¹(B(1) − B(2))A⁻ᵀ}`
///
/// AK-B.V: `V = B(1) − W − AWAᵀ`
///
/// AK-B.hat: `Ŵ(n) = ½{B(n,1) + Â(n)⁻¹(B(n,1) − B(n,2))Â(n)⁻ᵀ},  V̂(n) = B(n,1) − Ŵ(n) − Â(n)Ŵ(n)Â(n)ᵀ`
///
/// Shapes: all p×p. Over a field of characteristic 2 there is no ½, and no answer.
///
/// # Errors
///
/// [`SingularTransition`] with x ≠ 0, A x = 0.
///
/// # Panics
///
/// If the shapes do not fit, or 1 + 1 = 0.
///
/// # Examples
///
/// ```
/// use exact_kalman::identify::{ResidualCovariances, noise_covariances};
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::scalar::{ratio, Rational};
///
/// let number = |value: Rational| Matrix::column(vec![value]);
/// let (a, v, w) = (number(ratio(9, 10)), number(ratio(4, 1)), number(ratio(1, 1)));
/// let found = noise_covariances(&a, &ResidualCovariances::of_system(&a, &v, &w))?;
/// assert_eq!((found.process, found.observation), (v, w));
/// # Ok::<(), exact_kalman::identify::SingularTransition<Rational>>(())
/// ```
pub fn noise_covariances<S: Field>(
    transition: &Matrix<S>,
    residuals: &ResidualCovariances<S>,
) -> Result<NoiseCovariances<S>, SingularTransition<S>> {
    let ResidualCovariances { one_step: b1, two_step: b2 } = residuals;
    let inverse = match transition.inverse() {
        Ok(inverse) => inverse,
        Err(SolveError::Singular { .. }) => {
            return Err(SingularTransition { kernel: transition.kernel().select_columns(&[0]) });
        }
        Err(SolveError::Undecided(_)) => unreachable!("a field decides"),
    };
    let Ok(half) = S::one().over(&S::from_integer(2)) else { panic!("½ needs 1 + 1 ≠ 0") };
    let observation = (b1 + inverse.congruence(&(b1 - b2))).scaled(&half);
    let process = b1 - &observation - transition.congruence(&observation);
    Ok(NoiseCovariances { process, observation })
}
