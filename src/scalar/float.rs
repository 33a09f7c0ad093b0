//! Between the exact rationals and IEEE 754: a double is a dyadic rational, and is read exactly.
//!
//! No arithmetic is done in floating point here; bits are taken apart and put together.

use std::cmp::Ordering;

use num_bigint::{BigInt, BigUint, Sign};
use num_integer::Integer;
use num_traits::{ToPrimitive, Zero};

use super::Rational;

/// A binary format of IEEE 754 with gradual underflow.
struct Format {
    /// The bits of a significand, the hidden one included.
    precision: u64,
    /// The exponent e of the least positive value 2ᵉ.
    least: i64,
    /// The pattern of infinity.
    infinity: u64,
}

const DOUBLE: Format = Format { precision: 53, least: -1074, infinity: 0x7ff0_0000_0000_0000 };
const SINGLE: Format = Format { precision: 24, least: -149, infinity: 0x7f80_0000 };

/// The rational number that a double is; nothing for infinities and NaN. Both zeros are 0.
///
/// # Examples
///
/// ```
/// use exact_kalman::scalar::{exact_value, ratio};
///
/// assert_eq!(exact_value(0.375), Some(ratio(3, 8)));
/// assert_ne!(exact_value(0.1), Some(ratio(1, 10)));
/// assert_eq!(exact_value(f64::NAN), None);
/// ```
pub fn exact_value(value: f64) -> Option<Rational> {
    if !value.is_finite() {
        return None;
    }
    let magnitude = value.to_bits() & !(1 << 63);
    let biased = i64::try_from(magnitude >> 52).ok()?;
    let fraction = magnitude & ((1 << 52) - 1);
    let (significand, exponent) =
        if biased == 0 { (fraction, DOUBLE.least) } else { (fraction | 1 << 52, biased - 1 + DOUBLE.least) };
    if significand == 0 {
        return Some(Rational::zero());
    }
    let even = significand.trailing_zeros();
    let sign = if value.is_sign_negative() { Sign::Minus } else { Sign::Plus };
    let odd = BigInt::from_biguint(sign, BigUint::from(significand >> even));
    Some(scaled(odd, exponent + i64::from(even)))
}

/// `odd · 2^exponent`, in lowest terms because `odd` is odd.
fn scaled(odd: BigInt, exponent: i64) -> Rational {
    let power = BigInt::from(1) << exponent.unsigned_abs();
    if exponent < 0 { Rational::new_raw(odd, power) } else { Rational::from(odd * power) }
}

/// The nearest double, ties to even; infinite where the value rounds beyond the largest double.
///
/// A negative value that rounds to zero gives −0, as IEEE 754 has it.
///
/// # Examples
///
/// ```
/// use exact_kalman::scalar::{nearest_double, ratio};
///
/// assert_eq!(nearest_double(&ratio(1, 10)), 0.1);
/// assert_eq!(nearest_double(&ratio(-2, 3)), -2.0 / 3.0);
/// ```
pub fn nearest_double(value: &Rational) -> f64 {
    let magnitude = f64::from_bits(nearest_pattern(value, &DOUBLE));
    if value.numer().sign() == Sign::Minus { -magnitude } else { magnitude }
}

/// The nearest single-precision number, rounded once, ties to even.
///
/// # Examples
///
/// ```
/// use exact_kalman::scalar::{nearest_single, ratio};
///
/// assert_eq!(nearest_single(&ratio(1, 10)), 0.1_f32);
/// ```
pub fn nearest_single(value: &Rational) -> f32 {
    let pattern = nearest_pattern(value, &SINGLE);
    let magnitude = f32::from_bits(u32::try_from(pattern).unwrap_or(0x7f80_0000));
    if value.numer().sign() == Sign::Minus { -magnitude } else { magnitude }
}

/// The bits of the nearest magnitude.
fn nearest_pattern(value: &Rational, format: &Format) -> u64 {
    let (numerator, denominator) = (value.numer().magnitude(), value.denom().magnitude());
    if numerator.is_zero() {
        return 0;
    }
    // 2^(gap−1) < value < 2^(gap+1)
    let (Ok(above), Ok(below)) = (i64::try_from(numerator.bits()), i64::try_from(denominator.bits())) else {
        unreachable!("no memory holds 2^63 bits")
    };
    let gap = above - below;
    if gap > 1100 {
        return format.infinity;
    }
    if gap < -1100 {
        return 0;
    }
    let digits = i64::try_from(format.precision).unwrap_or(i64::MAX);
    let guess = (gap - digits).max(format.least);
    let (exponent, significand) = match rounded_quotient(numerator, denominator, guess) {
        // The guess is the exponent if value < 2^gap; else one bit too many was kept.
        (quotient, _) if quotient.bits() > format.precision => {
            (guess + 1, rounded_quotient(numerator, denominator, guess + 1).1)
        }
        (_, rounded) => (guess, rounded),
    };
    // The hidden bit adds one to the exponent field of a normal number, and a carry out of the significand
    // adds one more: both are just the addition.
    let field = u64::try_from(exponent - format.least).unwrap_or(0);
    let pattern = (field << (format.precision - 1)) + significand.to_u64().unwrap_or(format.infinity);
    pattern.min(format.infinity)
}

/// `value / 2^exponent`, rounded down and to the nearest integer, ties to even.
fn rounded_quotient(numerator: &BigUint, denominator: &BigUint, exponent: i64) -> (BigUint, BigUint) {
    let shift = exponent.unsigned_abs();
    let (dividend, divisor) = if exponent < 0 {
        (numerator << shift, denominator.clone())
    } else {
        (numerator.clone(), denominator << shift)
    };
    let (quotient, rest) = dividend.div_rem(&divisor);
    let up = match (rest << 1_u8).cmp(&divisor) {
        Ordering::Greater => true,
        Ordering::Equal => quotient.is_odd(),
        Ordering::Less => false,
    };
    let rounded = &quotient + u8::from(up);
    (quotient, rounded)
}
