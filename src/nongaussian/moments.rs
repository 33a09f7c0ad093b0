//! Weights, mean and covariance of the conditional law.

use super::average::{Average, Form, Quantity};
use super::pairs::{Central, fractions};
use super::{Averages, Enclosed, Linear, Posterior, TooWide};
use crate::matrix::Matrix;
use crate::scalar::{Rational, Scalar};

impl Averages<'_> {
    /// The probabilities of the components given the readings.
    pub fn weights(&self) -> Vec<Average> {
        // One class alone leaves fractions, and with more of them no probability is one.
        let is_exact = self.classes.all.len() == 1;
        let weight = |(component, (class, share)): (usize, &(usize, Rational))| Average {
            quantity: Quantity::Weight(component),
            exact: is_exact.then(|| share.clone()),
            form: Form::Indicator(*class, share.clone()),
        };
        self.classes.members.iter().enumerate().map(weight).collect()
    }

    /// The best estimate of the state, n entries.
    ///
    /// SM-MMSE: `X̂(t+1) = E[X°(t+1) | Y(0), …, Y(t)]`
    ///
    /// SM-4.2: `X̂(t+1) = X̄(t+1) + Q*(t+1) ∫ z ω(z) dF(z) / ∫ ω(z) dF(z),  ω(z) = exp(zᵀB̄(t+1) − ½ zᵀR*(t+1)z)`
    pub fn mean(&self) -> Vec<Average> {
        (0..self.posterior.states()).map(|row| average(Quantity::Mean(row), self.means(row))).collect()
    }

    /// By how much the best estimate differs from the best affine one, n entries.
    ///
    /// SM-4.31: `X̂(t+1) − X̂ᴷ(t+1) = Q*(t+1) ∫ {z − [R*(t+1) + Δ⁻¹]⁻¹[B̄(t+1) + Δ⁻¹μ]} ω(z) dF(z) / ∫ ω(z) dF(z),  ω(z) = exp(zᵀB̄(t+1) − ½ zᵀR*(t+1)z)`
    ///
    /// # Panics
    ///
    /// If the estimate has another dimension.
    pub fn difference(&self, linear: &Linear<Rational>) -> Vec<Average> {
        let entry = |row: usize| {
            let away = self.means(row).iter().map(|mean| mean.minus(&linear.estimate[(row, 0)])).collect();
            average(Quantity::Difference(row), away)
        };
        (0..self.posterior.states()).map(entry).collect()
    }

    /// The covariance of the state given the readings, n×n: `Σ pᵢCᵢ + Σ_{i<j} pᵢpⱼ(mᵢ − mⱼ)(mᵢ − mⱼ)ᵀ`. It depends on the readings.
    pub fn covariance(&self) -> Matrix<Average> {
        let n = self.posterior.states();
        let means: Vec<Vec<Rational>> = (0..n).map(|row| self.means(row)).collect();
        let places: Vec<(usize, usize)> = (0..n).flat_map(|row| (row..n).map(move |column| (row, column))).collect();
        let entry = |&(row, column): &(usize, usize)| {
            let inner = self.classes.averages(|i| {
                let (state, class) = (&self.posterior.components[i].state, self.classes.members[i].0);
                let away = |row: usize| state.mean()[(row, 0)].minus(&means[row][class]);
                state.covariance()[(row, column)].plus(&away(row).times(&away(column)))
            });
            Central { inner, left: means[row].clone(), right: means[column].clone() }
        };
        let entries: Vec<Central> = places.iter().map(entry).collect();
        let exact = fractions(&self.classes, &entries);
        Matrix::from_fn(n, n, |row, column| {
            let wanted = (row.min(column), row.max(column));
            let place = places.iter().position(|&place| place == wanted);
            let place = place.unwrap_or_else(|| unreachable!("the upper triangle is complete"));
            Average {
                quantity: Quantity::Covariance(row, column),
                exact: exact[place].clone(),
                form: Form::Central(entries[place].clone()),
            }
        })
    }

    /// An entry of the mean, by classes.
    fn means(&self, row: usize) -> Vec<Rational> {
        self.classes.averages(|i| self.posterior.components[i].state.mean()[(row, 0)].clone())
    }
}

/// Σ cᵢ(vᵢ − ρ) = 0 holds for a fraction ρ iff all vᵢ are ρ, the cᵢ of different classes being independent.
fn average(quantity: Quantity, values: Vec<Rational>) -> Average {
    let exact = values.first().filter(|first| values.iter().all(|value| value == *first)).cloned();
    Average { quantity, exact, form: Form::Values(values) }
}

impl Posterior<Rational> {
    /// The probabilities of the components given the readings, each a fraction or with a relative width of at most
    /// 2^−bits. This and what follows compute all exponentials anew: [`Posterior::averages`] keeps them.
    ///
    /// # Errors
    ///
    /// [`TooWide`] where a probability is too small.
    pub fn weights(&self, bits: u64) -> Result<Vec<Enclosed>, TooWide> {
        let averages = self.averages();
        enclosed(&averages.weights(), averages, bits)
    }

    /// The best estimate of the state, n entries, each a fraction or with a relative width of at most 2^−bits
    /// ([`Averages::mean`]).
    ///
    /// # Errors
    ///
    /// [`TooWide`] where an entry is irrational and too close to zero.
    pub fn mean(&self, bits: u64) -> Result<Vec<Enclosed>, TooWide> {
        let averages = self.averages();
        enclosed(&averages.mean(), averages, bits)
    }

    /// By how much the best estimate differs from the best affine one, n entries, each a fraction or with a relative width
    /// of at most 2^−bits ([`Averages::difference`]).
    ///
    /// # Errors
    ///
    /// As for [`Posterior::mean`].
    ///
    /// # Panics
    ///
    /// If the estimate has another dimension.
    pub fn difference(&self, linear: &Linear<Rational>, bits: u64) -> Result<Vec<Enclosed>, TooWide> {
        let averages = self.averages();
        enclosed(&averages.difference(linear), averages, bits)
    }

    /// The covariance of the state given the readings, n×n ([`Averages::covariance`]).
    ///
    /// # Errors
    ///
    /// As for [`Posterior::mean`].
    pub fn covariance(&self, bits: u64) -> Result<Matrix<Enclosed>, TooWide> {
        let mut averages = self.averages();
        averages.covariance().try_map(|entry| averages.enclosed(entry, bits))
    }

    fn states(&self) -> usize {
        self.components.first().map_or(0, |component| component.state.dimension())
    }
}

fn enclosed(all: &[Average], mut averages: Averages<'_>, bits: u64) -> Result<Vec<Enclosed>, TooWide> {
    all.iter().map(|number| averages.enclosed(number, bits)).collect()
}
