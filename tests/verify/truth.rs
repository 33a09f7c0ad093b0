//! Whether a belief of a certificate is true, by the exact filter and the order of Loewner.

use exact_kalman::filter::filter;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Path, Timing};
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::trace::Moments;
use exact_kalman::verify::{BeliefDocument, DyadicMatrix, StepDocument};

use super::models::Q;

/// The exact moments of each step: predicted, filtered, ahead.
pub struct Truth(Vec<[Moments<Rational>; 3]>);

pub fn fractions(matrix: &DyadicMatrix) -> Q {
    let power = ratio(2, 1).pow(i32::try_from(matrix.exponent).expect("small"));
    let columns = matrix.rows.last().map_or(0, Vec::len);
    let entry = |i: usize, j: usize| {
        let row = &matrix.rows[i];
        // The lower triangle of a symmetric matrix.
        let entry = row.get(j).unwrap_or_else(|| &matrix.rows[j][i]);
        Rational::from(entry.0.clone()) * &power
    };
    Matrix::from_fn(matrix.rows.len(), columns, entry)
}

/// `−W ≤ P − P̃ ≤ W` and `(x̂ − x̃)(x̂ − x̃)ᵀ ≤ E`
pub fn holds(document: &BeliefDocument, mean: &Q, covariance: &Q) -> bool {
    let [centre, gap, middle, ellipsoid] =
        [&document.covariance, &document.gap, &document.mean, &document.ellipsoid].map(fractions);
    let (off, error) = (covariance - centre, mean - middle);
    off.loewner_le(&gap).is_ok()
        && (-&off).loewner_le(&gap).is_ok()
        && (&error * error.transpose()).loewner_le(&ellipsoid).is_ok()
}

impl Truth {
    /// Of a path that was made one reading longer, which is missing.
    pub fn of(longer: &Path<Rational>) -> Self {
        let records = match filter(longer) {
            Ok(trace) => trace.records,
            Err(error) => error.computed,
        };
        let moments = |k: usize| {
            let next = records.get(k + 1).map_or_else(|| records[k].filtered.clone(), |next| next.predicted.clone());
            [records[k].predicted.clone(), records[k].filtered.clone(), next]
        };
        Self((0..records.len()).map(moments).collect())
    }

    /// Whether all beliefs of a step are true; of one that the exact filter does not reach, none is.
    pub fn agrees(&self, k: usize, step: &StepDocument, timing: Timing) -> bool {
        let Some([predicted, filtered, ahead]) = self.0.get(k) else { return false };
        let of = |document: &Option<BeliefDocument>, moments: &Moments<Rational>| {
            document.as_ref().is_none_or(|document| holds(document, &moments.mean, &moments.covariance))
        };
        assert!(step.ahead.is_none() || (timing == Timing::Departing && k + 1 < self.0.len()), "the last is missing");
        of(&step.predicted, predicted)
            && holds(&step.filtered, &filtered.mean, &filtered.covariance)
            && of(&step.ahead, ahead)
    }
}
