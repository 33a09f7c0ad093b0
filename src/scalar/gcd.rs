//! The greatest common divisor of two large integers, by Lehmer's algorithm with leading parts of two words.
//!
//! Euclid's steps are done on the leading 128 bits of both numbers, and half of those on 62 of these bits, until the
//! product of the steps' matrices has entries of nearly a word; only then are the long numbers touched. The argument:
//!
//! Let a = x·2ᵏ + a′ and b = y·2ᵏ + b′ with 0 ≤ a′, b′ < 2ᵏ, and let p·x − q·y = r with p, q ≥ 0. Then
//! p·a − q·b ≥ (r − q)·2ᵏ + q, which is at least q if r ≥ q, whether or not Euclid's steps on a and b have the quotients
//! of those on x and y. A matrix of integers with determinant ±1 leaves the greatest common divisor as it is; so all
//! that must hold is r ≥ max(p, q) for both rows. Every step makes the sum of both numbers smaller, so the search ends.

use num_bigint::{BigInt, BigUint};
use num_integer::Integer;
use num_traits::{One, Zero};

/// The length of the numbers on which the innermost steps are done. The entries of their matrices are below 2³¹,
/// because an entry is at most the remainder, and entry times last remainder is at most the number begun with; so
/// the entries of a product of two such matrices are below 2⁶³.
const INNER: u32 = 62;

/// The greatest common divisor, not negative; that of 0 and 0 is 0.
///
/// # Examples
///
/// ```
/// use exact_kalman::scalar::common_divisor;
/// use num_bigint::BigInt;
///
/// let [a, b] = [150, 100].map(|power| BigInt::from(3).pow(power) << 40_u32);
/// assert_eq!(common_divisor(&a, &-&b), b);
/// ```
pub fn common_divisor(left: &BigInt, right: &BigInt) -> BigInt {
    let (left, right) = (left.magnitude(), right.magnitude());
    let (Some(left_twos), Some(right_twos)) = (left.trailing_zeros(), right.trailing_zeros()) else {
        return BigInt::from(left + right);
    };
    if left.is_one() || right.is_one() {
        return BigInt::one();
    }
    let odd = of_odd(&(left >> left_twos), &(right >> right_twos));
    BigInt::from(odd << left_twos.min(right_twos))
}

/// The same for odd numbers.
fn of_odd(left: &BigUint, right: &BigUint) -> BigUint {
    let (small, large) = if left.bits() <= right.bits() { (left, right) } else { (right, left) };
    if small.is_one() {
        return BigUint::one();
    }
    // The steps below cost the product of the lengths; a remainder of very different lengths is cheaper.
    let large = if large.bits() > small.bits() + 64 { &(large % small) } else { large };
    lehmer(large.to_u64_digits(), small.to_u64_digits())
}

fn lehmer(mut a: Vec<u64>, mut b: Vec<u64>) -> BigUint {
    loop {
        trim(&mut a);
        trim(&mut b);
        if a.len() < b.len() {
            std::mem::swap(&mut a, &mut b);
        }
        if b.is_empty() {
            return number(&a);
        }
        let n = a.len();
        if n <= 2 {
            return BigUint::from(double_word(&a).gcd(&double_word(&b)));
        }
        // Either number may be the larger one.
        let gap = (a[n - 1] | b.get(n - 1).copied().unwrap_or(0)).leading_zeros();
        let (mut x, mut y) = (leading(&a, n, gap), leading(&b, n, gap));
        if x < y {
            std::mem::swap(&mut a, &mut b);
            std::mem::swap(&mut x, &mut y);
        }
        if let Some(steps) = Steps::of_leading(x, y) {
            b.resize(n, 0);
            a.resize(n, 0);
            steps.apply(&mut a, &mut b);
        } else {
            let rest = (number(&a) % number(&b)).to_u64_digits();
            a = std::mem::replace(&mut b, rest);
        }
    }
}

fn trim(number: &mut Vec<u64>) {
    while number.last() == Some(&0) {
        number.pop();
    }
}

fn number(words: &[u64]) -> BigUint {
    let halves = words.iter().flat_map(|&word| [low_half(word), low_half(word >> 32)]);
    BigUint::new(halves.collect())
}

#[expect(clippy::cast_possible_truncation, reason = "the low half is wanted")]
fn low_half(word: u64) -> u32 {
    word as u32
}

fn word(number: &[u64], at: usize) -> u128 {
    u128::from(number.get(at).copied().unwrap_or(0))
}

fn double_word(number: &[u64]) -> u128 {
    word(number, 1) << 64 | word(number, 0)
}

/// The leading 128 bits of a number of at most `length` words, at least three, without the first `gap` bits.
fn leading(number: &[u64], length: usize, gap: u32) -> u128 {
    let top = word(number, length - 1) << 64 | word(number, length - 2);
    top << gap | (word(number, length - 3) << gap) >> 64
}

/// The matrix of some of Euclid's steps: `[p −q; −s t]` if their number is even, `[−p q; s −t]` if it is odd.
#[derive(Clone, Copy)]
struct Steps {
    /// `[[p, q], [s, t]]`
    rows: [[u64; 2]; 2],
    odd: bool,
}

impl Steps {
    /// Steps that leave every pair of numbers with these leading 128 bits, x ≥ y, without a negative one;
    /// nothing if a single division seems to do as much.
    fn of_leading(x: u128, y: u128) -> Option<Self> {
        let shift = (128 - INNER).saturating_sub(x.leading_zeros());
        let first = Self::of_numbers(inner(x, shift), inner(y, shift))?;
        let (x, y) = first.of_pair(x, y);
        let (first, x, y) = if x < y { (first.swapped(), y, x) } else { (first, x, y) };
        let shift = (128 - INNER).saturating_sub(x.leading_zeros());
        let Some(second) = Self::of_numbers(inner(x, shift), inner(y, shift)) else {
            return Some(first);
        };
        let both = second.after(&first);
        let (x, y) = second.of_pair(x, y);
        let enough = |number: u128, [p, q]: [u64; 2]| number >= u128::from(p.max(q));
        Some(if enough(x, both.rows[0]) && enough(y, both.rows[1]) { both } else { first })
    }

    /// Euclid's steps on x ≥ y of at most 62 bits, as long as no remainder is below its entries; nothing if the
    /// first does not.
    fn of_numbers(x: u64, y: u64) -> Option<Self> {
        let (mut a, mut b) = (x, y);
        let ([mut p, mut q], [mut s, mut t]) = ([1, 0], [0, 1]);
        let mut odd = false;
        while b != 0 {
            let quotient = a / b;
            let rest = a - quotient * b;
            // The second entry of a row is never the smaller one, since x ≥ y; it is at most x / b.
            let next = [p + quotient * s, q + quotient * t];
            if rest < next[1] {
                break;
            }
            (a, b) = (b, rest);
            ([p, q], [s, t]) = ([s, t], next);
            odd = !odd;
        }
        (t != 1 || odd).then_some(Self { rows: [[p, q], [s, t]], odd })
    }

    /// The same steps, the results exchanged.
    fn swapped(self) -> Self {
        Self { rows: [self.rows[1], self.rows[0]], odd: !self.odd }
    }

    /// The matrix of the earlier steps and these: absolute values multiply, as no sum cancels.
    fn after(&self, earlier: &Self) -> Self {
        let [above, below] = earlier.rows;
        let row = |[p, q]: [u64; 2]| [p * above[0] + q * below[0], p * above[1] + q * below[1]];
        Self { rows: self.rows.map(row), odd: self.odd != earlier.odd }
    }

    /// The results on numbers of two words; they are not negative, so that overflows on the way do not matter.
    fn of_pair(&self, x: u128, y: u128) -> (u128, u128) {
        let times = |number: u128, factor: u64| number.wrapping_mul(u128::from(factor));
        let [[p, q], [s, t]] = self.rows;
        let (first, second) = (times(x, p).wrapping_sub(times(y, q)), times(y, t).wrapping_sub(times(x, s)));
        if self.odd { (first.wrapping_neg(), second.wrapping_neg()) } else { (first, second) }
    }

    /// Replaces both numbers, of the same number of words, by the results.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a carry and a word are cut apart")]
    fn apply(&self, a: &mut Vec<u64>, b: &mut Vec<u64>) {
        let [[p, q], [s, t]] = self.rows;
        let [p, q, s, t] = if self.odd {
            std::mem::swap(a, b);
            [q, p, t, s]
        } else {
            [p, q, s, t]
        }
        .map(i128::from);
        // A product is below 2¹²⁷ − 2⁶⁴, so that a carry can be added to the difference of two.
        let (mut first, mut second) = (0_i128, 0_i128);
        for (a, b) in a.iter_mut().zip(b.iter_mut()) {
            let (x, y) = (i128::from(*a), i128::from(*b));
            first += p * x - q * y;
            second += t * y - s * x;
            *a = first as u64;
            *b = second as u64;
            first >>= 64;
            second >>= 64;
        }
        debug_assert!(first.is_zero() && second.is_zero(), "the results are not negative");
    }
}

#[expect(clippy::cast_possible_truncation, reason = "the shift leaves 62 bits")]
fn inner(number: u128, shift: u32) -> u64 {
    (number >> shift) as u64
}
