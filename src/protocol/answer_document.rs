//! An answer as it stands on the line, before its literals have values.

use std::collections::BTreeMap;
use std::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Unexpected, Visitor};
use serde::ser::{SerializeMap, Serializer};
use serde::{Deserialize, Serialize};

use super::ahead_document::{self, LawDocument};
use super::answer_number::AnswerNumber;
use super::fault::{Fault, FaultKind, indexed};
use super::{Answer, AnswerError, Number, Numbers, Outcome};
use crate::matrix::Matrix;
use crate::trace::{Quantity, Values};

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AnswerDocument {
    pub(super) id: String,
    pub(super) outcome: Outcome,
    #[serde(default, skip_serializing_if = "is_default")]
    pub(super) numbers: Numbers,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) step: Option<usize>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) message: Option<String>,
    #[serde(default)]
    pub(super) steps: Vec<StepDocument>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_default(numbers: &Numbers) -> bool {
    *numbers == Numbers::default()
}

impl AnswerDocument {
    /// The answer with values.
    pub(super) fn values(self) -> Result<Answer<Number>, AnswerError> {
        let numbers = self.numbers;
        let (mut steps, mut ahead) = (Vec::new(), Vec::new());
        for (k, step) in self.steps.into_iter().enumerate() {
            let wrong = |name: &str| {
                let path = format!("steps[{k}].{name}");
                move |fault: Fault| match fault.located(&path) {
                    (path, FaultKind::Number(source)) => AnswerError::Number { path, source },
                    (path, FaultKind::Ragged(source)) => AnswerError::Ragged { path, source },
                }
            };
            let value =
                |(name, nested): (Quantity, Nested)| Ok((name, nested.value(numbers).map_err(wrong(name.name()))?));
            steps.push(step.quantities.into_iter().map(value).collect::<Result<Values<Number>, AnswerError>>()?);
            let laws = indexed(&step.ahead, |law| law.as_ref().map(|law| law.value(numbers)).transpose());
            ahead.push(laws.map_err(wrong(ahead_document::KEY))?);
        }
        if ahead.iter().all(Vec::is_empty) {
            ahead.clear();
        }
        Ok(Answer { id: self.id, outcome: self.outcome, step: self.step, message: self.message, steps, ahead })
    }
}

/// What follows the steps of an answer that is written while it is found.
#[derive(Serialize)]
pub(super) struct Ending {
    pub(super) outcome: Outcome,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) step: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) message: Option<String>,
}

/// The quantities of one step, by name, and the laws ahead of it.
pub(super) struct StepDocument {
    pub(super) quantities: BTreeMap<Quantity, Nested>,
    pub(super) ahead: Vec<Option<LawDocument>>,
}

impl Serialize for StepDocument {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for (name, value) in &self.quantities {
            map.serialize_entry(name.name(), value)?;
        }
        if !self.ahead.is_empty() {
            map.serialize_entry(ahead_document::KEY, &self.ahead)?;
        }
        map.end()
    }
}

impl<'de> Deserialize<'de> for StepDocument {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(StepVisitor)
    }
}

struct StepVisitor;

impl<'de> Visitor<'de> for StepVisitor {
    type Value = StepDocument;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object of quantities")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<StepDocument, A::Error> {
        let (mut quantities, mut ahead, mut keys) = (BTreeMap::new(), Vec::new(), Vec::new());
        while let Some(key) = map.next_key::<String>()? {
            if keys.contains(&key) {
                return Err(A::Error::custom(format_args!("duplicate key `{key}`")));
            }
            let quantity = Quantity::ALL.into_iter().find(|quantity| quantity.name() == key);
            match quantity {
                Some(name) if name.is_number() => {
                    quantities.extend(map.next_value::<Option<_>>()?.map(|number| (name, Nested::Number(number))));
                }
                Some(name) if name.is_vector() => {
                    quantities.extend(map.next_value::<Option<_>>()?.map(|vector| (name, Nested::Vector(vector))));
                }
                Some(name) => {
                    quantities.extend(map.next_value::<Option<_>>()?.map(|matrix| (name, Nested::Matrix(matrix))));
                }
                None if key == ahead_document::KEY => ahead = map.next_value::<Option<_>>()?.unwrap_or_default(),
                None => {
                    let names = Quantity::ALL.map(Quantity::name).join("`, `");
                    return Err(A::Error::custom(format_args!(
                        "unknown key `{key}`, expected `{names}` or `{}`",
                        ahead_document::KEY
                    )));
                }
            }
            keys.push(key);
        }
        Ok(StepDocument { quantities, ahead })
    }
}

/// A literal, or a vector or matrix of them.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum Nested {
    Number(Leaf),
    Vector(Vec<Leaf>),
    Matrix(Vec<Vec<Leaf>>),
}

impl Nested {
    /// The literals of a matrix.
    pub(super) fn of<T: AnswerNumber>(name: Quantity, matrix: &Matrix<T>) -> Self {
        let leaf = |entry: &T| Leaf::Text(entry.literal());
        if let (true, [number]) = (name.is_number(), matrix.entries()) {
            return Self::Number(leaf(number));
        }
        if name.is_vector() {
            return Self::Vector(matrix.entries().iter().map(leaf).collect());
        }
        Self::Matrix((0..matrix.rows()).map(|i| matrix.row(i).iter().map(leaf).collect()).collect())
    }

    fn value(&self, numbers: Numbers) -> Result<Matrix<Number>, Fault> {
        let entries = |row: &[Leaf]| indexed(row, |leaf| leaf.value(numbers));
        match self {
            Self::Number(leaf) => Ok(Matrix::column(vec![leaf.value(numbers)?])),
            Self::Vector(vector) => entries(vector).map(Matrix::column),
            Self::Matrix(rows) => Matrix::from_rows(indexed(rows, |row| entries(row))?).map_err(Fault::ragged),
        }
    }
}

/// One number: a string, or a JSON number by its literal text.
pub(super) enum Leaf {
    Text(String),
    Json(String),
}

impl Leaf {
    pub(super) fn value(&self, numbers: Numbers) -> Result<Number, Fault> {
        match self {
            // In an exact answer, strings mean themselves; a JSON number is a double everywhere.
            Self::Json(text) if numbers == Numbers::Exact => Numbers::Binary64.read(text),
            Self::Text(text) | Self::Json(text) => numbers.read(text),
        }
        .map_err(Fault::number)
    }
}

impl Serialize for Leaf {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (Self::Text(text) | Self::Json(text)) = self;
        serializer.serialize_str(text)
    }
}

impl<'de> Deserialize<'de> for Leaf {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(LeafVisitor)
    }
}

struct LeafVisitor;

impl<'de> Visitor<'de> for LeafVisitor {
    type Value = Leaf;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, as a string or in JSON")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Leaf, E> {
        Ok(Leaf::Text(text.to_owned()))
    }

    fn visit_string<E: Error>(self, text: String) -> Result<Leaf, E> {
        Ok(Leaf::Text(text))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Leaf, E> {
        Ok(Leaf::Json(number.to_string()))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Leaf, E> {
        Ok(Leaf::Json(number.to_string()))
    }

    /// serde_json presents a number that is no machine integer as a map.
    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Leaf, A::Error> {
        match serde_json::Number::deserialize(MapAccessDeserializer::new(map)) {
            Ok(number) => Ok(Leaf::Json(number.as_str().to_owned())),
            Err(_) => Err(A::Error::invalid_type(Unexpected::Map, &self)),
        }
    }
}

/// The id alone, of a document that may be wrong elsewhere.
#[derive(Deserialize)]
pub(super) struct OnlyId {
    pub(super) id: String,
}
