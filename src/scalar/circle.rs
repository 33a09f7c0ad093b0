//! π, sines and cosines, enclosed.

use num_bigint::BigInt;
use num_traits::{One, Zero};

use super::dyadic::Dyadic;
use super::{Interval, Rational};

impl Interval {
    /// π, to about so many bits: 16 arctan(1/5) − 4 arctan(1/239), by Machin.
    pub fn pi(bits: u64) -> Self {
        let places = bits + 16;
        let ((fifth, fifth_error), (other, other_error)) = (arctangent(5, places), arctangent(239, places));
        let (middle, error) = (fifth * 16_u8 - other * 4_u8, fifth_error * 16 + other_error * 4);
        let exponent = -i64::try_from(places).unwrap_or(i64::MAX);
        Self::between(Dyadic::new(&middle - error, exponent), Dyadic::new(middle + error, exponent))
    }

    /// cos(x) and sin(x), each in an interval of width about 2^−bits.
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
        // |x| < 2^(size + 1); halved so often that |y| ≤ 1/4.
        let halvings = x.numer().bits().saturating_sub(x.denom().bits()) + 3;
        let work = bits + 3 * halvings + 16;
        let y = x / Rational::from(BigInt::one() << halvings);
        let (mut cosine, mut sine) = small(&y, work);
        let one = Self::of(&Rational::one(), work);
        for _ in 0..halvings {
            // cos 2y = 1 − 2 sin² y, sin 2y = 2 sin y cos y
            let double = sine.plus(&sine, work);
            (cosine, sine) = (one.minus(&double.times(&sine, work), work), double.times(&cosine, work));
        }
        (cosine, sine)
    }
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

/// arctan(1/q) in units of 2^−places, and how many units it may be off.
fn arctangent(q: u32, places: u64) -> (BigInt, u64) {
    let mut power = (BigInt::one() << places) / q;
    let (mut sum, mut count) = (BigInt::zero(), 0_u64);
    while !power.is_zero() {
        let term = &power / (2 * count + 1);
        sum = if count.is_multiple_of(2) { sum + term } else { sum - term };
        power = power / q / q;
        count += 1;
    }
    // Each power is less than two units too small, each term less than three; the rest alternates and begins below two.
    (sum, 3 * count + 2)
}
