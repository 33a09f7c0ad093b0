//! Weights, mean and covariance of the conditional law.

use super::average::{Weighted, average};
use super::{Enclosed, Evidence, Linear, Posterior, PosteriorComponent, TooWide};
use crate::matrix::Matrix;
use crate::scalar::{Rational, Scalar, ratio};

impl Posterior<Rational> {
    /// The probabilities of the components given the readings, each a fraction or with a relative width of at most
    /// 2^−bits.
    ///
    /// # Errors
    ///
    /// [`TooWide`] where a probability is too small.
    pub fn weights(&self, bits: u64) -> Result<Vec<Enclosed>, TooWide> {
        let places = 0..self.components.len();
        let indicator = |chosen: usize, i: usize| ratio(i64::from(i == chosen), 1);
        places.map(|chosen| average(&self.weighted(|i, _| indicator(chosen, i)), bits)).collect()
    }

    /// The best estimate of the state, n entries, each a fraction or with a relative width of at most 2^−bits.
    ///
    /// SM-MMSE: `X̂(t+1) = E[X°(t+1) | Y(0), …, Y(t)]`
    ///
    /// SM-4.2: `X̂(t+1) = X̄(t+1) + Q*(t+1) ∫ z ω(z) dF(z) / ∫ ω(z) dF(z),  ω(z) = exp(zᵀB̄(t+1) − ½ zᵀR*(t+1)z)`
    ///
    /// # Errors
    ///
    /// [`TooWide`] where an entry is irrational and too close to zero.
    pub fn mean(&self, bits: u64) -> Result<Vec<Enclosed>, TooWide> {
        (0..self.states())
            .map(|row| average(&self.weighted(|_, part| part.state.mean()[(row, 0)].clone()), bits))
            .collect()
    }

    /// By how much the best estimate differs from the best affine one, n entries, each a fraction or with a relative width
    /// of at most 2^−bits.
    ///
    /// SM-4.31: `X̂(t+1) − X̂ᴷ(t+1) = Q*(t+1) ∫ {z − [R*(t+1) + Δ⁻¹]⁻¹[B̄(t+1) + Δ⁻¹μ]} ω(z) dF(z) / ∫ ω(z) dF(z),  ω(z) = exp(zᵀB̄(t+1) − ½ zᵀR*(t+1)z)`
    ///
    /// # Errors
    ///
    /// As for [`Posterior::mean`].
    ///
    /// # Panics
    ///
    /// If the estimate has another dimension.
    pub fn difference(&self, linear: &Linear<Rational>, bits: u64) -> Result<Vec<Enclosed>, TooWide> {
        let away =
            |part: &PosteriorComponent<Rational>, row| part.state.mean()[(row, 0)].minus(&linear.estimate[(row, 0)]);
        (0..self.states()).map(|row| average(&self.weighted(|_, part| away(part, row)), bits)).collect()
    }

    /// The covariance of the state given the readings, n×n: `Σ pᵢCᵢ + Σ_{i<j} pᵢpⱼ(mᵢ − mⱼ)(mᵢ − mⱼ)ᵀ`, where no difference of
    /// large numbers is left. It depends on the readings.
    ///
    /// # Errors
    ///
    /// As for [`Posterior::mean`].
    pub fn covariance(&self, bits: u64) -> Result<Matrix<Enclosed>, TooWide> {
        let n = self.states();
        let places = (0..n).flat_map(|row| (0..n).map(move |column| (row, column)));
        let entries: Vec<Enclosed> =
            places.map(|(row, column)| average(&self.pairs(row, column), bits)).collect::<Result<_, _>>()?;
        Ok(Matrix::from_fn(n, n, |row, column| entries[row * n + column].clone()))
    }

    fn states(&self) -> usize {
        self.components.first().map_or(0, |component| component.state.dimension())
    }

    fn weighted(&self, value: impl Fn(usize, &PosteriorComponent<Rational>) -> Rational) -> Vec<Weighted> {
        let parts = self.components.iter().enumerate();
        parts.map(|(i, part)| (part.evidence.clone(), value(i, part))).collect()
    }

    /// The covariance as an average over pairs of components: of `½(Cᵢ + Cⱼ) + ½(mᵢ − mⱼ)(mᵢ − mⱼ)ᵀ`.
    fn pairs(&self, row: usize, column: usize) -> Vec<Weighted> {
        let half = ratio(1, 2);
        let pair = |one: &PosteriorComponent<Rational>, other: &PosteriorComponent<Rational>| {
            let away = |place| one.state.mean()[(place, 0)].minus(&other.state.mean()[(place, 0)]);
            let inner = one.state.covariance()[(row, column)].plus(&other.state.covariance()[(row, column)]);
            (joint(&one.evidence, &other.evidence), inner.plus(&away(row).times(&away(column))).times(&half))
        };
        self.components.iter().flat_map(|one| self.components.iter().map(move |other| pair(one, other))).collect()
    }
}

/// The evidence for two independent copies.
fn joint(one: &Evidence<Rational>, other: &Evidence<Rational>) -> Evidence<Rational> {
    Evidence {
        weight: one.weight.times(&other.weight),
        determinant: one.determinant.times(&other.determinant),
        exponent: one.exponent.plus(&other.exponent),
    }
}
