//! Writes cases down: matrices as one reads them, `"1 0.1; 0 1"`.

use crate::model::{Before, Timing};
use crate::protocol::{
    Along, Case, CaseFormat, Entry, Expect, InitialLaw, InputTerm, Matrices, NoiseLaw, Numbers, Rows,
};

/// A case in the making. It begins as a constant scalar state, read with noise of variance 1.
#[derive(Clone)]
pub(super) struct Draft(Case);

fn vector(text: &str) -> Vec<Entry> {
    text.split_whitespace().map(Entry::from).collect()
}

fn rows(text: &str) -> Rows {
    text.split(';').map(vector).collect()
}

/// One matrix per observation; an empty text where no observation depends on it.
fn along<T: AsRef<str>>(texts: impl IntoIterator<Item = T>) -> Matrices {
    Along::PerStep(
        texts.into_iter().map(|text| Some(text.as_ref()).filter(|text| !text.is_empty()).map(rows)).collect(),
    )
}

/// A scaled whole number as a decimal: `thousandths(-1250)` is "-1.250".
pub(super) fn thousandths(value: i64) -> String {
    let sign = if value < 0 { "-" } else { "" };
    format!("{sign}{}.{:03}", value.abs() / 1000, value.abs() % 1000)
}

/// Whole numbers that look like readings: a fixed linear congruence, in −range ..= range.
pub(super) fn scatter(seed: i64, count: i64, range: i64) -> impl Iterator<Item = i64> {
    let mut state = seed;
    (0..count).map(move |_| {
        state = (state * 75 + 74) % 65537;
        state % (2 * range + 1) - range
    })
}

impl Draft {
    pub(super) fn new(id: &str, about: &str, flags: &[&str]) -> Self {
        let one = || Along::Constant(rows("1"));
        Self(Case {
            format: CaseFormat::One,
            id: id.to_owned(),
            about: about.to_owned(),
            numbers: Numbers::Binary64,
            expect: Expect::Estimate,
            flags: flags.iter().map(ToString::to_string).collect(),
            timing: Timing::Departing,
            initial: InitialLaw {
                before: Before::Observation,
                mean: vector("0"),
                covariance: rows("1"),
                diffuse: None,
                allow_indefinite: false,
            },
            transition: one(),
            observation: one(),
            noise: NoiseLaw::Covariances { process: Along::Constant(rows("0")), cross: None, observation: one() },
            input: None,
            observation_input: None,
            rules: std::collections::BTreeMap::new(),
            observations: Vec::new(),
        })
    }

    pub(super) fn starting(mut self, mean: &str, covariance: &str) -> Self {
        self.0.initial.mean = vector(mean);
        self.0.initial.covariance = rows(covariance);
        self
    }

    pub(super) fn diffuse(mut self, part: &str) -> Self {
        self.0.initial.diffuse = Some(rows(part));
        self
    }

    pub(super) fn before_transition(mut self) -> Self {
        self.0.initial.before = Before::Transition;
        self
    }

    pub(super) fn arriving(mut self) -> Self {
        self.0.timing = Timing::Arriving;
        self
    }

    pub(super) fn transition(mut self, matrix: &str) -> Self {
        self.0.transition = Along::Constant(rows(matrix));
        self
    }

    pub(super) fn transitions<T: AsRef<str>>(mut self, matrices: impl IntoIterator<Item = T>) -> Self {
        self.0.transition = along(matrices);
        self
    }

    pub(super) fn observation(mut self, matrix: &str) -> Self {
        self.0.observation = Along::Constant(rows(matrix));
        self
    }

    pub(super) fn observation_matrices<T: AsRef<str>>(mut self, matrices: impl IntoIterator<Item = T>) -> Self {
        self.0.observation = along(matrices);
        self
    }

    pub(super) fn noise(mut self, process: &str, observation: &str) -> Self {
        let (process, observation) = (Along::Constant(rows(process)), Along::Constant(rows(observation)));
        self.0.noise = NoiseLaw::Covariances { process, cross: None, observation };
        self
    }

    pub(super) fn varying_noise<T: AsRef<str>>(
        mut self,
        process: impl IntoIterator<Item = T>,
        observation: impl IntoIterator<Item = T>,
    ) -> Self {
        self.0.noise = NoiseLaw::Covariances { process: along(process), cross: None, observation: along(observation) };
        self
    }

    pub(super) fn cross(mut self, covariance: &str) -> Self {
        if let NoiseLaw::Covariances { cross, .. } = &mut self.0.noise {
            *cross = Some(Along::Constant(rows(covariance)));
        }
        self
    }

    pub(super) fn factors(mut self, process: &str, observation: &str) -> Self {
        let (process, observation) = (Along::Constant(rows(process)), Along::Constant(rows(observation)));
        self.0.noise = NoiseLaw::Factors { process, observation };
        self
    }

    pub(super) fn input<T: AsRef<str>>(mut self, matrix: &str, vectors: impl IntoIterator<Item = T>) -> Self {
        let vectors = vectors.into_iter().map(|text| Some(vector(text.as_ref()))).collect();
        self.0.input = Some(InputTerm { matrix: Some(Along::Constant(rows(matrix))), vector: Along::PerStep(vectors) });
        self
    }

    pub(super) fn observation_input(mut self, constant: &str) -> Self {
        self.0.observation_input = Some(InputTerm { matrix: None, vector: Along::Constant(vector(constant)) });
        self
    }

    pub(super) fn rule(mut self, field: &str, text: &str) -> Self {
        self.0.rules.insert(field.to_owned(), text.to_owned());
        self
    }

    pub(super) fn expecting(mut self, expect: Expect) -> Self {
        self.0.expect = expect;
        self
    }

    /// The case with its readings: one text per step, `-` for an entry that is missing, empty if all are.
    pub(super) fn reading<T: AsRef<str>>(mut self, readings: impl IntoIterator<Item = T>) -> Case {
        let entry = |text: &str| if text == "-" { None } else { Some(Entry::from(text)) };
        let reading = |text: &str| (!text.is_empty()).then(|| text.split_whitespace().map(entry).collect());
        self.0.observations = readings.into_iter().map(|text| reading(text.as_ref())).collect();
        self.0
    }
}
