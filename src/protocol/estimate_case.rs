//! The document of a question whose start is a mixture of Gaussian laws.

use serde::{Deserialize, Serialize};

use super::document::{self, present};
use super::{
    Case, CaseError, CaseFormat, Entry, Expect, InitialLaw, InputTerm, Matrices, NoiseLaw, Numbers, Problem, Rows,
};
use crate::model::{Before, Timing};

/// A model in departing timing, a mixture as the law of its first state, and observations.
///
/// The fields are those of [`Case`] where they have the same names, but that numbers are read exactly unless the
/// document says otherwise, so that weights such as 0.1 and 0.9 add up to one.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EstimateCase {
    /// The format and its version.
    pub format: EstimateFormat,
    /// The name.
    pub id: String,
    /// One sentence.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub about: String,
    /// What the number strings mean.
    #[serde(default = "exactly")]
    pub numbers: Numbers,
    /// The law of the state before the first observation.
    pub initial_law: Vec<LawPart>,
    /// A, n×n.
    pub transition: Matrices,
    /// H, m×n.
    pub observation: Matrices,
    /// The noise of both.
    pub noise: NoiseLaw,
    /// B u, added to the state.
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    pub input: Option<InputTerm>,
    /// G v, added to the observation.
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    pub observation_input: Option<InputTerm>,
    /// The readings, as in a case.
    pub observations: Vec<Option<Vec<Option<Entry>>>>,
}

/// The format of the document, with its version.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum EstimateFormat {
    /// The only version so far.
    #[default]
    #[serde(rename = "exact-kalman/estimate/1")]
    One,
}

/// A component of the mixture.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LawPart {
    /// Its probability.
    pub weight: Entry,
    /// Its mean, n entries.
    pub mean: Vec<Entry>,
    /// Its covariance, n×n; an atom has none.
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    pub covariance: Option<Rows>,
}

fn exactly() -> Numbers {
    Numbers::Exact
}

impl EstimateCase {
    /// Reads one document.
    ///
    /// # Errors
    ///
    /// [`CaseError::TooLong`], or [`CaseError::Document`] with the path of what is wrong.
    pub fn parse(text: &str) -> Result<Self, CaseError> {
        let case: Self = document::parse(text)?;
        if case.initial_law.is_empty() {
            let message = "is empty: a law has at least one component".to_owned();
            return Err(CaseError::Document { path: "initial_law".to_owned(), message });
        }
        Ok(case)
    }

    /// The problem that starts from this component of the law alone.
    ///
    /// # Errors
    ///
    /// As for [`Case::problem`]; the component is `initial` there.
    pub fn problem_of(&self, part: &LawPart) -> Result<Problem, CaseError> {
        let n = part.mean.len();
        let zeros = || vec![vec![Entry::from("0"); n]; n];
        let case = Case {
            format: CaseFormat::One,
            id: self.id.clone(),
            about: String::new(),
            numbers: self.numbers,
            expect: Expect::Estimate,
            flags: Vec::new(),
            timing: Timing::Departing,
            initial: InitialLaw {
                before: Before::Observation,
                mean: part.mean.clone(),
                covariance: part.covariance.clone().unwrap_or_else(zeros),
                diffuse: None,
                allow_indefinite: false,
            },
            transition: self.transition.clone(),
            observation: self.observation.clone(),
            noise: self.noise.clone(),
            input: self.input.clone(),
            observation_input: self.observation_input.clone(),
            rules: std::collections::BTreeMap::new(),
            observations: self.observations.clone(),
        };
        case.problem()
    }
}
