//! What proves the steps of the filter, as documents that a checker reads.

use num_bigint::BigInt;

use super::CertifiedFilter;
use super::dyadics::Dyadics;
use super::enclosed::Enclosed;
use super::packed::Packed;
use super::readings::Readings;
use crate::verify::{BeliefDocument, DyadicMatrix, Hexadecimal, StepDocument};

/// What is kept of the last step, if it is wanted.
#[derive(Clone, Debug, Default)]
pub(super) struct Witness {
    is_wanted: bool,
    whitening: Option<Packed>,
    step: Option<StepDocument>,
}

impl Witness {
    /// T of the innovation of the step that is being made.
    pub(super) fn whiten(&mut self, whitening: Packed) {
        self.whitening = Some(whitening);
    }

    /// The beliefs of the step.
    pub(super) fn hold(
        &mut self,
        step: usize,
        readings: &Readings,
        predicted: Option<&Enclosed>,
        filtered: &Enclosed,
        ahead: Option<&Enclosed>,
    ) {
        let whitening = self.whitening.take();
        self.step = self.is_wanted.then(|| StepDocument {
            step,
            kept: (!readings.are_complete()).then(|| readings.kept.clone()),
            whitening: whitening.map(|whitening| full(&whitening.dyadics())),
            predicted: predicted.map(belief),
            filtered: belief(filtered),
            ahead: ahead.map(belief),
        });
    }
}

impl CertifiedFilter<'_> {
    /// The same filter, which also keeps what proves its steps.
    #[must_use]
    pub fn with_witness(mut self) -> Self {
        self.witness.is_wanted = true;
        self
    }

    /// The belief before the next step; nothing for a diffuse start, or after the end.
    pub fn belief_document(&self) -> Option<BeliefDocument> {
        self.belief.as_ref().map(|enclosed| BeliefDocument { gain: None, balance: None, ..belief(enclosed) })
    }

    /// What proves the last step, once; nothing unless [it is wanted](Self::with_witness).
    pub fn step_document(&mut self) -> Option<StepDocument> {
        self.witness.step.take()
    }
}

fn belief(enclosed: &Enclosed) -> BeliefDocument {
    BeliefDocument {
        gain: enclosed.proof.gain.as_ref().map(|gain| full(&gain.dyadics())),
        balance: enclosed.proof.balance,
        covariance: triangle(&enclosed.covariance.dyadics()),
        gap: triangle(&enclosed.gap.dyadics()),
        mean: full(&enclosed.mean.dyadics()),
        ellipsoid: triangle(&enclosed.ellipsoid.dyadics()),
    }
}

pub(super) fn full(matrix: &Dyadics) -> DyadicMatrix {
    written(matrix, |_| matrix.mantissas.columns())
}

/// The lower triangle of a symmetric matrix.
pub(super) fn triangle(matrix: &Dyadics) -> DyadicMatrix {
    written(matrix, |i| i + 1)
}

/// The matrix without the powers of two that all entries share.
fn written(matrix: &Dyadics, columns: impl Fn(usize) -> usize) -> DyadicMatrix {
    let shared = matrix.mantissas.entries().iter().filter_map(BigInt::trailing_zeros).min().unwrap_or(0);
    let entry = |i, j| Hexadecimal(&matrix.mantissas[(i, j)] >> shared);
    let exponent = if matrix.is_zero() { 0 } else { matrix.exponent + i64::try_from(shared).unwrap_or(i64::MAX) };
    DyadicMatrix {
        exponent,
        rows: (0..matrix.rows()).map(|i| (0..columns(i)).map(|j| entry(i, j)).collect()).collect(),
    }
}
