//! The documents of certificates: what a checker reads, and nothing of what it means.

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

use super::hexadecimal::Hexadecimal;
use super::written::bounded;

/// The most rows, and entries of a row, that a matrix may have.
pub const MAXIMAL_ROWS: usize = 512;

/// The largest magnitude of the exponent of a dyadic number.
pub const MAXIMAL_EXPONENT: i64 = 1 << 20;

/// The most bytes of a line of a certificate: 64 MiB.
pub const MAXIMAL_LINE_BYTES: usize = 64 << 20;

/// A matrix of integers times one power of two.
///
/// A symmetric one has the lower triangle alone: row i has i + 1 entries.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DyadicMatrix {
    /// e of 2ᵉ.
    #[serde(deserialize_with = "super::written::exponent")]
    pub exponent: i64,
    /// The integers, by rows.
    #[serde(deserialize_with = "bounded")]
    pub rows: Vec<Vec<Hexadecimal>>,
}

/// An integer times a power of two.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DyadicNumber {
    /// e of 2ᵉ.
    #[serde(deserialize_with = "super::written::exponent")]
    pub exponent: i64,
    /// The integer.
    pub mantissa: Hexadecimal,
}

/// The first line of the certificate of a filter.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FilterHeader {
    /// What it certifies, and the version.
    pub certificate: FilterFormat,
    /// The document of the case.
    pub case: Box<RawValue>,
    /// The belief before step 0, enclosed.
    pub start: BeliefDocument,
}

/// The format of the certificate of a filter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum FilterFormat {
    /// The only version so far.
    #[default]
    #[serde(rename = "exact-kalman filter 1")]
    One,
}

/// A line of the certificate of a filter: one step.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StepDocument {
    /// The number of the step, from 0.
    pub step: usize,
    /// The sensors that are used; all that are observed where nothing is said.
    #[serde(default, deserialize_with = "super::written::present", skip_serializing_if = "Option::is_none")]
    pub kept: Option<Vec<usize>>,
    /// T, with T Σ Tᵀ near the identity; where something is read.
    #[serde(default, deserialize_with = "super::written::present", skip_serializing_if = "Option::is_none")]
    pub whitening: Option<DyadicMatrix>,
    /// The state that is read, before the reading; where a transition arrives in it.
    #[serde(default, deserialize_with = "super::written::present", skip_serializing_if = "Option::is_none")]
    pub predicted: Option<BeliefDocument>,
    /// The state given the reading.
    pub filtered: BeliefDocument,
    /// The state after the transition that departs, given the reading.
    #[serde(default, deserialize_with = "super::written::present", skip_serializing_if = "Option::is_none")]
    pub ahead: Option<BeliefDocument>,
}

/// A belief that is enclosed: `−W ≤ P − P̃ ≤ W`, `(x̂ − x̃)(x̂ − x̃)ᵀ ≤ E`, and what helps to prove it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BeliefDocument {
    /// K̃, where a reading is used.
    #[serde(default, deserialize_with = "super::written::present", skip_serializing_if = "Option::is_none")]
    pub gain: Option<DyadicMatrix>,
    /// k of α = 2⁻ᵏ, where two errors of the mean are added.
    #[serde(default, deserialize_with = "super::written::present", skip_serializing_if = "Option::is_none")]
    pub balance: Option<i64>,
    /// P̃, symmetric.
    pub covariance: DyadicMatrix,
    /// W, symmetric.
    pub gap: DyadicMatrix,
    /// x̃, n×1.
    pub mean: DyadicMatrix,
    /// E, symmetric.
    pub ellipsoid: DyadicMatrix,
}

/// The last line of the certificate of a filter.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FilterEnd {
    /// How many steps there are.
    pub steps: usize,
    /// The SHA-256 of all bytes before this line.
    pub sha256: String,
}
