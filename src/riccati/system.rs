//! The model of a map as a system, for the filters of the house.

use super::RiccatiMap;
use crate::matrix::Matrix;
use crate::model::{Before, Initial, Noise, System, Timing};
use crate::scalar::OrderedField;

impl<S: OrderedField> RiccatiMap<S> {
    /// The system with this A, V and W and the given moments of x(0).
    ///
    /// AK-1.1: `x(k+1) = A x(k) + v(k), k ≥ 0`
    ///
    /// AK-1.2: `y(k) = x(k) + w(k), k ≥ 1`
    ///
    /// The paper's y(1) is the first observation, x(0) comes before the first transition, and the noises share
    /// nothing:
    ///
    /// AK-A.v: `v(0), v(1), … i.i.d., E v = 0, cov v = V`
    ///
    /// AK-A.w: `w(1), w(2), … i.i.d., E w = 0, cov w = W, independent of v`
    ///
    /// AK-A.x: `x(0) is independent of v and w and has finite covariance`
    ///
    /// The paper supposes no normality: then the filter's means are the best *linear* estimates. The moments are checked
    /// when the system is realised.
    ///
    /// Shapes: `mean` n×1, `covariance` n×n.
    pub fn system(&self, mean: Matrix<S>, covariance: Matrix<S>) -> System<S> {
        System {
            timing: Timing::Arriving,
            initial: Initial::new(Before::Transition, mean, covariance),
            transition: self.transition().clone().into(),
            observation: Matrix::identity(self.states()).into(),
            noise: Noise::Covariances {
                process: self.state_noise().clone().into(),
                cross: None,
                observation: self.observation_noise().clone().into(),
            },
            input: None,
            observation_input: None,
        }
    }
}
