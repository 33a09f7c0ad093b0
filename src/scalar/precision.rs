//! From two integers to their quotient, in lowest terms or rounded.

use num_bigint::{BigInt, BigUint};
use num_traits::{One, Zero};

use super::gcd::common_divisor;
use super::quotient::{Ties, magnitude, nearest};
use super::{Quotient, Rational};

/// How quotients of integers are handed out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// As they are, in lowest terms.
    Exact,
    /// To so many significant bits: with 2^(e−1) ≤ |value| < 2^e, to the nearest multiple of 2^(e − bits), ties
    /// upwards. What has no more bits stays as it is.
    Rounded {
        /// The number of significant bits; none is read as one.
        bits: u32,
    },
}

impl Precision {
    /// A fraction, as it is or rounded.
    pub fn of(self, value: &Rational) -> Rational {
        match self {
            Self::Exact => value.clone(),
            Self::Rounded { .. } => Quotient::from(value).handed_out(self),
        }
    }
}

impl Quotient<'_> {
    /// The value in lowest terms, or rounded.
    pub fn handed_out(self, precision: Precision) -> Rational {
        match precision {
            _ if self.numerator.is_zero() => Rational::zero(),
            Precision::Exact => {
                let shared = common_divisor(self.numerator, self.denominator);
                if shared.is_one() {
                    return Rational::new_raw(self.numerator.clone(), self.denominator.clone());
                }
                Rational::new_raw(self.numerator / &shared, self.denominator / shared)
            }
            Precision::Rounded { bits } => self.rounded(bits.max(1)),
        }
    }

    fn rounded(self, bits: u32) -> Rational {
        let ties = if self.is_negative() { Ties::Down } else { Ties::Up };
        let (odd, exponent) = self.asked(bits.into(), |numerator, denominator, exponent| {
            let unit = magnitude(numerator, denominator, exponent) - i64::from(bits);
            without_twos(&nearest((numerator, denominator, exponent), unit, ties), unit)
        });
        let odd = BigInt::from_biguint(self.numerator.sign(), odd);
        if exponent >= 0 {
            Rational::from(odd << exponent.unsigned_abs())
        } else {
            Rational::new_raw(odd, BigInt::one() << exponent.unsigned_abs())
        }
    }
}

/// `significand · 2^unit` with an odd significand.
fn without_twos(significand: &BigUint, unit: i64) -> (BigUint, i64) {
    let twos = significand.trailing_zeros().unwrap_or(0);
    (significand >> twos, unit + i64::try_from(twos).unwrap_or(i64::MAX))
}
