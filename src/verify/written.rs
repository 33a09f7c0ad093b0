//! Bounds that are kept while a document is read.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};

use super::document::{MAXIMAL_EXPONENT, MAXIMAL_ROWS};

/// An exponent that is not too large.
pub(super) fn exponent<'de, D: Deserializer<'de>>(deserializer: D) -> Result<i64, D::Error> {
    let exponent = i64::deserialize(deserializer)?;
    if exponent.unsigned_abs() > MAXIMAL_EXPONENT.unsigned_abs() {
        return Err(D::Error::custom(format_args!("exponents lie between ±{MAXIMAL_EXPONENT}")));
    }
    Ok(exponent)
}

/// An optional field: if the key is there, so is the value.
pub(super) fn present<'de, T: Deserialize<'de>, D: Deserializer<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}

/// The rows of a matrix, of which there are not too many.
pub(super) fn bounded<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Vec<Vec<T>>, D::Error> {
    Ok(Few::<Few<T>>::deserialize(deserializer)?.0.into_iter().map(|row| row.0).collect())
}

/// A list that is not too long.
struct Few<T>(Vec<T>);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Few<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Elements<T>(PhantomData<T>);

        impl<'de, T: Deserialize<'de>> Visitor<'de> for Elements<T> {
            type Value = Few<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a list of at most {MAXIMAL_ROWS}")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<Self::Value, A::Error> {
                let mut elements = Vec::new();
                while let Some(element) = sequence.next_element()? {
                    if elements.len() == MAXIMAL_ROWS {
                        return Err(A::Error::invalid_length(MAXIMAL_ROWS + 1, &self));
                    }
                    elements.push(element);
                }
                Ok(Few(elements))
            }
        }

        deserializer.deserialize_seq(Elements(PhantomData))
    }
}
