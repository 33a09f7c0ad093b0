//! The law with which a system starts.

use crate::matrix::Matrix;

/// What the initial law comes before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Before {
    /// It is the law of x_0, before y_0 is read.
    Observation,
    /// It is the law of the state from which transition 0 leads to x_0 (CKS-A2: x̂(0), P(0) given y(0)).
    Transition,
}

/// The initial belief (CKS-A2, HV-C4b): mean, covariance, and a diffuse part if there is one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Initial<T> {
    /// What it comes before.
    pub before: Before,
    /// The mean, n×1.
    pub mean: Matrix<T>,
    /// The covariance, n×n.
    pub covariance: Matrix<T>,
    /// P∞, n×n: the covariance is `covariance + κ·diffuse` as κ → ∞.
    pub diffuse: Option<Matrix<T>>,
    /// Runs the recursion even if the covariance is not positive semidefinite, which no random vector
    /// has. What comes out are then numbers, not conditional moments: variances and pseudo-determinants may be
    /// negative, and a contradiction says nothing about the data. Not together with a diffuse part.
    pub allow_indefinite: bool,
}

impl<T> Initial<T> {
    /// A belief with the given moments and no diffuse part.
    pub fn new(before: Before, mean: Matrix<T>, covariance: Matrix<T>) -> Self {
        Self { before, mean, covariance, diffuse: None, allow_indefinite: false }
    }

    /// The belief of the images of the entries, or the first failure.
    pub(super) fn try_map<U, E>(&self, mut image: impl FnMut(&T) -> Result<U, E>) -> Result<Initial<U>, E> {
        Ok(Initial {
            before: self.before,
            mean: self.mean.try_map(&mut image)?,
            covariance: self.covariance.try_map(&mut image)?,
            diffuse: self.diffuse.as_ref().map(|part| part.try_map(&mut image)).transpose()?,
            allow_indefinite: self.allow_indefinite,
        })
    }
}
