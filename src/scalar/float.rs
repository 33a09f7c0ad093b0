//! Between the exact rationals and IEEE 754: a double is a dyadic rational, and is read exactly.
//!
//! No arithmetic is done in floating point here; bits are taken apart and put together.

use num_bigint::{BigInt, BigUint, Sign};
use num_traits::{ToPrimitive, Zero};

use super::quotient::{Ties, magnitude, nearest};
use super::{Quotient, Rational};

/// A binary format of IEEE 754 with gradual underflow.
struct Format {
    /// The bits of a significand, the hidden one included.
    precision: u32,
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
    Quotient::from(value).nearest_double()
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
    Quotient::from(value).nearest_single()
}

impl Quotient<'_> {
    /// The nearest double, as [`nearest_double`].
    pub fn nearest_double(self) -> f64 {
        let magnitude = f64::from_bits(self.nearest_pattern(&DOUBLE));
        if self.is_negative() { -magnitude } else { magnitude }
    }

    /// The nearest single-precision number, as [`nearest_single`].
    pub fn nearest_single(self) -> f32 {
        let pattern = self.nearest_pattern(&SINGLE);
        let magnitude = f32::from_bits(u32::try_from(pattern).unwrap_or(0x7f80_0000));
        if self.is_negative() { -magnitude } else { magnitude }
    }

    /// The bits of the nearest magnitude.
    fn nearest_pattern(self, format: &Format) -> u64 {
        if self.numerator.is_zero() {
            return 0;
        }
        self.asked(format.precision.into(), |numerator, denominator, exponent| {
            let magnitude = magnitude(numerator, denominator, exponent);
            // Beyond every format; the shifts below stay short.
            if magnitude > 1100 {
                return format.infinity;
            }
            if magnitude < -1100 {
                return 0;
            }
            let unit = (magnitude - i64::from(format.precision)).max(format.least);
            let significand = nearest((numerator, denominator, exponent), unit, Ties::Even);
            // The hidden bit adds one to the exponent field of a normal number, and a carry out of the significand
            // adds one more: both are just the addition.
            let field = u64::try_from(unit - format.least).unwrap_or(0);
            let pattern = (field << (format.precision - 1)) + significand.to_u64().unwrap_or(format.infinity);
            pattern.min(format.infinity)
        })
    }
}
