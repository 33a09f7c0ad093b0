//! The decimal to which all numbers of an interval round, of any size.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, ToPrimitive};

use super::Decimal;
use crate::scalar::{Dyadic, Interval, Rational, ratio};

/// Up to this magnitude a number is written out as a fraction.
const WRITTEN: u64 = 1 << 16;

/// Beyond this magnitude the power of ten might leave the numbers that are kept.
const FARTHEST: u64 = (1 << 63) - (1 << 41);

impl Decimal {
    /// The decimal of `digits` significant digits (at least one) to which all numbers of the interval round; nothing where they
    /// do not round alike, or lie beyond 2^±9·10¹⁸ about.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::protocol::Decimal;
    /// use exact_kalman::scalar::{Interval, ratio};
    ///
    /// let tiny = Interval::exponential(&ratio(-1_000_000_000, 1), 100)?;
    /// let decimal = Decimal::of_interval(&tiny, 5).ok_or("wide")?;
    /// assert_eq!(decimal.to_string(), "1.2495e-434294482");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of_interval(interval: &Interval, digits: u32) -> Option<Self> {
        let ends = [interval.lower(), interval.upper()];
        if ends[0].is_negative() != ends[1].is_negative() || ends.iter().any(|end| end.is_zero()) {
            return None;
        }
        let [lower, upper] = if let [Some(lower), Some(upper)] = ends.map(written) {
            [lower, upper].map(|end| Self::rounded(&end, digits))
        } else {
            scientific(interval, digits.max(1))?
        };
        (lower == upper).then_some(lower)
    }
}

/// A number that is not too small or too large to be written out.
fn written(end: &Dyadic) -> Option<Rational> {
    end.magnitude().filter(|size| size.unsigned_abs() <= WRITTEN).and(end.value())
}

/// Decimals of both ends, or of more, by a multiplication with an enclosed power of ten.
pub(super) fn scientific(interval: &Interval, digits: u32) -> Option<[Decimal; 2]> {
    let sizes = [interval.lower().magnitude()?, interval.upper().magnitude()?];
    if sizes.iter().any(|size| size.unsigned_abs() > FARTHEST) {
        return None;
    }
    let negative = interval.lower().is_negative();
    let absolute = if negative { interval.negated() } else { interval.clone() };
    let work = u64::from(digits) * 4 + 128;
    let limit = BigInt::from(10).pow(digits);
    let mut exponent = decade(absolute.lower().magnitude()?) - i64::from(digits) + 1;
    loop {
        let scaled = absolute.times(&power_of_ten(exponent.checked_neg()?, work)?, work);
        let [lower, upper] = [scaled.lower().value()?, scaled.upper().value()?].map(|end| rounded(&end));
        // The decade may have been a little too small.
        if lower >= limit {
            exponent += 1;
            continue;
        }
        return Some([lower, upper].map(|significand| {
            Decimal { negative, significand: significand.magnitude().clone(), exponent }.without_zeros()
        }));
    }
}

/// To the nearest integer, halves up.
fn rounded(value: &Rational) -> BigInt {
    (value + ratio(1, 2)).floor().to_integer()
}

/// ⌊(magnitude − 1) log₁₀ 2⌋, or a little less: a decade that a number of this magnitude reaches.
fn decade(magnitude: i64) -> i64 {
    // ⌊2⁶² log₁₀ 2⌋
    const LOGARITHM: i64 = 1_388_255_822_130_839_283;
    let product = i128::from(magnitude - 1) * i128::from(LOGARITHM);
    // A lower bound of the true product is wanted also where it is negative.
    let product = if product.is_negative() { product + i128::from(magnitude - 1) } else { product };
    (product >> 62).to_i64().unwrap_or(i64::MIN)
}

/// 10^exponent by squaring; each squaring doubles the relative width, so that 64 bits are lost at most.
fn power_of_ten(exponent: i64, bits: u64) -> Option<Interval> {
    let work = bits + 72;
    let one = Interval::of(&Rational::one(), work);
    let ten = Interval::of(&ratio(10, 1), work);
    let places = (0..64 - exponent.unsigned_abs().leading_zeros()).rev();
    let power = places.fold(one.clone(), |power, place| {
        let square = power.times(&power, work);
        if (exponent.unsigned_abs() >> place).is_odd() { square.times(&ten, work) } else { square }
    });
    if exponent < 0 { one.over(&power, work).ok() } else { Some(power) }
}
