//! The grammar of number literals, bounded before anything is computed.
//!
//! ```text
//! decimal      [+-] (digits [. digits?] | . digits) [e [+-] digits]
//! hexadecimal  [+-] 0x (hex [. hex?] | . hex) [p [+-] digits]
//! fraction     [+-] digits / digits
//! name         [+-] (nan | inf | infinity), in any case of letters
//! ```

use num_bigint::{BigInt, Sign};
use num_traits::Zero;

use super::NumberError;
use crate::scalar::{Rational, Scalar};

/// The most characters a number literal may have.
pub const MAXIMAL_LITERAL_CHARACTERS: usize = 4096;

/// The greatest magnitude of a decimal or binary exponent in an exact literal.
pub const MAXIMAL_EXACT_EXPONENT: u32 = 4096;

/// Exponents are read up to this magnitude; beyond it they say the same about a double.
const SATURATED: i64 = 1_000_000_000;

/// A literal, taken apart.
pub(super) enum Literal<'a> {
    NotANumber,
    Infinite { negative: bool },
    Fraction { negative: bool, numerator: &'a str, denominator: &'a str },
    Positional(Positional<'a>),
}

/// Digits with a point and an exponent.
pub(super) struct Positional<'a> {
    pub(super) negative: bool,
    pub(super) hexadecimal: bool,
    whole: &'a str,
    fraction: &'a str,
    exponent: i64,
}

impl<'a> Literal<'a> {
    /// Takes a literal apart.
    pub(super) fn parse(text: &'a str) -> Result<Self, NumberError> {
        if text.len() > MAXIMAL_LITERAL_CHARACTERS {
            return Err(NumberError::TooLong { bytes: text.len() });
        }
        let syntax = || NumberError::Syntax { literal: text.to_owned() };
        let (negative, magnitude) = match text.as_bytes().first() {
            Some(b'-') => (true, &text[1..]),
            Some(b'+') => (false, &text[1..]),
            _ => (false, text),
        };
        if magnitude.eq_ignore_ascii_case("nan") {
            return Ok(Self::NotANumber);
        }
        if magnitude.eq_ignore_ascii_case("inf") || magnitude.eq_ignore_ascii_case("infinity") {
            return Ok(Self::Infinite { negative });
        }
        if let Some((numerator, denominator)) = magnitude.split_once('/') {
            let plain = is_digits(numerator, false) && is_digits(denominator, false);
            return if plain { Ok(Self::Fraction { negative, numerator, denominator }) } else { Err(syntax()) };
        }
        Positional::parse(negative, magnitude).map(Self::Positional).ok_or_else(syntax)
    }
}

impl<'a> Positional<'a> {
    fn parse(negative: bool, magnitude: &'a str) -> Option<Self> {
        let prefixed = magnitude.strip_prefix("0x").or_else(|| magnitude.strip_prefix("0X"));
        let (hexadecimal, body) = prefixed.map_or((false, magnitude), |body| (true, body));
        let marks: &[char] = if hexadecimal { &['p', 'P'] } else { &['e', 'E'] };
        let (digits, exponent) = match body.split_once(marks) {
            Some((digits, exponent)) => (digits, saturated_exponent(exponent)?),
            None => (body, 0),
        };
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        let well_formed = |part: &str| part.is_empty() || is_digits(part, hexadecimal);
        let some = !(whole.is_empty() && fraction.is_empty());
        (some && well_formed(whole) && well_formed(fraction)).then_some(Self {
            negative,
            hexadecimal,
            whole,
            fraction,
            exponent,
        })
    }

    /// Whether the exponent as written is within the bound of exact literals.
    pub(super) fn exponent_is_bounded(&self) -> bool {
        self.exponent.unsigned_abs() <= u64::from(MAXIMAL_EXACT_EXPONENT)
    }

    /// The value `digits · base^exponent`, for exponents within the bound of exact literals.
    pub(super) fn value(&self) -> Rational {
        let digits = self.digits();
        let shift = self.shift();
        let base = BigInt::from(if self.hexadecimal { 2_u8 } else { 10 });
        let power = u32::try_from(shift.unsigned_abs()).map_or_else(|_| BigInt::from(1), |power| base.pow(power));
        if shift < 0 { Rational::new(digits, power) } else { Rational::from(digits * power) }
    }

    /// The value of a hexadecimal literal clamped to where a double no longer sees a difference: what is too
    /// large becomes a power of two beyond every double, what is too small becomes zero.
    pub(super) fn clamped_value(&self) -> Rational {
        let digits = self.digits();
        let shift = self.shift();
        let bits = i64::try_from(digits.bits()).unwrap_or(SATURATED);
        if digits.is_zero() || bits + shift < -1200 {
            return Scalar::zero();
        }
        if shift > 1200 {
            return Rational::from(BigInt::from_biguint(digits.sign(), num_bigint::BigUint::from(1_u8) << 1200_u32));
        }
        self.value()
    }

    fn digits(&self) -> BigInt {
        let text = [self.whole, self.fraction].concat();
        let radix = if self.hexadecimal { 16 } else { 10 };
        let magnitude = num_bigint::BigUint::parse_bytes(text.as_bytes(), radix).unwrap_or_default();
        BigInt::from_biguint(if self.negative { Sign::Minus } else { Sign::Plus }, magnitude)
    }

    /// The exponent of the last digit, in powers of ten or two.
    fn shift(&self) -> i64 {
        let places = i64::try_from(self.fraction.len()).unwrap_or(SATURATED);
        self.exponent - if self.hexadecimal { 4 * places } else { places }
    }
}

/// The value of `numerator / denominator`; nothing if the denominator is zero.
pub(super) fn fraction(negative: bool, numerator: &str, denominator: &str) -> Option<Rational> {
    let integer = |digits: &str| num_bigint::BigUint::parse_bytes(digits.as_bytes(), 10);
    let denominator = BigInt::from(integer(denominator)?);
    let sign = if negative { Sign::Minus } else { Sign::Plus };
    let numerator = BigInt::from_biguint(sign, integer(numerator)?);
    (!denominator.is_zero()).then(|| Rational::new(numerator, denominator))
}

fn is_digits(text: &str, hexadecimal: bool) -> bool {
    let digit = |byte: u8| if hexadecimal { byte.is_ascii_hexdigit() } else { byte.is_ascii_digit() };
    !text.is_empty() && text.bytes().all(digit)
}

fn saturated_exponent(text: &str) -> Option<i64> {
    let (negative, digits) = match text.as_bytes().first()? {
        b'-' => (true, &text[1..]),
        b'+' => (false, &text[1..]),
        _ => (false, text),
    };
    if !is_digits(digits, false) {
        return None;
    }
    let magnitude = digits.bytes().fold(0, |sum, digit| (10 * sum + i64::from(digit - b'0')).min(SATURATED));
    Some(if negative { -magnitude } else { magnitude })
}
