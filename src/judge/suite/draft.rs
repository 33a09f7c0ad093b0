//! Writes cases down: matrices as one reads them, `"1 0.1; 0 1"`.

use crate::model::{Before, Timing};
use crate::protocol::{
    Along, Case, CaseFormat, Entry, Expect, InitialLaw, InputTerm, Matrices, NoiseLaw, Numbers, Rows, Vectors,
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

/// One vector per observation.
fn vectors_along<T: AsRef<str>>(texts: impl IntoIterator<Item = T>) -> Vectors {
    Along::PerStep(texts.into_iter().map(|text| Some(vector(text.as_ref()))).collect())
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

    pub(super) fn crosses<T: AsRef<str>>(mut self, matrices: impl IntoIterator<Item = T>) -> Self {
        if let NoiseLaw::Covariances { cross, .. } = &mut self.0.noise {
            *cross = Some(along(matrices));
        }
        self
    }

    pub(super) fn factors(mut self, process: &str, observation: &str) -> Self {
        let (process, observation) = (Along::Constant(rows(process)), Along::Constant(rows(observation)));
        self.0.noise = NoiseLaw::Factors { process, observation };
        self
    }

    pub(super) fn input<T: AsRef<str>>(mut self, matrix: &str, vectors: impl IntoIterator<Item = T>) -> Self {
        self.0.input = Some(InputTerm { matrix: Some(Along::Constant(rows(matrix))), vector: vectors_along(vectors) });
        self
    }

    pub(super) fn constant_input(mut self, matrix: &str, constant: &str) -> Self {
        let vector = Along::Constant(vector(constant));
        self.0.input = Some(InputTerm { matrix: Some(Along::Constant(rows(matrix))), vector });
        self
    }

    pub(super) fn inputs<T: AsRef<str>, U: AsRef<str>>(
        mut self,
        matrices: impl IntoIterator<Item = T>,
        vectors: impl IntoIterator<Item = U>,
    ) -> Self {
        self.0.input = Some(InputTerm { matrix: Some(along(matrices)), vector: vectors_along(vectors) });
        self
    }

    pub(super) fn observation_input(mut self, constant: &str) -> Self {
        self.0.observation_input = Some(InputTerm { matrix: None, vector: Along::Constant(vector(constant)) });
        self
    }

    pub(super) fn feed_through<T: AsRef<str>>(mut self, matrix: &str, vectors: impl IntoIterator<Item = T>) -> Self {
        let matrix = Some(Along::Constant(rows(matrix)));
        self.0.observation_input = Some(InputTerm { matrix, vector: vectors_along(vectors) });
        self
    }

    /// Numbers mean the nearest single-precision numbers.
    pub(super) fn single(mut self) -> Self {
        self.0.numbers = Numbers::Binary32;
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
        for flag in evident(&self.0) {
            if !self.0.flags.iter().any(|known| known == flag) {
                self.0.flags.push(flag.to_owned());
            }
        }
        self.0
    }
}

/// The flags that can be read off a document: nobody has to remember them.
fn evident(case: &Case) -> Vec<&'static str> {
    let varies = |matrices: &Matrices| matches!(matrices, Along::PerStep(_));
    let (noise_varies, correlated) = match &case.noise {
        NoiseLaw::Covariances { process, cross, observation } => {
            (varies(process) || varies(observation) || cross.as_ref().is_some_and(varies), cross.is_some())
        }
        NoiseLaw::Factors { process, observation } => (varies(process) || varies(observation), false),
    };
    let matrix_varies =
        |term: &Option<InputTerm>| term.as_ref().and_then(|term| term.matrix.as_ref()).is_some_and(varies);
    let time_varying = varies(&case.transition)
        || varies(&case.observation)
        || noise_varies
        || matrix_varies(&case.input)
        || matrix_varies(&case.observation_input);
    let gap = |reading: &Option<Vec<Option<Entry>>>| reading.as_ref().is_none_or(|entries| entries.contains(&None));
    let evidence = [
        ("input", case.input.is_some() || case.observation_input.is_some()),
        ("missing", case.observations.iter().any(gap)),
        ("time-varying", time_varying && case.expect != Expect::Refuse),
        ("correlated", correlated),
        ("arriving", case.timing == Timing::Arriving),
        ("before-transition", case.initial.before == Before::Transition),
        ("diffuse", case.initial.diffuse.is_some()),
        ("contradiction", case.expect == Expect::Flag),
        ("binary32", case.numbers == Numbers::Binary32),
        ("bad-input", case.expect == Expect::Refuse),
    ];
    evidence.into_iter().filter(|(_, is_evident)| *is_evident).map(|(flag, _)| flag).collect()
}
