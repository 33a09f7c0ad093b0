//! The document of a case.

use std::collections::BTreeMap;
use std::fmt;

use serde::de::{Deserializer, Error, MapAccess, Visitor};
use serde::{Deserialize, Serialize};

use super::document::{self, present};
use super::{CaseError, Entry, Matrices, Numbers, Rows, Vectors};
use crate::model::{Before, Timing};

/// A question: a model, an initial belief and observations, with number literals kept as text.
///
/// A document says nothing about whether the question is a good one: ragged matrices, literals that are no
/// numbers and covariances that are none travel as they are, since refusing them is what a subject may be asked.
/// [`Case::problem`] gives the literals their meaning.
///
/// # Examples
///
/// ```
/// use exact_kalman::protocol::Case;
///
/// let line = r#"{"format":"exact-kalman/case/1","id":"walk","timing":"departing",
///     "initial":{"before":"observation","mean":["0"],"covariance":[["1"]]},
///     "transition":[["1"]],"observation":[["1"]],
///     "noise":{"process":[["1"]],"observation":[["1"]]},"observations":[["1"],null]}"#;
/// let problem = Case::parse(line)?.problem()?;
/// assert_eq!(problem.realised()?.steps().len(), 2);
/// # Ok::<(), exact_kalman::protocol::CaseError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// The format and its version.
    pub format: CaseFormat,
    /// The name, echoed by the answer.
    pub id: String,
    /// One sentence.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub about: String,
    /// What the number strings mean.
    #[serde(default)]
    pub numbers: Numbers,
    /// What a good subject does.
    #[serde(default)]
    pub expect: Expect,
    /// What the case exercises.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub flags: Vec<String>,
    /// Which transition shares noise with which observation.
    #[serde(with = "TimingName")]
    pub timing: Timing,
    /// The initial belief.
    pub initial: InitialLaw,
    /// A, n×n.
    pub transition: Matrices,
    /// C, m×n.
    pub observation: Matrices,
    /// The driving noise.
    pub noise: NoiseLaw,
    /// B u, added to the state.
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    pub input: Option<InputTerm>,
    /// G v, added to the observation.
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    pub observation_input: Option<InputTerm>,
    /// By field, the rule by which a coefficient that depends on the data was realised.
    #[serde(default, deserialize_with = "distinct", skip_serializing_if = "BTreeMap::is_empty")]
    pub rules: BTreeMap<String, String>,
    /// The readings: nothing where all of y_k, or one entry of it, is missing.
    pub observations: Vec<Option<Vec<Option<Entry>>>>,
}

/// The format of a case, with its version.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum CaseFormat {
    /// The only version so far.
    #[default]
    #[serde(rename = "exact-kalman/case/1")]
    One,
}

/// What a good subject does with a case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Expect {
    /// It estimates.
    #[default]
    Estimate,
    /// It refuses bad input.
    Refuse,
    /// It flags data that the model says are impossible.
    Flag,
}

/// The initial belief.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InitialLaw {
    /// What it comes before.
    #[serde(with = "BeforeName")]
    pub before: Before,
    /// The mean, n entries.
    pub mean: Vec<Entry>,
    /// The covariance, n×n.
    pub covariance: Rows,
    /// P∞, n×n, for a diffuse start.
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    pub diffuse: Option<Rows>,
    /// Runs the recursion even if the covariance is not positive semidefinite.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub allow_indefinite: bool,
}

/// The driving noise, as covariances or as factors.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "NoiseFields", into = "NoiseFields")]
pub enum NoiseLaw {
    /// Covariances of the two noises and between them.
    Covariances {
        /// Q, n×n.
        process: Matrices,
        /// cov(process noise, observation noise), n×m.
        cross: Option<Matrices>,
        /// R, m×m.
        observation: Matrices,
    },
    /// Factors that multiply one common w ~ N(0, I).
    Factors {
        /// D, n×q.
        process: Matrices,
        /// F, m×q.
        observation: Matrices,
    },
}

/// A known input: the matrix times the vector, or the vector itself.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InputTerm {
    /// B (or G).
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    pub matrix: Option<Matrices>,
    /// u (or v).
    pub vector: Vectors,
}

impl Case {
    /// Reads one case.
    ///
    /// # Errors
    ///
    /// [`CaseError::TooLong`], or [`CaseError::Document`] with the path of what is wrong.
    pub fn parse(text: &str) -> Result<Self, CaseError> {
        let case: Self = document::parse(text)?;
        if case.id.is_empty() {
            let message = "is empty: answers are told apart by their ids".to_owned();
            return Err(CaseError::Document { path: "id".to_owned(), message });
        }
        Ok(case)
    }

    /// The case on one line, fields in the order of the format.
    pub fn to_line(&self) -> String {
        document::line(self)
    }

    /// The case on several lines, for files that people read: a row stays on one line.
    pub fn to_pretty(&self) -> String {
        super::pretty::indented(&self.to_line())
    }
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Timing", rename_all = "lowercase")]
enum TimingName {
    Arriving,
    Departing,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Before", rename_all = "lowercase")]
enum BeforeName {
    Observation,
    Transition,
}

/// The noise as it stands in the document: one flat object, whose keys say which kind it is.
#[derive(Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct NoiseFields {
    #[serde(deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    process: Option<Matrices>,
    #[serde(deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    cross: Option<Matrices>,
    #[serde(deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    observation: Option<Matrices>,
    #[serde(deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    process_factor: Option<Matrices>,
    #[serde(deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    observation_factor: Option<Matrices>,
}

impl TryFrom<NoiseFields> for NoiseLaw {
    type Error = &'static str;

    fn try_from(fields: NoiseFields) -> Result<Self, Self::Error> {
        match fields {
            NoiseFields {
                process: Some(process),
                cross,
                observation: Some(observation),
                process_factor: None,
                observation_factor: None,
            } => Ok(Self::Covariances { process, cross, observation }),
            NoiseFields {
                process: None,
                cross: None,
                observation: None,
                process_factor: Some(process),
                observation_factor: Some(observation),
            } => Ok(Self::Factors { process, observation }),
            _ => Err("give either `process` and `observation` (with `cross` if it is not zero), \
                or `process_factor` and `observation_factor`"),
        }
    }
}

impl From<NoiseLaw> for NoiseFields {
    fn from(noise: NoiseLaw) -> Self {
        match noise {
            NoiseLaw::Covariances { process, cross, observation } => {
                Self { process: Some(process), cross, observation: Some(observation), ..Self::default() }
            }
            NoiseLaw::Factors { process, observation } => {
                Self { process_factor: Some(process), observation_factor: Some(observation), ..Self::default() }
            }
        }
    }
}

/// A map in which each key stands once.
fn distinct<'de, D: Deserializer<'de>>(deserializer: D) -> Result<BTreeMap<String, String>, D::Error> {
    struct Distinct;

    impl<'de> Visitor<'de> for Distinct {
        type Value = BTreeMap<String, String>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("an object of texts")
        }

        fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
            let mut values = BTreeMap::new();
            while let Some((key, value)) = map.next_entry::<String, String>()? {
                if values.contains_key(&key) {
                    return Err(A::Error::custom(format_args!("duplicate key `{key}`")));
                }
                values.insert(key, value);
            }
            Ok(values)
        }
    }

    deserializer.deserialize_map(Distinct)
}
