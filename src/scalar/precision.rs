//! From two integers to their quotient, in lowest terms or rounded.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};

use super::Rational;
use super::gcd::common_divisor;

/// How quotients of integers are handed out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// As they are, in lowest terms.
    Exact,
    /// To the nearest multiple of a power of two, with at least this many and at most two more significant
    /// bits (ties upwards); multiples of that power stay as they are.
    Rounded {
        /// The number of significant bits, at least one.
        bits: u32,
    },
}

impl Precision {
    /// A fraction, as it is or rounded.
    pub fn of(self, value: &Rational) -> Rational {
        self.quotient(value.numer(), value.denom())
    }

    /// The quotient of two integers, the divisor positive.
    pub fn quotient(self, numerator: &BigInt, denominator: &BigInt) -> Rational {
        match self {
            _ if numerator.is_zero() => Rational::zero(),
            Self::Exact => {
                let shared = common_divisor(numerator, denominator);
                Rational::new_raw(numerator / &shared, denominator / shared)
            }
            Self::Rounded { bits } => rounded(numerator, denominator, bits.max(1)),
        }
    }
}

fn rounded(numerator: &BigInt, denominator: &BigInt, bits: u32) -> Rational {
    // Sizes in bits are far below 2^62: numbers of that many bits do not exist in memory.
    let size = |n: &BigInt| i64::try_from(n.bits()).unwrap_or(i64::MAX);
    let shift = i64::from(bits) + 1 - (size(numerator) - size(denominator));
    let (scaled, divisor) = if shift >= 0 {
        (numerator << shift.unsigned_abs(), denominator.clone())
    } else {
        (numerator.clone(), denominator << shift.unsigned_abs())
    };
    let quotient = Integer::div_floor(&((scaled << 1u8) + &divisor), &(divisor << 1u8));
    let twos = quotient.trailing_zeros().unwrap_or(0);
    let odd = quotient >> twos;
    let exponent = i64::try_from(twos).unwrap_or(i64::MAX) - shift;
    if exponent >= 0 {
        Rational::from(odd << exponent.unsigned_abs())
    } else {
        Rational::new_raw(odd, BigInt::one() << exponent.unsigned_abs())
    }
}
