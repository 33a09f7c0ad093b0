//! Number literals as they stand in a case: text, not yet given a meaning.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, MapAccess, Unexpected, Visitor, value::MapAccessDeserializer};
use serde::ser::{Serialize, Serializer};

use super::number::shortest_double;
use crate::scalar::Rational;

/// A number in a case, as text: it travels on verbatim, whether or not it is a good number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry(String);

impl Entry {
    /// The text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl From<&str> for Entry {
    fn from(text: &str) -> Self {
        Self(text.to_owned())
    }
}

impl From<String> for Entry {
    fn from(text: String) -> Self {
        Self(text)
    }
}

impl From<f64> for Entry {
    /// The shortest decimal that is read back as this double.
    fn from(value: f64) -> Self {
        Self(shortest_double(value))
    }
}

impl From<&Rational> for Entry {
    /// The fraction itself, for exact cases.
    fn from(value: &Rational) -> Self {
        Self(value.to_string())
    }
}

impl Serialize for Entry {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.0)
    }
}

impl<'de> Deserialize<'de> for Entry {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(EntryVisitor)
    }
}

struct EntryVisitor;

impl<'de> Visitor<'de> for EntryVisitor {
    type Value = Entry;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number as a string")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Entry, E> {
        Ok(text.into())
    }

    fn visit_string<E: Error>(self, text: String) -> Result<Entry, E> {
        Ok(Entry(text))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Entry, E> {
        Err(bare_number(&number.to_string()))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Entry, E> {
        Err(bare_number(&number.to_string()))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Entry, A::Error> {
        Err(number_refused(map, &self))
    }
}

/// The error for a bare number where a string must stand.
pub(super) fn bare_number<E: Error>(number: &str) -> E {
    let text: String = number.chars().take(60).collect();
    E::custom(format_args!("the JSON number {text}: numbers travel as strings, write \"{text}\""))
}

/// The same for what looks like a map: serde_json presents a number that is no machine integer as one.
pub(super) fn number_refused<'de, A: MapAccess<'de>>(map: A, expected: &dyn serde::de::Expected) -> A::Error {
    match serde_json::Number::deserialize(MapAccessDeserializer::new(map)) {
        Ok(number) => bare_number(number.as_str()),
        Err(_) => A::Error::invalid_type(Unexpected::Map, expected),
    }
}
