//! Correct digits: the log relative error of each quantity, in units that do not matter.

use num_bigint::BigInt;
use num_traits::Zero;

use super::Scale;
use crate::matrix::Matrix;
use crate::scalar::Rational;
use crate::trace::Quantity;

/// A number of correct decimal digits, capped at [`Digits::EXACT`]; negative if wrong by powers of ten.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Digits(f64);

impl Digits {
    /// The cap: more than a double can hold. It also stands for "equal".
    pub const EXACT: Self = Self(17.0);

    /// A number of digits, cut off at the cap.
    pub fn new(digits: f64) -> Self {
        Self(digits.min(Self::EXACT.0))
    }

    /// The number.
    pub fn value(self) -> f64 {
        self.0
    }

    /// The smaller of two.
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }

    /// −log₁₀ √(square / unit), both given as an integer over an integer; nothing where the unit is zero.
    ///
    /// A whole number of digits is met exactly: an error of 10⁻⁵ has five, not 4.999…, and one of 1.0001·10⁻⁵ has not.
    fn of_square(square: &Fraction, unit: &Fraction) -> Option<Self> {
        if unit.numerator.is_zero() {
            return None;
        }
        let [over, under] = [&square.numerator * &unit.denominator, &square.denominator * &unit.numerator];
        if over.is_zero() {
            return Some(Self::EXACT);
        }
        let digits = 0.5 * (log2(&under) - log2(&over)) * std::f64::consts::LOG10_2;
        let whole = digits.round();
        if (digits - whole).abs() > 1e-6 || whole.abs() > 10_000.0 {
            return Some(Self::new(digits));
        }
        #[expect(clippy::cast_possible_truncation, reason = "a whole number below ten thousand")]
        let power = BigInt::from(100_u8).pow((whole.abs() as i32).unsigned_abs());
        let (over, under) = if whole < 0.0 { (over, under * power) } else { (over * power, under) };
        // Exact values are rounded to 256 bits before they come here.
        Some(Self::new(if (&over - &under).magnitude() << 128_u8 <= *under.magnitude() {
            // Adding zero turns −0 into 0.
            whole + 0.0
        } else if over < under {
            digits.max(whole + 0.0)
        } else {
            digits.min(whole.next_down())
        }))
    }
}

/// An integer over a positive integer, not in lowest terms: a greatest common divisor would cost more than all the
/// rest of the comparison.
struct Fraction {
    numerator: BigInt,
    denominator: BigInt,
}

impl Fraction {
    fn square(value: &Rational) -> Self {
        Self { numerator: value.numer() * value.numer(), denominator: value.denom() * value.denom() }
    }

    fn square_of_difference(a: &Rational, b: &Rational) -> Self {
        let difference = a.numer() * b.denom() - b.numer() * a.denom();
        let denominator = a.denom() * b.denom();
        Self { numerator: &difference * &difference, denominator: &denominator * &denominator }
    }

    fn product(a: &Rational, b: &Rational) -> Self {
        Self { numerator: a.numer() * b.numer(), denominator: a.denom() * b.denom() }
    }

    fn max(self, value: &Rational) -> Self {
        if &self.numerator * value.denom() < value.numer() * &self.denominator {
            Self { numerator: value.numer().clone(), denominator: value.denom().clone() }
        } else {
            self
        }
    }
}

impl std::fmt::Display for Digits {
    /// Whole digits, rounded down: «14» promises fourteen.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(&format!("{:.0}", self.0.floor() + 0.0))
    }
}

/// The binary logarithm of the magnitude of an integer, good to a double's precision on every machine.
pub(super) fn log2(value: &BigInt) -> f64 {
    let bits = value.bits();
    let dropped = bits.saturating_sub(64);
    let leading = (value.magnitude() >> dropped).iter_u64_digits().next().unwrap_or(0);
    #[expect(clippy::cast_precision_loss, reason = "digits are counted, not bits")]
    let (leading, dropped) = (leading as f64, dropped as f64);
    libm::log2(leading) + dropped
}

/// The digits of one quantity at one step, with the entry that is worst.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EntryDigits {
    /// The digits of the worst entry.
    pub digits: Digits,
    /// Its row, counted from 0.
    pub row: usize,
    /// Its column, counted from 0.
    pub column: usize,
}

/// The worst entry of a quantity: errors of covariances relative to √(PᵢᵢPⱼⱼ), errors of means relative to
/// max(|xᵢ|, √Pᵢᵢ).
///
/// The shapes are equal (the caller has checked them); no entry at all counts as exact.
pub(super) fn digits(
    quantity: Quantity,
    theirs: &Matrix<Rational>,
    truth: &Matrix<Rational>,
    scale: &Scale,
) -> EntryDigits {
    let mut worst = EntryDigits { digits: Digits::EXACT, row: 0, column: 0 };
    for row in 0..truth.rows() {
        for column in 0..truth.columns() {
            let error = Fraction::square_of_difference(&theirs[(row, column)], &truth[(row, column)]);
            let unit = if quantity.is_vector() {
                Fraction::square(&truth[(row, 0)]).max(scale.variance(row))
            } else {
                Fraction::product(scale.variance(row), scale.variance(column))
            };
            // Where nothing sets a scale the exact value is the only one with a right digit.
            let none = if error.numerator.is_zero() { Digits::EXACT } else { Digits::new(0.0) };
            let digits = Digits::of_square(&error, &unit).unwrap_or(none);
            if digits < worst.digits {
                worst = EntryDigits { digits, row, column };
            }
        }
    }
    worst
}
