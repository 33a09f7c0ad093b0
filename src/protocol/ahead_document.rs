//! The laws ahead of a step as they stand on the line.

use serde::{Deserialize, Serialize};

use super::answer_document::Leaf;
use super::answer_number::AnswerNumber;
use super::fault::{Fault, indexed};
use super::{LawAhead, Number, Numbers};
use crate::matrix::Matrix;

/// The key of a step.
pub(super) const KEY: &str = "ahead";

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LawDocument {
    mean: Vec<Leaf>,
    covariance: Vec<Vec<Leaf>>,
}

impl LawDocument {
    /// The literals of a law.
    pub(super) fn of<T: AnswerNumber>(law: &LawAhead<T>) -> Self {
        let row = |entries: &[T]| entries.iter().map(|entry| Leaf::Text(entry.literal())).collect();
        let LawAhead { mean, covariance } = law;
        Self { mean: row(mean.entries()), covariance: (0..covariance.rows()).map(|i| row(covariance.row(i))).collect() }
    }

    /// The law with values.
    pub(super) fn value(&self, numbers: Numbers) -> Result<LawAhead<Number>, Fault> {
        let entries = |row: &[Leaf]| indexed(row, |leaf| leaf.value(numbers));
        let mean = entries(&self.mean).map_err(|fault| fault.in_part("mean"))?;
        let covariance = indexed(&self.covariance, |row| entries(row))
            .and_then(|rows| Matrix::from_rows(rows).map_err(Fault::ragged));
        let covariance = covariance.map_err(|fault| fault.in_part("covariance"))?;
        Ok(LawAhead { mean: Matrix::column(mean), covariance })
    }
}
