//! A quotient of two integers, rounded without its lowest terms, mostly by its leading bits alone.

use std::cmp::Ordering;

use num_bigint::{BigInt, BigUint, Sign};
use num_integer::Integer;
use num_traits::Zero;

use super::{Dyadic, Interval, Rational};

/// More leading bits than the answer has: a random quotient leaves the answer open once in 2⁶⁴ times.
const MORE: u64 = 66;

/// `numerator / denominator`, two integers that need not be in lowest terms; the denominator is positive.
///
/// All that is rounded depends on the value only: with multiples of both integers the results are the same.
///
/// # Examples
///
/// ```
/// use exact_kalman::scalar::{Precision, Quotient, ratio};
/// use num_bigint::BigInt;
///
/// let shared = BigInt::from(7).pow(10_000);
/// let (numerator, denominator) = (&shared * -2, &shared * 3);
/// let quotient = Quotient::new(&numerator, &denominator);
/// assert_eq!(quotient.nearest_double(), -2.0 / 3.0);
/// assert_eq!(quotient.handed_out(Precision::Rounded { bits: 4 }), ratio(-11, 16));
/// assert_eq!(quotient.handed_out(Precision::Exact), ratio(-2, 3));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Quotient<'a> {
    pub(super) numerator: &'a BigInt,
    pub(super) denominator: &'a BigInt,
}

impl<'a> From<&'a Rational> for Quotient<'a> {
    fn from(value: &'a Rational) -> Self {
        Self { numerator: value.numer(), denominator: value.denom() }
    }
}

impl<'a> Quotient<'a> {
    /// The quotient of two integers.
    ///
    /// # Panics
    ///
    /// If the denominator is not positive.
    pub fn new(numerator: &'a BigInt, denominator: &'a BigInt) -> Self {
        assert_eq!(denominator.sign(), Sign::Plus, "a denominator is positive");
        Self { numerator, denominator }
    }

    /// The numerator.
    pub fn numerator(self) -> &'a BigInt {
        self.numerator
    }

    /// The denominator.
    pub fn denominator(self) -> &'a BigInt {
        self.denominator
    }

    /// Whether the value is negative.
    pub fn is_negative(self) -> bool {
        self.numerator.sign() == Sign::Minus
    }

    /// An interval around the value, of a relative width below `2^(2 − bits)`, in time proportional to `bits`
    /// (but for the multiplication of numbers of that length).
    pub fn enclosed(self, bits: u64) -> Interval {
        let enclosed = |number: &BigUint| {
            let cut = number.bits().saturating_sub(bits + 4);
            let least = BigInt::from(number >> cut);
            let most = &least + u8::from(cut > 0);
            // No memory holds 2^63 bits.
            let [least, most] = [least, most].map(|end| Dyadic::new(end, i64::try_from(cut).unwrap_or(i64::MAX)));
            Interval::between(least, most)
        };
        if self.numerator.is_zero() {
            return Interval::zero();
        }
        let denominator = enclosed(self.denominator.magnitude());
        let Ok(magnitude) = enclosed(self.numerator.magnitude()).over(&denominator, bits + 4) else {
            unreachable!("the denominator is positive, and so is its leading part")
        };
        if self.is_negative() { magnitude.negated() } else { magnitude }
    }

    /// The answer to a question about `numerator / denominator · 2^exponent`, the absolute value, which must be monotone in this
    /// value: if it is the same for both ends of an enclosure by leading bits, it is the answer.
    pub(super) fn asked<T: PartialEq>(self, bits: u64, question: impl Fn(&BigUint, &BigUint, i64) -> T) -> T {
        let (numerator, denominator) = (self.numerator.magnitude(), self.denominator.magnitude());
        let kept = bits + MORE;
        let cuts = [numerator, denominator].map(|number| number.bits().saturating_sub(kept));
        if cuts[0].max(cuts[1]) > 64 {
            let leading = [numerator >> cuts[0], denominator >> cuts[1]];
            let following = [&leading[0] + u8::from(cuts[0] > 0), &leading[1] + u8::from(cuts[1] > 0)];
            let exponent = signed(cuts[0]) - signed(cuts[1]);
            let least = question(&leading[0], &following[1], exponent);
            if least == question(&following[0], &leading[1], exponent) {
                return least;
            }
        }
        question(numerator, denominator, 0)
    }
}

/// A length in bits; no memory holds 2^62 of them.
fn signed(bits: u64) -> i64 {
    i64::try_from(bits).unwrap_or(i64::MAX / 4)
}

/// Where the middle between two multiples is rounded to.
#[derive(Clone, Copy)]
pub(super) enum Ties {
    Even,
    Up,
    Down,
}

/// The e with 2^(e−1) ≤ value < 2^e, for `value = numerator / denominator · 2^exponent`, not zero.
pub(super) fn magnitude(numerator: &BigUint, denominator: &BigUint, exponent: i64) -> i64 {
    let gap = signed(numerator.bits()) - signed(denominator.bits());
    let shift = gap.unsigned_abs();
    let below = if gap >= 0 { *numerator < denominator << shift } else { numerator << shift < *denominator };
    gap + exponent + i64::from(!below)
}

/// `value / 2^unit`, rounded to the nearest integer, for `value = numerator / denominator · 2^exponent`.
pub(super) fn nearest((numerator, denominator, exponent): (&BigUint, &BigUint, i64), unit: i64, ties: Ties) -> BigUint {
    let shift = (exponent - unit).unsigned_abs();
    let (quotient, twice_rest, divisor) = if exponent >= unit {
        let (quotient, rest) = (numerator << shift).div_rem(denominator);
        (quotient, rest << 1_u8, denominator.clone())
    } else {
        let divisor = denominator << shift;
        let (quotient, rest) = numerator.div_rem(&divisor);
        (quotient, rest << 1_u8, divisor)
    };
    let up = match (twice_rest.cmp(&divisor), ties) {
        (Ordering::Greater, _) | (Ordering::Equal, Ties::Up) => true,
        (Ordering::Less, _) | (Ordering::Equal, Ties::Down) => false,
        (Ordering::Equal, Ties::Even) => quotient.is_odd(),
    };
    quotient + u8::from(up)
}
