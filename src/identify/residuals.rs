//! The covariances of one-step and two-step residuals: what is known of V and W without a filter.

use crate::matrix::Matrix;
use crate::scalar::Scalar;

/// B(1) and B(2), the covariances of y(k) − Ay(k−1) and of y(k) − A²y(k−2), or estimates of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ResidualCovariances<S> {
    /// B(1), p×p.
    pub one_step: Matrix<S>,
    /// B(2), p×p.
    pub two_step: Matrix<S>,
}

impl<S: Scalar> ResidualCovariances<S> {
    /// Those of the system AK-1.1, AK-1.2 with the given parameters.
    ///
    /// AK-B.1: `B(1) = E[(y(k) − Ay(k−1))(y(k) − Ay(k−1))ᵀ] = V + W + AWAᵀ`
    ///
    /// AK-B.2: `B(2) = E[(y(k) − A²y(k−2))(y(k) − A²y(k−2))ᵀ] = V + W + AVAᵀ + A²W(A²)ᵀ`
    ///
    /// Shapes: all p×p.
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    pub fn of_system(transition: &Matrix<S>, process: &Matrix<S>, observation: &Matrix<S>) -> Self {
        let (a, v, w) = (transition, process, observation);
        let both = v + w;
        Self { one_step: &both + a.congruence(w), two_step: both + a.congruence(v) + (a * a).congruence(w) }
    }
}
