//! The results of one step, as integers over denominators.

use std::collections::BTreeMap;

use super::Wanted;
use crate::matrix::{Fractions, Matrix};
use crate::scalar::{Precision, Rational};
use crate::trace::{Quantity, Record, Values};

/// The results of one step, as integers over denominators; fractions are made of them when they are asked for.
#[derive(Clone, Debug)]
pub struct RationalStep {
    /// The named values, all but the gain, not in lowest terms.
    pub values: BTreeMap<Quantity, Fractions>,
    /// The rank of the innovation covariance, exactly.
    pub innovation_rank: usize,
}

/// The results of one step as fractions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StepValues {
    /// The named values, all but the gain.
    pub values: Values<Rational>,
    /// The rank of the innovation covariance, exactly.
    pub innovation_rank: usize,
}

impl RationalStep {
    /// The results as fractions, in lowest terms or rounded entry by entry.
    pub fn fractions(&self, precision: Precision) -> StepValues {
        let fractions = |(&quantity, matrix): (&Quantity, &Fractions)| {
            let handed_out =
                if quantity.is_covariance() { matrix.symmetric(precision) } else { matrix.entrywise(precision) };
            (quantity, handed_out)
        };
        StepValues { values: self.values.iter().map(fractions).collect(), innovation_rank: self.innovation_rank }
    }

    /// One named value as fractions in lowest terms.
    pub fn exactly(&self, quantity: Quantity) -> Option<Matrix<Rational>> {
        self.values.get(&quantity).map(|matrix| matrix.entrywise(Precision::Exact))
    }

    /// The results of a step of the recursion.
    pub(super) fn of(record: &Record<Rational>, wanted: Wanted) -> Self {
        let is_wanted = |quantity| match wanted {
            Wanted::Everything => quantity != Quantity::Gain,
            Wanted::Filtered => matches!(quantity, Quantity::FilteredMean | Quantity::FilteredCovariance),
        };
        let values = record.values().into_iter().filter(|(quantity, _)| is_wanted(*quantity));
        let values = values.map(|(quantity, matrix)| (quantity, Fractions::of(&matrix))).collect();
        Self { values, innovation_rank: record.innovation_rank }
    }
}

impl StepValues {
    /// The same results with each entry rounded, or as they are.
    pub fn rounded(self, precision: Precision) -> Self {
        let values = self.values.into_iter();
        let values = values.map(|(quantity, matrix)| (quantity, matrix.map(|entry| precision.of(entry)))).collect();
        Self { values, ..self }
    }
}
