//! The document of a certificate on a steady state.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::digest::sha256;
use super::document::{DyadicMatrix, DyadicNumber};
use super::rejection::{Condition, Rejection, wrong};
use super::written::{Unrepeated, bounded, present};

/// A certificate on the stabilising solution of a Riccati equation.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "Members", into = "Members")]
pub struct SteadyDocument {
    /// The document of the model.
    pub model: Value,
    /// What is said of it.
    pub evidence: SteadyEvidence,
}

/// What proves that there is a stabilising solution, and where, or that there is none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SteadyEvidence {
    /// A set of covariances that the recursion maps into itself, and a quadratic form that all closed loops shrink.
    Stabilising(Stabilising),
    /// N with `A N = N Λ`, `H N = 0` and ρ(Λ) ≥ 1.
    Unobservable {
        /// N, of full column rank.
        basis: RationalRows,
        /// Λ
        map: RationalRows,
    },
    /// M with `[M −Y] · cov(w; v) = 0`, `M A − Y H = Λ M` and an eigenvalue of Λ of modulus one.
    Unreachable {
        /// M, of full row rank.
        basis: RationalRows,
        /// Y
        injection: RationalRows,
        /// Λ
        map: RationalRows,
        /// Where z + 1/z has such an eigenvalue; nothing where one is ±1.
        between: Option<[String; 2]>,
    },
}

/// Fractions in decimal, by rows.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct RationalRows(#[serde(deserialize_with = "bounded")] pub Vec<Vec<String>>);

/// What encloses the stabilising solution.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stabilising {
    /// S̃, symmetric.
    pub solution: DyadicMatrix,
    /// E, symmetric: −E ≤ S − S̃ ≤ E.
    pub gap: DyadicMatrix,
    /// K̃
    pub gain: DyadicMatrix,
    /// T
    pub whitening: DyadicMatrix,
    /// X, symmetric.
    pub shape: DyadicMatrix,
    /// r²
    pub rate_squared: DyadicNumber,
    /// k of β = 2⁻ᵏ, where the closed loop is not known exactly.
    pub balance: Option<i64>,
    /// The entries of the reading that are used, in increasing order; nothing if all are.
    pub kept: Option<Vec<usize>>,
}

impl SteadyDocument {
    /// Reads one document and compares its digest.
    ///
    /// # Errors
    ///
    /// What is wrong with it.
    pub fn parse(text: &str) -> Result<Self, Rejection> {
        let refused = |message: String| wrong(Condition::Document, message);
        if !text.trim_start().starts_with('{') {
            return Err(refused("an object is expected".to_owned()));
        }
        let members: Members = serde_json::from_str(text).map_err(|error| refused(error.to_string()))?;
        // The model is any value, of which the last of two members would count.
        serde_json::from_str::<Unrepeated>(text).map_err(|error| refused(error.to_string()))?;
        let stated = members.sha256.clone();
        let document = Self::try_from(members).map_err(|message| refused(message.to_owned()))?;
        let digest = document.digest();
        if stated == digest {
            return Ok(document);
        }
        let message = format!("sha256 {stated} is stated and {digest} is right: something was changed");
        Err(wrong(Condition::Digest, message))
    }

    /// The SHA-256 of the document without that member, on one line and with sorted keys.
    pub fn digest(&self) -> String {
        let members = Members::without_digest(self.clone());
        // A document of strings, numbers and lists has a value.
        let mut value = serde_json::to_value(members).unwrap_or_default();
        if let Value::Object(members) = &mut value {
            members.remove("sha256");
        }
        sha256(value.to_string().as_bytes())
    }

    /// The document on one line, with its digest.
    pub fn to_line(&self) -> String {
        let members = Members::from(self.clone());
        serde_json::to_value(members).unwrap_or_default().to_string()
    }
}

/// The format of a certificate on a steady state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
enum SteadyFormat {
    #[default]
    #[serde(rename = "exact-kalman steady 1")]
    One,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Verdict {
    #[default]
    Stabilising,
    Unobservable,
    Unreachable,
}

/// The members of the document, of which each verdict has its own.
#[derive(Clone, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Members {
    certificate: SteadyFormat,
    model: Value,
    verdict: Verdict,
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    solution: Option<DyadicMatrix>,
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    gap: Option<DyadicMatrix>,
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    gain: Option<DyadicMatrix>,
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    whitening: Option<DyadicMatrix>,
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    shape: Option<DyadicMatrix>,
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    rate_squared: Option<DyadicNumber>,
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    balance: Option<i64>,
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    kept: Option<Vec<usize>>,
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    basis: Option<RationalRows>,
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    injection: Option<RationalRows>,
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    map: Option<RationalRows>,
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    between: Option<[String; 2]>,
    sha256: String,
}

impl Members {
    fn without_digest(document: SteadyDocument) -> Self {
        let members = match document.evidence {
            SteadyEvidence::Stabilising(Stabilising {
                solution,
                gap,
                gain,
                whitening,
                shape,
                rate_squared,
                balance,
                kept,
            }) => Self {
                solution: Some(solution),
                gap: Some(gap),
                gain: Some(gain),
                whitening: Some(whitening),
                shape: Some(shape),
                rate_squared: Some(rate_squared),
                balance,
                kept,
                ..Self::default()
            },
            SteadyEvidence::Unobservable { basis, map } => {
                Self { verdict: Verdict::Unobservable, basis: Some(basis), map: Some(map), ..Self::default() }
            }
            SteadyEvidence::Unreachable { basis, injection, map, between } => Self {
                verdict: Verdict::Unreachable,
                basis: Some(basis),
                injection: Some(injection),
                map: Some(map),
                between,
                ..Self::default()
            },
        };
        Self { model: document.model, ..members }
    }
}

impl From<SteadyDocument> for Members {
    fn from(document: SteadyDocument) -> Self {
        let sha256 = document.digest();
        Self { sha256, ..Self::without_digest(document) }
    }
}

impl TryFrom<Members> for SteadyDocument {
    type Error = &'static str;

    fn try_from(members: Members) -> Result<Self, Self::Error> {
        let evidence = match members {
            Members {
                verdict: Verdict::Stabilising,
                solution: Some(solution),
                gap: Some(gap),
                gain: Some(gain),
                whitening: Some(whitening),
                shape: Some(shape),
                rate_squared: Some(rate_squared),
                balance,
                kept,
                basis: None,
                injection: None,
                map: None,
                between: None,
                ..
            } => SteadyEvidence::Stabilising(Stabilising {
                solution,
                gap,
                gain,
                whitening,
                shape,
                rate_squared,
                balance,
                kept,
            }),
            Members {
                verdict,
                basis: Some(basis),
                injection,
                map: Some(map),
                between,
                solution: None,
                gap: None,
                gain: None,
                whitening: None,
                shape: None,
                rate_squared: None,
                balance: None,
                kept: None,
                ..
            } => match (verdict, injection) {
                (Verdict::Unobservable, None) if between.is_none() => SteadyEvidence::Unobservable { basis, map },
                (Verdict::Unreachable, Some(injection)) => {
                    SteadyEvidence::Unreachable { basis, injection, map, between }
                }
                _ => return Err(MEMBERS),
            },
            _ => return Err(MEMBERS),
        };
        Ok(Self { model: members.model, evidence })
    }
}

const MEMBERS: &str = "the members do not fit the verdict: `stabilising` has `solution`, `gap`, `gain`, `whitening`, \
    `shape`, `rate_squared` and perhaps `balance` and `kept`; `unobservable` has `basis` and `map`; `unreachable` has `basis`, \
    `injection`, `map` and perhaps `between`";
