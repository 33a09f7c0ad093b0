//! Matrices of integers over a power of two whose words stand beside each other.

mod rounding;
#[cfg(test)]
mod tests;

use num_bigint::{BigInt, BigUint, Sign};
use num_traits::{One, ToPrimitive as _, Zero};

use super::dyadics::Dyadics;
use super::words::{Integer, add_product, add_shifted, length, lift, negate, used};
use crate::matrix::Matrix;
use crate::scalar::Dyadic;

/// Beyond so many words, products of single integers are faster (Karatsuba and better).
const MOST_WORDS: usize = 24;

/// `mantissas · 2^exponent`, row by row, each mantissa as its magnitude of `length` words, the least first, and its sign;
/// arithmetic is exact.
#[derive(Clone, Debug)]
pub(super) struct Packed {
    rows: usize,
    columns: usize,
    length: usize,
    magnitudes: Vec<u64>,
    negative: Vec<bool>,
    exponent: i64,
    /// Whether it is known to be symmetric: then sums and multiples need the triangle alone.
    is_symmetric: bool,
}

/// Which entries are computed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    All,
    /// Those on and below the diagonal, of a matrix that is known to be symmetric.
    Triangle,
}

impl From<&Dyadics> for Packed {
    fn from(matrix: &Dyadics) -> Self {
        Self::of(&matrix.mantissas, matrix.exponent)
    }
}

impl Packed {
    fn of(mantissas: &Matrix<BigInt>, exponent: i64) -> Self {
        let words = |entry: &BigInt| entry.magnitude().iter_u64_digits().len();
        let length = mantissas.entries().iter().map(words).max().unwrap_or(0);
        let mut magnitudes = Vec::with_capacity(mantissas.entries().len() * length);
        let mut negative = Vec::with_capacity(mantissas.entries().len());
        for entry in mantissas.entries() {
            magnitudes.extend(entry.magnitude().iter_u64_digits());
            negative.push(entry.sign() == Sign::Minus);
            magnitudes.resize(negative.len() * length, 0);
        }
        let (rows, columns) = (mantissas.rows(), mantissas.columns());
        Self { rows, columns, length, magnitudes, negative, exponent, is_symmetric: false }
    }

    /// The same matrix, which is symmetric.
    pub(super) fn symmetric(self) -> Self {
        debug_assert!(self.rows == self.columns && self.mantissas() == self.mantissas().transpose());
        Self { is_symmetric: true, ..self }
    }

    /// Which entries of a sum with another, or of a multiple, are computed.
    fn part(&self, other: &Self) -> Part {
        if self.is_symmetric && other.is_symmetric { Part::Triangle } else { Part::All }
    }

    /// The same with integers of their own.
    pub(super) fn dyadics(&self) -> Dyadics {
        Dyadics { mantissas: self.mantissas(), exponent: self.exponent }
    }

    fn mantissas(&self) -> Matrix<BigInt> {
        Matrix::from_fn(self.rows, self.columns, |i, j| self.mantissa(i, j))
    }

    pub(super) fn identity(n: usize) -> Self {
        let magnitudes = (0..n * n).map(|place| u64::from(place / n == place % n)).collect();
        let negative = vec![false; n * n];
        Self { rows: n, columns: n, length: 1, magnitudes, negative, exponent: 0, is_symmetric: true }
    }

    /// A matrix whose entries are sums made in places of so many words, in two's complement.
    fn built(
        (rows, columns): (usize, usize),
        length: usize,
        exponent: i64,
        part: Part,
        mut sum: impl FnMut(&mut [u64], usize, usize),
    ) -> Self {
        let mut magnitudes = vec![0; rows * columns * length];
        let mut negative = vec![false; rows * columns];
        let mut longest = 0;
        for i in 0..rows {
            for j in 0..if part == Part::Triangle { i + 1 } else { columns } {
                let place = i * columns + j;
                let words = &mut magnitudes[place * length..(place + 1) * length];
                sum(words, i, j);
                if words.last().is_some_and(|last| last >> 63 == 1) {
                    negate(words);
                    negative[place] = true;
                }
                longest = longest.max(used(words));
            }
        }
        let is_symmetric = part == Part::Triangle;
        let mut matrix = Self { rows, columns, length, magnitudes, negative, exponent, is_symmetric };
        matrix.shorten(longest);
        if is_symmetric {
            matrix.mirror();
        }
        matrix
    }

    /// The same with so many words for each entry, which hold them.
    fn shorten(&mut self, length: usize) {
        if length == self.length {
            return;
        }
        for place in 0..self.negative.len() {
            let from = place * self.length;
            self.magnitudes.copy_within(from..from + length, place * length);
        }
        self.magnitudes.truncate(self.negative.len() * length);
        self.length = length;
    }

    /// Copies what is below the diagonal to above it.
    fn mirror(&mut self) {
        for i in 0..self.rows {
            for j in 0..i {
                let (from, to) = (i * self.columns + j, j * self.columns + i);
                self.magnitudes.copy_within(from * self.length..(from + 1) * self.length, to * self.length);
                self.negative[to] = self.negative[from];
            }
        }
    }

    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    #[cfg(all(test, feature = "judge"))]
    pub(super) fn columns(&self) -> usize {
        self.columns
    }

    pub(super) fn exponent(&self) -> i64 {
        self.exponent
    }

    /// The mantissa of an entry.
    pub(super) fn integer(&self, row: usize, column: usize) -> Integer<'_> {
        let place = row * self.columns + column;
        Integer::new(&self.magnitudes[place * self.length..(place + 1) * self.length], self.negative[place])
    }

    pub(super) fn mantissa(&self, row: usize, column: usize) -> BigInt {
        whole(self.integer(row, column))
    }

    /// One entry.
    pub(super) fn entry(&self, row: usize, column: usize) -> Dyadic {
        Dyadic::new(self.mantissa(row, column), self.exponent)
    }

    /// The diagonal.
    pub(super) fn diagonal(&self) -> Vec<Dyadic> {
        (0..self.rows).map(|i| self.entry(i, i)).collect()
    }

    pub(super) fn is_zero(&self) -> bool {
        self.length == 0 || self.magnitudes.iter().all(|&word| word == 0)
    }

    pub(super) fn transposed(&self) -> Self {
        let mut transposed = self.clone();
        if self.is_symmetric {
            return transposed;
        }
        (transposed.rows, transposed.columns) = (self.columns, self.rows);
        for i in 0..self.rows {
            for j in 0..self.columns {
                let (from, to) = (i * self.columns + j, j * self.rows + i);
                let words = &self.magnitudes[from * self.length..(from + 1) * self.length];
                transposed.magnitudes[to * self.length..(to + 1) * self.length].copy_from_slice(words);
                transposed.negative[to] = self.negative[from];
            }
        }
        transposed
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let exponent = self.exponent + other.exponent;
        if self.length.min(other.length) > MOST_WORDS {
            return Self::of(&(&self.mantissas() * &other.mantissas()), exponent);
        }
        // The last word takes the carries of all sums, and the sign.
        let length = self.length + other.length + 1;
        Self::built((self.rows, other.columns), length, exponent, Part::All, |sum, i, j| {
            for k in 0..self.columns {
                add_product(sum, self.integer(i, k), other.integer(k, j));
            }
        })
    }

    /// `self · otherᵀ`
    pub(super) fn times_transposed(&self, other: &Self) -> Self {
        self.by_rows_of(other, Part::All)
    }

    fn by_rows_of(&self, other: &Self, part: Part) -> Self {
        let exponent = self.exponent + other.exponent;
        if self.length.min(other.length) > MOST_WORDS {
            return Self::of(&(&self.mantissas() * &other.mantissas().transpose()), exponent);
        }
        let length = self.length + other.length + 1;
        Self::built((self.rows, other.rows), length, exponent, part, |sum, i, j| {
            for k in 0..self.columns {
                add_product(sum, self.integer(i, k), other.integer(j, k));
            }
        })
    }

    /// `self · middle · selfᵀ` for a symmetric one in the middle.
    pub(super) fn congruence(&self, middle: &Self) -> Self {
        self.by_rows_of(middle, Part::All).by_rows_of(self, Part::Triangle)
    }

    /// `self · selfᵀ`
    pub(super) fn square(&self) -> Self {
        self.by_rows_of(self, Part::Triangle)
    }

    /// The multiple by an integer.
    pub(super) fn scaled(&self, factor: &BigInt) -> Self {
        if factor.is_one() { self.clone() } else { self.multiplied(factor, 0) }
    }

    /// The multiple by a dyadic number.
    pub(super) fn multiple(&self, factor: &Dyadic) -> Self {
        let (mantissa, exponent) = factor.parts();
        self.multiplied(mantissa, exponent)
    }

    fn multiplied(&self, mantissa: &BigInt, exponent: i64) -> Self {
        let exponent = self.exponent + exponent;
        if let Some(single) = mantissa.magnitude().to_u64() {
            let factor = [single];
            return self.multiplied_by_words(Integer::new(&factor, mantissa.sign() == Sign::Minus), exponent);
        }
        let words: Vec<u64> = mantissa.magnitude().iter_u64_digits().collect();
        if words.len().min(self.length) > MOST_WORDS {
            return Self::of(&self.mantissas().map(|entry| entry * mantissa), exponent);
        }
        self.multiplied_by_words(Integer::new(&words, mantissa.sign() == Sign::Minus), exponent)
    }

    fn multiplied_by_words(&self, factor: Integer<'_>, exponent: i64) -> Self {
        let length = self.length + factor.words.len() + 1;
        Self::built((self.rows, self.columns), length, exponent, self.part(self), |sum, i, j| {
            add_product(sum, self.integer(i, j), factor);
        })
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        self.joined(other, false)
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        self.joined(other, true)
    }

    /// The sum or the difference, with the exponent of the one whose last bits lie lower.
    fn joined(&self, other: &Self, is_less: bool) -> Self {
        assert_eq!((self.rows, self.columns), (other.rows, other.columns), "of one shape");
        // Zeros have any exponent.
        let exponent = match (self.is_zero(), other.is_zero()) {
            (true, _) => other.exponent,
            (_, true) => self.exponent,
            _ => self.exponent.min(other.exponent),
        };
        let places = |matrix: &Self| (matrix.exponent - exponent).max(0).unsigned_abs();
        let (own, others) = (places(self), places(other));
        let bits = |matrix: &Self, places| if matrix.is_zero() { 0 } else { 64 * matrix.length as u64 + places };
        let length = length(bits(self, own).max(bits(other, others)) + 1);
        Self::built((self.rows, self.columns), length, exponent, self.part(other), |sum, i, j| {
            add_shifted(sum, self.integer(i, j), own);
            let other = other.integer(i, j);
            add_shifted(sum, if is_less { other.negated() } else { other }, others);
        })
    }

    /// `self + a bᵀ − c dᵀ`, which is known to be symmetric, as are these.
    pub(super) fn with_products(&self, (a, b): (&Self, &Self), (c, d): (&Self, &Self)) -> Self {
        if a.length.max(b.length).max(c.length).max(d.length) > MOST_WORDS {
            return self.minus(&c.times_transposed(d)).plus(&a.times_transposed(b));
        }
        let exponents = (a.exponent + b.exponent, c.exponent + d.exponent);
        // What has the higher exponent is lifted to the other one.
        let (above, below, first, next) = if exponents.0 < exponents.1 {
            (exponents.1, exponents.0, (c, d, true), (a, b, false))
        } else {
            (exponents.0, exponents.1, (a, b, false), (c, d, true))
        };
        let exponent = below.min(self.exponent);
        let places = |exponent: i64, to: i64| (exponent - to).unsigned_abs();
        let bits = |matrix: &Self, places: u64| 64 * matrix.length as u64 + places;
        let of_first = 64 * (first.0.length + first.1.length + 1) as u64 + places(above, exponent);
        let of_next = 64 * (next.0.length + next.1.length + 1) as u64 + places(below, exponent);
        let longest = of_first.max(of_next).max(bits(self, places(self.exponent, exponent)));
        let add = |sum: &mut [u64], (left, right, is_less): (&Self, &Self, bool), i, j| {
            for k in 0..left.columns {
                let own = left.integer(i, k);
                add_product(sum, if is_less { own.negated() } else { own }, right.integer(j, k));
            }
        };
        Self::built((self.rows, self.columns), length(longest + 2), exponent, Part::Triangle, |sum, i, j| {
            add(sum, first, i, j);
            lift(sum, places(above, below));
            add(sum, next, i, j);
            lift(sum, places(below, exponent));
            add_shifted(sum, self.integer(i, j), places(self.exponent, exponent));
        })
    }

    /// The sum of the diagonal.
    pub(super) fn trace(&self) -> Dyadic {
        let mut sum = vec![0; self.length + 1];
        (0..self.rows).for_each(|i| add_shifted(&mut sum, self.integer(i, i), 0));
        self.of_sum(sum, self.exponent)
    }

    /// The sum of the squares of all entries.
    pub(super) fn squared_norm(&self) -> Dyadic {
        if self.length > MOST_WORDS {
            return self.dyadics().squared_norm();
        }
        let mut sum = vec![0; 2 * self.length + 1];
        for i in 0..self.rows {
            (0..self.columns).for_each(|j| add_product(&mut sum, self.integer(i, j), self.integer(i, j)));
        }
        self.of_sum(sum, 2 * self.exponent)
    }

    /// The largest sum of the magnitudes of a row.
    pub(super) fn largest_row_sum(&self) -> Dyadic {
        let sum_of = |i: usize| {
            let mut sum = vec![0; self.length + 1];
            for j in 0..self.columns {
                add_shifted(&mut sum, Integer { negative: false, ..self.integer(i, j) }, 0);
            }
            self.of_sum(sum, self.exponent)
        };
        (0..self.rows).map(sum_of).max().unwrap_or_else(Dyadic::zero)
    }

    fn of_sum(&self, mut sum: Vec<u64>, exponent: i64) -> Dyadic {
        debug_assert!(self.rows < 1 << 32, "a word takes the carries");
        let is_negative = sum.last().is_some_and(|last| last >> 63 == 1);
        if is_negative {
            negate(&mut sum);
        }
        Dyadic::new(whole(Integer::new(&sum, is_negative)), exponent)
    }

    /// The matrix plus a diagonal of integers times its unit.
    pub(super) fn plus_diagonal(&self, diagonal: &[BigInt]) -> Self {
        let longest = diagonal.iter().map(BigInt::bits).max().unwrap_or(0);
        let length = length(longest.max(64 * self.length as u64) + 1);
        let mut words = Vec::new();
        Self::built((self.rows, self.columns), length, self.exponent, self.part(self), |sum, i, j| {
            add_shifted(sum, self.integer(i, j), 0);
            if i == j && !diagonal[i].is_zero() {
                words.clear();
                words.extend(diagonal[i].magnitude().iter_u64_digits());
                add_shifted(sum, Integer::new(&words, diagonal[i].sign() == Sign::Minus), 0);
            }
        })
    }
}

fn whole(integer: Integer<'_>) -> BigInt {
    let sign = if integer.negative { Sign::Minus } else { Sign::Plus };
    let magnitude = match *integer.words {
        [] => return BigInt::zero(),
        [only] => BigUint::from(only),
        [low, high] => BigUint::from(u128::from(high) << 64 | u128::from(low)),
        ref words => {
            #[expect(clippy::cast_possible_truncation, reason = "the two halves of a word")]
            let halves = words.iter().flat_map(|&word| [word as u32, (word >> 32) as u32]).collect();
            BigUint::new(halves)
        }
    };
    BigInt::from_biguint(sign, magnitude)
}
