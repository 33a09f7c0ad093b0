//! π, sines and cosines, enclosed.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, ToPrimitive, Zero};

use super::dyadic::{Dyadic, Toward};
use super::{Interval, Rational, ratio};

/// The bits of the largest argument whose sine is computed: reduced by multiples of π/2, it needs as many bits of π.
const MOST_BITS: u64 = 1 << 17;

/// The bits of an argument that is only halved.
const FEW_BITS: u64 = 4;

impl Interval {
    /// π, to about so many bits: 16 arctan(1/5) − 4 arctan(1/239), by Machin.
    pub fn pi(bits: u64) -> Self {
        let places = bits + 16;
        let part = |q| arctangent(q, places, Signs::Alternating);
        let [(fifth, fifth_error), (other, other_error)] = [5, 239].map(part);
        let (middle, error) = (fifth * 16_u8 - other * 4_u8, fifth_error * 16 + other_error * 4);
        let exponent = -i64::try_from(places).unwrap_or(i64::MAX);
        Self::between(Dyadic::new(&middle - error, exponent), Dyadic::new(middle + error, exponent))
    }

    /// cos(x) and sin(x), each in an interval of width about 2^−bits; for |x| above 2^131072 only that they lie between −1
    /// and 1.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::scalar::{Interval, ratio};
    ///
    /// let (cosine, _) = Interval::cosine_and_sine(&ratio(1, 1), 30);
    /// assert!(cosine.lower().value() > Some(ratio(54_030, 100_000)) && cosine.upper().value() < Some(ratio(54_031, 100_000)));
    /// ```
    pub fn cosine_and_sine(x: &Rational, bits: u64) -> (Self, Self) {
        // |x| < 2^(size + 1)
        let size = x.numer().bits().saturating_sub(x.denom().bits());
        let anywhere = Self::between(Dyadic::one().negated(), Dyadic::one());
        if size < FEW_BITS {
            return halved(x, bits);
        }
        if size > MOST_BITS {
            return (anywhere.clone(), anywhere);
        }
        // x = q π/2 + y with |y| < 1; π to so many bits that y is left with all that are wanted.
        let work = bits + size + 16;
        let quarter = Self::pi(work).times(&Self::of(&ratio(1, 2), work), work);
        let Some(quarter_below) = quarter.lower().value() else { return (anywhere.clone(), anywhere) };
        let turns = (x / quarter_below).round();
        let y = Self::of(x, work).minus(&quarter.times(&Self::of(&turns, work), work), work);
        let Some(at) = y.lower().value() else { return (anywhere.clone(), anywhere) };
        let (cosine, sine) = halved(&at, bits);
        // Neither has a slope above 1.
        let width = y.upper().plus(&y.lower().negated(), bits, Toward::Above);
        let slack = Self::between(width.negated(), width);
        let (cosine, sine) = (cosine.plus(&slack, work), sine.plus(&slack, work));
        match turns.to_integer().mod_floor(&4.into()).to_u8() {
            Some(0) => (cosine, sine),
            Some(1) => (sine.negated(), cosine),
            Some(2) => (cosine.negated(), sine.negated()),
            _ => (sine, cosine.negated()),
        }
    }
}

/// cos(x) and sin(x) by halves of x.
fn halved(x: &Rational, bits: u64) -> (Interval, Interval) {
    // |x| < 2^(size + 1); halved so often that |y| ≤ 1/4.
    let halvings = x.numer().bits().saturating_sub(x.denom().bits()) + 3;
    let work = bits + 3 * halvings + 16;
    let y = x / Rational::from(BigInt::one() << halvings);
    let (mut cosine, mut sine) = small(&y, work);
    let one = Interval::of(&Rational::one(), work);
    for _ in 0..halvings {
        // cos 2y = 1 − 2 sin² y, sin 2y = 2 sin y cos y
        let double = sine.plus(&sine, work);
        (cosine, sine) = (one.minus(&double.times(&sine, work), work), double.times(&cosine, work));
    }
    (cosine, sine)
}

/// cos(y) and sin(y) for |y| ≤ 1/4, by their series; what is left out of each is no more than the first term left out.
fn small(y: &Rational, work: u64) -> (Interval, Interval) {
    let y = Interval::of(y, work);
    let one = Interval::of(&Rational::one(), work);
    let (mut sums, mut term) = ([Interval::zero(), Interval::zero()], one);
    let least = -i64::try_from(work).unwrap_or(i64::MAX);
    let is_small = |term: &Interval| {
        [term.lower(), term.upper()].iter().all(|end| end.magnitude().is_none_or(|size| size < least))
    };
    let mut j = 0_u32;
    // Two terms, one for each sum, that are small: the next of both are smaller still.
    while !is_small(&term) || j < 2 {
        let signed = if j % 4 < 2 { term.clone() } else { term.negated() };
        let place = usize::from(j % 2 == 1);
        sums[place] = sums[place].plus(&signed, work);
        j += 1;
        let divisor = Interval::of(&Rational::from(BigInt::from(j)), work);
        term = term.times(&y, work).over(&divisor, work).unwrap_or_else(|_| unreachable!("{j} is not zero"));
    }
    // |term| is a bound for the sum of either parity: the terms alternate and decrease.
    let both = term.joined(&term.negated());
    let [cosine, sine] = sums.map(|sum| sum.plus(&both, work));
    (cosine, sine)
}

/// Whether the terms of a series have one sign, or change it each time.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Signs {
    Alternating,
    Equal,
}

/// arctan(1/q), or artanh(1/q) where all signs are equal, in units of 2^−places, and how many units it may be off; q ≥ 5.
pub(super) fn arctangent(q: u32, places: u64, signs: Signs) -> (BigInt, u64) {
    let mut power = (BigInt::one() << places) / q;
    let (mut sum, mut count) = (BigInt::zero(), 0_u64);
    while !power.is_zero() {
        let term = &power / (2 * count + 1);
        sum = if signs == Signs::Equal || count.is_multiple_of(2) { sum + term } else { sum - term };
        power = power / q / q;
        count += 1;
    }
    // Each power is less than two units too small, each term less than three; the rest, with terms that fall by a factor of 25
    // at least, begins below three and adds up to less than four.
    (sum, 3 * count + 4)
}
