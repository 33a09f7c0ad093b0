//! Integers as they are written in certificates.

use num_bigint::BigInt;
use num_traits::{Num, Zero};
use serde::de::{Deserialize, Deserializer, Error};
use serde::ser::{Serialize, Serializer};

/// The most digits an integer may have.
pub const MAXIMAL_DIGITS: usize = 1 << 16;

/// An integer, written with lowercase hexadecimal digits; `-` stands before a negative one, and no zero before others.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Hexadecimal(pub BigInt);

impl Serialize for Hexadecimal {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.0.to_str_radix(16))
    }
}

impl<'de> Deserialize<'de> for Hexadecimal {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = std::borrow::Cow::<str>::deserialize(deserializer)?;
        read(&text).map(Self).ok_or_else(|| {
            D::Error::custom(format_args!(
                "an integer is expected, of at most {MAXIMAL_DIGITS} lowercase hexadecimal digits and without leading zeros"
            ))
        })
    }
}

fn read(text: &str) -> Option<BigInt> {
    let digits = text.strip_prefix('-').unwrap_or(text);
    let is_lowercase = digits.bytes().all(|digit| matches!(digit, b'0'..=b'9' | b'a'..=b'f'));
    if digits.is_empty() || digits.len() > MAXIMAL_DIGITS || !is_lowercase {
        return None;
    }
    if digits.starts_with('0') {
        return (text == "0").then(BigInt::zero);
    }
    BigInt::from_str_radix(text, 16).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_integer_is_written_in_one_way() {
        assert_eq!(read("-1f"), Some(BigInt::from(-31)));
        assert_eq!(read("0"), Some(BigInt::zero()));
        for wrong in ["", "-", "-0", "00", "01", "+1", "1F", "0x1", "1_0", " 1", "١"] {
            assert_eq!(read(wrong), None, "{wrong:?}");
        }
        assert_eq!(read(&"1".repeat(MAXIMAL_DIGITS)).map(|it| it.bits()), Some(4 * MAXIMAL_DIGITS as u64 - 3));
        assert_eq!(read(&"1".repeat(MAXIMAL_DIGITS + 1)), None);
    }
}
