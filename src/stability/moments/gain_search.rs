//! Gains, one for each mode, that may prove a moment bounded. Nothing here proves anything: what is found is checked elsewhere.

use crate::matrix::Matrix;
use crate::scalar::{Dyadic, Rational, Scalar, Toward, ratio};
use crate::stability::ModeProcess;

/// Steps of the iterations: their gains settle long before covariances do.
const STEPS: usize = 48;
/// Bits to which covariances and gains are rounded.
const BITS: u64 = 24;
/// The size of covariances beside which the noise is small.
const LARGE: i64 = 1 << 20;

impl ModeProcess<Rational> {
    /// Gains worth trying, likely ones first: of the coupled Riccati equation, of the same with little noise, of least squares.
    pub(super) fn likely_gains(&self) -> impl Iterator<Item = Vec<Matrix<Rational>>> + '_ {
        (0..3).map(|search| match search {
            0 => self.riccati_gains(),
            1 => self.gains_for_large_covariances(),
            _ => self.least_squares_gains(),
        })
    }

    /// Of X(j) ← ∑ Pr(from i | in j) φᵢ(X(i)), which bounds the mean covariance in each mode.
    fn riccati_gains(&self) -> Vec<Matrix<Rational>> {
        let mut law = self.initial().to_vec();
        let mut covariances = vec![Matrix::identity(self.states()); law.len()];
        for _ in 0..STEPS {
            let weighted: Vec<_> =
                (0..law.len()).map(|i| self.modes()[i].step(&covariances[i]).next.scaled(&law[i])).collect();
            let next: Vec<Rational> = self.arriving(&law, Rational::plus, Rational::times);
            let sums = self.arriving(&weighted, |sum, term| sum + term, Matrix::scaled);
            for (mode, sum) in sums.iter().enumerate() {
                // A mode that is left for good keeps what it had.
                if let Ok(weight) = Rational::one().over(&next[mode]) {
                    covariances[mode] = rounded(&sum.scaled(&weight));
                }
            }
            law = next;
        }
        self.gains_at(&covariances)
    }

    /// Of X(j) ← c·∑ T(i, j) φᵢ(X(i)) with covariances kept so large that noise hardly matters: at the fixed point these gains
    /// have the least rate of growth.
    fn gains_for_large_covariances(&self) -> Vec<Matrix<Rational>> {
        let size = Rational::from_integer(LARGE.into());
        let mut covariances = vec![Matrix::identity(self.states()).scaled(&size); self.modes().len()];
        for _ in 0..STEPS {
            let images: Vec<_> =
                self.modes().iter().zip(&covariances).map(|(mode, covariance)| mode.step(covariance).next).collect();
            let sums = self.arriving(&images, |sum, term| sum + term, Matrix::scaled);
            let total = sums.iter().fold(Rational::zero(), |total, sum| total.plus(&sum.trace()));
            let Ok(factor) = size.over(&total) else { break };
            covariances = sums.iter().map(|sum| rounded(&sum.scaled(&factor))).collect();
        }
        self.gains_at(&covariances)
    }

    fn least_squares_gains(&self) -> Vec<Matrix<Rational>> {
        let gain = |h: &Matrix<Rational>| h.pseudo_inverse().unwrap_or_else(|_| h.transpose().scaled(&ratio(0, 1)));
        self.modes().iter().map(|mode| gain(mode.observation())).collect()
    }

    /// ∑ T(i, j) x(i) for each j.
    fn arriving<T: Clone>(&self, from: &[T], add: impl Fn(&T, &T) -> T, scale: impl Fn(&T, &Rational) -> T) -> Vec<T> {
        let term = |i: usize, j: usize| scale(&from[i], &self.transition()[(i, j)]);
        let sum = |j: usize| (1..from.len()).fold(term(0, j), |sum, i| add(&sum, &term(i, j)));
        (0..from.len()).map(sum).collect()
    }

    fn gains_at(&self, covariances: &[Matrix<Rational>]) -> Vec<Matrix<Rational>> {
        self.modes().iter().zip(covariances).map(|(mode, covariance)| rounded(&mode.step(covariance).gain)).collect()
    }
}

fn rounded(matrix: &Matrix<Rational>) -> Matrix<Rational> {
    matrix.map(|entry| Dyadic::rounded(entry, BITS, Toward::Below).value().unwrap_or_else(|| entry.clone()))
}
