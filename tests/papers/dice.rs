//! Small random numbers by a linear congruence.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};

/// The state of the congruence.
pub struct Dice(pub u64);

impl Dice {
    pub fn below(&mut self, count: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % count
    }

    /// From 0 to `most`.
    pub fn size(&mut self, most: u64) -> usize {
        usize::try_from(self.below(most + 1)).expect("small")
    }

    /// Between −3 and 3, sometimes a half.
    pub fn entry(&mut self) -> Rational {
        let numerator = i64::try_from(self.below(7)).expect("below seven") - 3;
        ratio(numerator, if self.below(4) == 0 { 2 } else { 1 })
    }

    pub fn matrix(&mut self, rows: usize, columns: usize) -> Matrix<Rational> {
        Matrix::from_fn(rows, columns, |_, _| self.entry())
    }

    /// CCᵀ, often singular.
    pub fn semidefinite(&mut self, n: usize) -> Matrix<Rational> {
        let columns = self.size(n as u64);
        let factor = self.matrix(n, columns);
        &factor * factor.transpose()
    }

    /// CCᵀ + εI with ε > 0.
    pub fn positive_definite(&mut self, n: usize) -> Matrix<Rational> {
        let ridge = ratio(1 + i64::try_from(self.below(3)).expect("below three"), 2);
        self.semidefinite(n) + Matrix::identity(n).scaled(&ridge)
    }
}
