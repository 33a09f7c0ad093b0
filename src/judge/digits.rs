//! Correct digits: the log relative error of each quantity, in units that do not matter.

use num_bigint::BigInt;

use super::Scale;
use crate::matrix::Matrix;
use crate::scalar::{Rational, Scalar};
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

    /// −log₁₀ of the root of a squared relative error.
    fn of_square(square: &Rational) -> Self {
        if num_traits::Zero::is_zero(square) {
            return Self::EXACT;
        }
        let log2 = log2(square.numer()) - log2(square.denom());
        // Adding zero turns −0 into 0.
        Self::new(-0.5 * log2 * std::f64::consts::LOG10_2 + 0.0)
    }
}

impl std::fmt::Display for Digits {
    /// Whole digits, rounded down: «14» promises fourteen.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(&format!("{:.0}", self.0.floor() + 0.0))
    }
}

/// The binary logarithm of the magnitude of an integer, good to a double's precision on every machine.
fn log2(value: &BigInt) -> f64 {
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
            let error = theirs[(row, column)].minus(&truth[(row, column)]);
            let square = error.times(&error);
            let unit = if quantity.is_vector() {
                let x = &truth[(row, 0)];
                x.times(x).max(scale.variance(row).clone())
            } else {
                scale.variance(row).times(scale.variance(column))
            };
            let digits = match square.over(&unit) {
                Ok(ratio) => Digits::of_square(&ratio),
                // Nothing sets a scale here: the exact value is the only one with a right digit.
                Err(_) if num_traits::Zero::is_zero(&square) => Digits::EXACT,
                Err(_) => Digits::new(0.0),
            };
            if digits < worst.digits {
                worst = EntryDigits { digits, row, column };
            }
        }
    }
    worst
}
