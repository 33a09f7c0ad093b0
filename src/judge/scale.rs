//! The units in which errors are measured.

use crate::matrix::Matrix;
use crate::scalar::{Rational, Scalar};
use crate::trace::{Quantity, Values};

/// One variance per component of a vector: that of the exact answer, or where this is zero the largest that the
/// component has in the whole run, its initial variance included.
#[derive(Clone, Debug)]
pub struct Scale(Vec<Rational>);

impl Scale {
    /// The variance that sets the unit of component i.
    pub(super) fn variance(&self, i: usize) -> &Rational {
        &self.0[i]
    }

    /// The scale as a diagonal matrix.
    pub(super) fn diagonal(&self) -> Matrix<Rational> {
        Matrix::diagonal(&self.0)
    }

    /// The scale with other variances, each made of its place and what it was.
    pub(super) fn with(&self, variance: impl Fn(usize, &Rational) -> Rational) -> Self {
        Self(self.0.iter().enumerate().map(|(i, old)| variance(i, old)).collect())
    }

    fn of(covariance: &Matrix<Rational>, components: &[usize], largest: &[Rational]) -> Self {
        let zero = Rational::zero();
        let variance = |(place, &component): (usize, &usize)| {
            let own = &covariance[(place, place)];
            if *own == zero { largest[component].clone() } else { own.clone() }
        };
        Self(components.iter().enumerate().map(variance).collect())
    }
}

/// The largest variances of a run: of each state, and of each sensor's innovation.
#[derive(Clone, Debug)]
pub(super) struct Largest {
    states: Vec<Rational>,
    sensors: Vec<Rational>,
}

impl Largest {
    pub(super) fn of<'a>(
        initial: &Matrix<Rational>,
        sensors: usize,
        steps: impl Iterator<Item = (&'a [usize], &'a Values<Rational>)>,
    ) -> Self {
        let mut states: Vec<Rational> = (0..initial.rows()).map(|i| initial[(i, i)].clone()).collect();
        let mut of_sensors = vec![Rational::zero(); sensors];
        let raise = |largest: &mut Rational, value: &Rational| {
            if value > largest {
                *largest = value.clone();
            }
        };
        for (observed, values) in steps {
            for quantity in [Quantity::PredictedCovariance, Quantity::FilteredCovariance] {
                if let Some(covariance) = values.get(&quantity) {
                    states.iter_mut().enumerate().for_each(|(i, largest)| raise(largest, &covariance[(i, i)]));
                }
            }
            if let Some(covariance) = values.get(&Quantity::InnovationCovariance) {
                observed
                    .iter()
                    .enumerate()
                    .for_each(|(place, &i)| raise(&mut of_sensors[i], &covariance[(place, place)]));
            }
        }
        Self { states, sensors: of_sensors }
    }

    /// The scale of a quantity at a step with the given exact values; nothing for what is not judged.
    pub(super) fn scale(&self, quantity: Quantity, observed: &[usize], truth: &Values<Rational>) -> Option<Scale> {
        let all: Vec<usize> = (0..self.states.len()).collect();
        let (covariance, components, largest) = match quantity {
            Quantity::FilteredMean | Quantity::FilteredCovariance => {
                (Quantity::FilteredCovariance, &*all, &self.states)
            }
            Quantity::PredictedMean | Quantity::PredictedCovariance => {
                (Quantity::PredictedCovariance, &*all, &self.states)
            }
            Quantity::Innovation | Quantity::InnovationCovariance => {
                (Quantity::InnovationCovariance, observed, &self.sensors)
            }
            // Its error is one of the likelihood's factor: a likelihood of 1 is nothing special.
            Quantity::LogLikelihood => return Some(Scale(vec![Rational::one()])),
            // A gain is unique only where the innovation covariance is regular.
            _ => return None,
        };
        Some(Scale::of(truth.get(&covariance)?, components, largest))
    }
}
