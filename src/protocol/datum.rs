//! Numbers of a document that takes JSON numbers as well as strings: both mean their text.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, MapAccess, Visitor, value::MapAccessDeserializer};

use super::{NumberError, Numbers};
use crate::scalar::Rational;

/// A number as text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Datum(String);

impl Datum {
    /// The value that the text means.
    ///
    /// # Errors
    ///
    /// As [`Numbers::read_finite`].
    pub fn value(&self, numbers: Numbers) -> Result<Rational, NumberError> {
        numbers.read_finite(&self.0)
    }
}

impl From<&str> for Datum {
    fn from(text: &str) -> Self {
        Self(text.to_owned())
    }
}

impl<'de> Deserialize<'de> for Datum {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(DatumVisitor)
    }
}

struct DatumVisitor;

impl<'de> Visitor<'de> for DatumVisitor {
    type Value = Datum;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or a number as a string")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Datum, E> {
        Ok(Datum(text.to_owned()))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Datum, E> {
        Ok(Datum(number.to_string()))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Datum, E> {
        Ok(Datum(number.to_string()))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Datum, A::Error> {
        // serde_json presents a number that is no machine integer as a map, with all its digits.
        match serde_json::Number::deserialize(MapAccessDeserializer::new(map)) {
            Ok(number) => Ok(Datum(number.as_str().to_owned())),
            Err(_) => Err(A::Error::invalid_type(serde::de::Unexpected::Map, &self)),
        }
    }
}
