//! What a number literal means, and the literal of a number.

use serde::{Deserialize, Serialize};

use super::literal::{self, Literal, MAXIMAL_EXACT_EXPONENT, MAXIMAL_LITERAL_CHARACTERS};
use crate::scalar::{Rational, exact_value, nearest_double, nearest_single};

/// What the number strings of a document mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Numbers {
    /// Each string means the nearest double, ties to even.
    #[default]
    Binary64,
    /// Each string means the nearest single-precision number, ties to even.
    Binary32,
    /// Each string means itself: an integer, a decimal, a fraction `1/3`, a hexadecimal float.
    Exact,
}

/// A value that an answer may hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Number {
    /// A number; a double is the dyadic rational that it is.
    Finite(Rational),
    /// An infinity, or a literal that rounds to one.
    Infinite {
        /// Whether it is −∞.
        negative: bool,
    },
    /// NaN.
    NotANumber,
}

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Finite(value) => value.fmt(f),
            Self::NotANumber => f.pad("NaN"),
            Self::Infinite { negative: false } => f.pad("Infinity"),
            Self::Infinite { negative: true } => f.pad("-Infinity"),
        }
    }
}

/// Why a literal has no value.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NumberError {
    /// The literal follows none of the grammars.
    #[error(
        "{} is not a number; write it as \"0.1\", \"1e-3\" or \"0x1.8p-3\", in exact cases also as \"1/3\"",
        quoted(literal)
    )]
    Syntax {
        /// The literal.
        literal: String,
    },
    /// The literal is longer than [`MAXIMAL_LITERAL_CHARACTERS`].
    #[error(
        "a number of {bytes} characters; at most {MAXIMAL_LITERAL_CHARACTERS} are read, and 17 significant digits \
         name every double"
    )]
    TooLong {
        /// Its length.
        bytes: usize,
    },
    /// The exponent of an exact literal is beyond [`MAXIMAL_EXACT_EXPONENT`].
    #[error(
        "the exponent of {} is beyond {MAXIMAL_EXACT_EXPONENT} in magnitude, the bound in exact cases; \
         rescale the problem",
        quoted(literal)
    )]
    Exponent {
        /// The literal.
        literal: String,
    },
    /// The literal names NaN or an infinity where a number is needed.
    #[error("{} is not a finite number; a missing reading is null", quoted(literal))]
    NotFinite {
        /// The literal.
        literal: String,
    },
    /// The literal rounds beyond the largest number of the format.
    #[error(
        "{} is not a finite number: it overflows {format}; rescale the problem or use \"numbers\": \"exact\"",
        quoted(literal)
    )]
    Overflow {
        /// The literal.
        literal: String,
        /// The name of the format.
        format: &'static str,
    },
    /// A fraction that is not for exact documents.
    #[error("{} is a fraction; fractions are read where \"numbers\" is \"exact\"", quoted(literal))]
    Fraction {
        /// The literal.
        literal: String,
    },
    /// A fraction over zero.
    #[error("{} has the denominator 0", quoted(literal))]
    ZeroDenominator {
        /// The literal.
        literal: String,
    },
}

/// The literal in quotation marks, shortened in the middle.
fn quoted(literal: &str) -> String {
    let count = literal.chars().count();
    if count <= 60 {
        return format!("{literal:?}");
    }
    let (head, tail): (String, String) =
        (literal.chars().take(30).collect(), literal.chars().skip(count - 20).collect());
    format!("{:?} ({count} characters)", format!("{head}…{tail}"))
}

impl Numbers {
    /// The name in the protocol.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Binary64 => "binary64",
            Self::Binary32 => "binary32",
            Self::Exact => "exact",
        }
    }

    /// The value of a literal, infinities and NaN included.
    ///
    /// # Errors
    ///
    /// [`NumberError`] if it is no literal, or too long, or an exact one with too large an exponent.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::protocol::{Number, Numbers};
    /// use exact_kalman::scalar::ratio;
    ///
    /// assert_eq!(Numbers::Exact.read("1/3"), Ok(Number::Finite(ratio(1, 3))));
    /// assert_eq!(Numbers::Binary64.read("0x1.8p-3"), Ok(Number::Finite(ratio(3, 16))));
    /// assert_eq!(Numbers::Binary64.read("1e999"), Ok(Number::Infinite { negative: false }));
    /// ```
    pub fn read(self, text: &str) -> Result<Number, NumberError> {
        let literal = || text.to_owned();
        let positional = match Literal::parse(text)? {
            Literal::NotANumber => return Ok(Number::NotANumber),
            Literal::Infinite { negative } => return Ok(Number::Infinite { negative }),
            Literal::Fraction { .. } if self != Self::Exact => {
                return Err(NumberError::Fraction { literal: literal() });
            }
            Literal::Fraction { negative, numerator, denominator } => {
                let value = literal::fraction(negative, numerator, denominator);
                return value.map(Number::Finite).ok_or_else(|| NumberError::ZeroDenominator { literal: literal() });
            }
            Literal::Positional(positional) => positional,
        };
        let negative = positional.negative;
        let double = match self {
            Self::Exact if positional.exponent_is_bounded() => return Ok(Number::Finite(positional.value())),
            Self::Exact => return Err(NumberError::Exponent { literal: literal() }),
            Self::Binary64 if positional.hexadecimal => nearest_double(&positional.clamped_value()),
            Self::Binary32 if positional.hexadecimal => f64::from(nearest_single(&positional.clamped_value())),
            // The grammar above is part of the standard library's, which rounds correctly.
            Self::Binary64 => text.parse::<f64>().map_err(|_| NumberError::Syntax { literal: literal() })?,
            Self::Binary32 => f64::from(text.parse::<f32>().map_err(|_| NumberError::Syntax { literal: literal() })?),
        };
        Ok(exact_value(double).map_or(Number::Infinite { negative }, Number::Finite))
    }

    /// The value of a literal that must be a number.
    ///
    /// # Errors
    ///
    /// As [`Numbers::read`], and [`NumberError::NotFinite`] or [`NumberError::Overflow`].
    pub fn read_finite(self, text: &str) -> Result<Rational, NumberError> {
        let literal = || text.to_owned();
        match self.read(text)? {
            Number::Finite(value) => Ok(value),
            Number::Infinite { .. } if text.bytes().any(|byte| byte.is_ascii_digit()) => {
                Err(NumberError::Overflow { literal: literal(), format: self.name() })
            }
            Number::NotANumber | Number::Infinite { .. } => Err(NumberError::NotFinite { literal: literal() }),
        }
    }

    /// A literal of the value: exact as a fraction or an integer, else the shortest decimal that is read back as
    /// the nearest number of the format.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{protocol::Numbers, scalar::ratio};
    ///
    /// assert_eq!(Numbers::Exact.write(&ratio(2, 6)), "1/3");
    /// assert_eq!(Numbers::Binary64.write(&ratio(1, 10)), "0.1");
    /// ```
    pub fn write(self, value: &Rational) -> String {
        match self {
            Self::Exact => value.to_string(),
            Self::Binary64 => shortest_double(nearest_double(value)),
            Self::Binary32 => shortest_single(nearest_single(value)),
        }
    }
}

/// The shortest decimal that is read back as the same double; `NaN`, `Infinity`, `-Infinity` by name.
///
/// # Examples
///
/// ```
/// use exact_kalman::protocol::shortest_double;
///
/// assert_eq!(shortest_double(0.1), "0.1");
/// assert_eq!(shortest_double(1e300), "1e300");
/// assert_eq!(shortest_double(f64::NEG_INFINITY), "-Infinity");
/// ```
pub fn shortest_double(value: f64) -> String {
    if !value.is_finite() {
        return name_of(value.is_nan(), value < 0.0).to_owned();
    }
    if is_plain(value) { format!("{value}") } else { format!("{value:e}") }
}

fn shortest_single(value: f32) -> String {
    if !value.is_finite() {
        return name_of(value.is_nan(), value < 0.0).to_owned();
    }
    if is_plain(f64::from(value)) { format!("{value}") } else { format!("{value:e}") }
}

/// Whether the value is shorter without an exponent, roughly.
fn is_plain(value: f64) -> bool {
    value == 0.0 || (1e-5..1e17).contains(&value.abs())
}

/// The name of what is not finite.
pub(super) fn name_of(nan: bool, negative: bool) -> &'static str {
    match (nan, negative) {
        (true, _) => "NaN",
        (false, true) => "-Infinity",
        (false, false) => "Infinity",
    }
}
