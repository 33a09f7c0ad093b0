//! The sums over the data from which every estimate is computed.

use std::ops::Range;

use crate::matrix::Matrix;
use crate::scalar::Field;

/// `Σ_{k=3..n} s(k)s(k)ᵀ` with s(k) the column of y(k), y(k−1), y(k−2), one under the other.
#[derive(Clone, Debug)]
pub(super) struct LaggedSums<S> {
    dimension: usize,
    /// 3p×3p.
    joint: Matrix<S>,
}

impl<S: Field> LaggedSums<S> {
    pub(super) fn new(dimension: usize) -> Self {
        Self { dimension, joint: Matrix::zeros(3 * dimension, 3 * dimension) }
    }

    /// Adds the term k: y(k), y(k−1), y(k−2).
    pub(super) fn add(&mut self, window: [&Matrix<S>; 3]) {
        let stacked = window[0].above(window[1]).above(window[2]);
        self.joint = &self.joint + &stacked * stacked.transpose();
    }

    /// `Σ_{k=3..n} y(k−i)yᵀ(k−j)`, i and j at most 2.
    pub(super) fn of(&self, i: usize, j: usize) -> Matrix<S> {
        self.joint.block(self.part(i), self.part(j))
    }

    fn part(&self, lag: usize) -> Range<usize> {
        lag * self.dimension..(lag + 1) * self.dimension
    }
}
