//! The natural logarithm of a positive fraction, enclosed.
//!
//! x = 2^k m with 1/2 < m < 2, and ln m = 2 artanh((m − 1)/(m + 1)) by its series in fixed point, whose ratio is below 1/9.
//! Every truncation is counted, and the enclosure is wider by the count.

use num_bigint::{BigInt, BigUint};
use num_traits::{Signed, Zero};

use super::circle::{Signs, arctangent};
use super::dyadic::Dyadic;
use super::{Interval, Rational, Undefined};

/// Bits beyond those that are asked for, against the loss by truncation.
const GUARD: u64 = 16;

/// The bits of k, and one more: lengths of numbers that fit into memory have fewer than 62.
const WHOLE: u64 = 63;

/// Logarithms to a number of bits after the binary point. What all of them need, ln 2, is computed once.
///
/// # Examples
///
/// ```
/// use exact_kalman::scalar::{Logarithms, ratio};
///
/// let logarithms = Logarithms::new(40);
/// let (six, two, three) = (logarithms.of(&ratio(6, 1))?, logarithms.of(&ratio(2, 1))?, logarithms.of(&ratio(3, 1))?);
/// let sum = two.plus(&three, 40);
/// assert!(sum.lower() <= six.upper() && six.lower() <= sum.upper());
/// # Ok::<(), exact_kalman::scalar::Undefined>(())
/// ```
#[derive(Clone, Debug)]
pub struct Logarithms {
    places: u64,
    /// A lower bound of ln 2 in units of 2^−(places + WHOLE), less than two units away from it.
    of_two: BigInt,
}

impl Logarithms {
    /// Logarithms whose enclosures are narrower than 2^−bits.
    pub fn new(bits: u64) -> Self {
        let places = bits.saturating_add(GUARD + u64::from(u64::BITS - bits.leading_zeros()));
        Self { places, of_two: logarithm_of_two(places + WHOLE) }
    }

    /// ln x
    ///
    /// # Errors
    ///
    /// [`Undefined::OutsideTheRing`] unless x is positive.
    pub fn of(&self, x: &Rational) -> Result<Interval, Undefined> {
        if !x.is_positive() {
            return Err(Undefined::OutsideTheRing);
        }
        let (over, under) = (x.numer().magnitude(), x.denom().magnitude());
        let (k, over, under) = balanced(over, under);
        // z = (over − under)/(over + under), cut off to units of 2^−places.
        let difference = BigInt::from(over.clone()) - BigInt::from(under.clone());
        let z = (difference.abs() << self.places) / BigInt::from(over + under);
        let (half, error) = artanh(&z, self.places);
        let (mut low, mut high) = (&half << 1_u8, (half + error) << 1_u8);
        if difference.is_negative() {
            (low, high) = (-high, -low);
        }
        // k ln 2 lies between k of_two and k (of_two + 2); shifted, each end is moved outward by less than a unit.
        let ends = [&self.of_two * k, (&self.of_two + 2_u8) * k].map(|end| end >> WHOLE);
        let [one, other] = &ends;
        low += one.min(other);
        high += one.max(other) + 1_u8;
        let exponent = i64::try_from(self.places).map_or(i64::MIN, |places| -places);
        Ok(Interval::between(Dyadic::new(low, exponent), Dyadic::new(high, exponent)))
    }
}

/// k and two integers of one length with `over/under = 2^k · first/second`.
fn balanced(over: &BigUint, under: &BigUint) -> (i64, BigUint, BigUint) {
    let (above, below) = (over.bits(), under.bits());
    let length = |bits: u64| i64::try_from(bits).unwrap_or(i64::MAX);
    let k = length(above) - length(below);
    if above >= below {
        (k, over.clone(), under << (above - below))
    } else {
        (k, over << (below - above), under.clone())
    }
}

/// A lower bound of artanh z for a z from `fixed` · 2^−places to less than a unit more, 0 ≤ z < 1/3, in these units; and
/// how many units it may be off.
fn artanh(fixed: &BigInt, places: u64) -> (BigInt, BigInt) {
    // z² < 1/9 is off by less than 2z + 1 units, which is less than two.
    let square = (fixed * fixed) >> places;
    let (mut term, mut sum, mut count) = (fixed.clone(), BigInt::zero(), 0_u64);
    while !term.is_zero() {
        // The error e of a power of z: e_{j+1} ≤ e_j/9 + 2/3 + 1 + a little, so all are less than two. Divided by 2j + 1 and
        // cut off it is less than three.
        sum += &term / (2 * count + 1);
        count += 1;
        term = (term * &square) >> places;
    }
    // The powers left out are less than two units, and each less than a ninth of the one before.
    (sum, BigInt::from(3 * count + 3))
}

/// A lower bound of ln 2, less than two units of 2^−places away from it; in these units.
///
/// ln 2 = 18 artanh(1/26) − 2 artanh(1/4801) + 8 artanh(1/8749)
pub(super) fn logarithm_of_two(places: u64) -> BigInt {
    let guard = u64::from(64 - places.leading_zeros()) + 11;
    let part = |q| arctangent(q, places + guard, Signs::Equal);
    let [(a, a_error), (b, b_error), (c, c_error)] = [26, 4801, 8749].map(part);
    let (sum, error) = (a * 18_u8 - b * 2_u8 + c * 8_u8, a_error * 18 + b_error * 2 + c_error * 8);
    // The errors, twice, are less than 20·(places + guard) + 1000 units of the finer place, which is less than 2^guard, and the
    // shift loses less than one unit more.
    (sum - error) >> guard
}
