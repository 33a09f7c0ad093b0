//! A rational rounded to a few significant decimal digits.

use std::fmt;

use num_bigint::{BigInt, BigUint, Sign};
use num_integer::Integer;
use num_traits::{ToPrimitive, Zero};

use super::decimal_of_interval::scientific;
use crate::scalar::{Quotient, Rational};

/// Integers of up to this length are used as they are.
const SHORT: u64 = 1024;

/// `±significand · 10^exponent`, a decimal with few digits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decimal {
    pub(super) negative: bool,
    pub(super) significand: BigUint,
    pub(super) exponent: i64,
}

impl Decimal {
    /// The value rounded to `digits` significant digits (at least one), halves away from zero.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{protocol::Decimal, scalar::ratio};
    ///
    /// assert_eq!(Decimal::rounded(&ratio(-2, 3), 3).to_string(), "-0.667");
    /// assert_eq!(Decimal::rounded(&ratio(123_456_789, 1), 2).to_string(), "1.2e8");
    /// ```
    pub fn rounded(value: &Rational, digits: u32) -> Self {
        Self::of_quotient(value.into(), digits)
    }

    /// The same of a quotient of integers, without its lowest terms.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{protocol::Decimal, scalar::Quotient};
    /// use num_bigint::BigInt;
    ///
    /// let shared = BigInt::from(7).pow(10_000);
    /// let (numerator, denominator) = (&shared * 2, &shared * 3);
    /// let decimal = Decimal::of_quotient(Quotient::new(&numerator, &denominator), 5);
    /// assert_eq!(decimal.to_string(), "0.66667");
    /// ```
    pub fn of_quotient(value: Quotient, digits: u32) -> Self {
        let digits = digits.max(1);
        let length = value.numerator().bits().max(value.denominator().bits());
        if length > SHORT + 4 * u64::from(digits) {
            // Leading bits decide, unless the value is next to the middle of two decimals.
            let enclosed = value.enclosed(4 * u64::from(digits) + 128);
            if let Some([lower, upper]) = scientific(&enclosed, digits)
                && lower == upper
            {
                return lower;
            }
        }
        Self::of_all_bits(value, digits)
    }

    fn of_all_bits(value: Quotient, digits: u32) -> Self {
        let (numerator, denominator) = (value.numerator().magnitude(), value.denominator().magnitude());
        if numerator.is_zero() {
            return Self { negative: false, significand: BigUint::zero(), exponent: 0 };
        }
        let mut exponent = decade(numerator, denominator) - i64::from(digits - 1);
        let limit = BigUint::from(10_u8).pow(digits);
        let mut significand = scaled_and_rounded(numerator, denominator, exponent);
        // The estimate of the decade may be one off, and rounding may carry: 9.96 has the digits 10.0.
        while significand >= limit {
            exponent += 1;
            significand = scaled_and_rounded(numerator, denominator, exponent);
        }
        Self { negative: value.is_negative(), significand, exponent }.without_zeros()
    }

    /// The same, with a significand that does not end in 0.
    pub(super) fn without_zeros(mut self) -> Self {
        while !self.significand.is_zero() && (&self.significand % 10_u8).is_zero() {
            self.significand /= 10_u8;
            self.exponent += 1;
        }
        self
    }

    /// The value, exactly; it takes memory in proportion to the exponent.
    pub fn value(&self) -> Rational {
        let sign = if self.negative { Sign::Minus } else { Sign::Plus };
        let significand = BigInt::from_biguint(sign, self.significand.clone());
        let power = BigInt::from(power_of_ten(self.exponent));
        if self.exponent < 0 { Rational::new(significand, power) } else { Rational::from(significand * power) }
    }
}

/// An integer d with 10^d ≤ numerator/denominator, and 10^(d+2) above it.
fn decade(numerator: &BigUint, denominator: &BigUint) -> i64 {
    let bits = |n: &BigUint| n.bits().to_i64().unwrap_or(i64::MAX / 2);
    // log10(2) = 0.30102999566…, rounded down; 2^(gap−1) is a lower bound of the value.
    let gap = bits(numerator) - bits(denominator) - 1;
    let estimate = i64::try_from(i128::from(gap) * 30_103 / 100_000).unwrap_or(0) - 1;
    let reached = |decade: i64| {
        let power = power_of_ten(decade);
        if decade < 0 { numerator * power >= *denominator } else { *numerator >= denominator * power }
    };
    let mut decade = estimate;
    while reached(decade + 1) {
        decade += 1;
    }
    while !reached(decade) {
        decade -= 1;
    }
    decade
}

/// `value / 10^exponent`, rounded to the nearest integer.
fn scaled_and_rounded(numerator: &BigUint, denominator: &BigUint, exponent: i64) -> BigUint {
    let power = power_of_ten(exponent);
    let (dividend, divisor) =
        if exponent < 0 { (numerator * power, denominator.clone()) } else { (numerator.clone(), denominator * power) };
    (dividend * 2_u8 + &divisor).div_floor(&(divisor * 2_u8))
}

fn power_of_ten(exponent: i64) -> BigUint {
    BigUint::from(10_u8).pow(u32::try_from(exponent.unsigned_abs()).unwrap_or(u32::MAX))
}

impl fmt::Display for Decimal {
    /// Without an exponent where that is short, else as `1.2e8`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = self.significand.to_string();
        let sign = if self.negative { "-" } else { "" };
        let point = i64::try_from(digits.len()).unwrap_or(0) + self.exponent;
        if self.exponent >= 0 && point <= 6 {
            let zeros = usize::try_from(self.exponent).unwrap_or(0);
            return write!(f, "{sign}{digits}{}", "0".repeat(zeros));
        }
        if self.exponent < 0 && (-4..=6).contains(&point) {
            return match usize::try_from(point) {
                Ok(before @ 1..) => write!(f, "{sign}{}.{}", &digits[..before], &digits[before..]),
                _ => write!(f, "{sign}0.{}{digits}", "0".repeat(usize::try_from(-point).unwrap_or(0))),
            };
        }
        let (first, rest) = digits.split_at(1);
        let dot = if rest.is_empty() { "" } else { "." };
        write!(f, "{sign}{first}{dot}{rest}e{}", point - 1)
    }
}
