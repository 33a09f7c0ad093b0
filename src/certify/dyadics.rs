//! Matrices of integers over a power of two.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};

use super::packed::Packed;
use crate::matrix::Matrix;
use crate::scalar::{Dyadic, Rational};

/// `mantissas · 2^exponent`; arithmetic is exact.
#[derive(Clone, Debug)]
pub(super) struct Dyadics {
    pub(super) mantissas: Matrix<BigInt>,
    pub(super) exponent: i64,
}

/// The odd part of a positive integer, and the power of two beside it.
fn odd_part(integer: &BigInt) -> (BigInt, i64) {
    let twos = integer.trailing_zeros().unwrap_or(0);
    (integer >> twos, i64::try_from(twos).unwrap_or(i64::MAX))
}

/// The least common multiple of an odd integer and the odd parts of the denominators of some entries.
pub(super) fn odd_denominator<'a>(odd: BigInt, entries: impl IntoIterator<Item = &'a Rational>) -> BigInt {
    entries.into_iter().fold(odd, |odd, entry| {
        let (part, _) = odd_part(entry.denom());
        if part.is_one() { odd } else { odd.lcm(&part) }
    })
}

impl Dyadics {
    /// A matrix times an odd integer which its denominators divide but for powers of two.
    pub(super) fn of(matrix: &Matrix<Rational>, odd: &BigInt) -> Self {
        let twos = matrix.entries().iter().map(|entry| odd_part(entry.denom()).1).max().unwrap_or(0);
        let mantissas = matrix.map(|entry| {
            let (part, own) = odd_part(entry.denom());
            (entry.numer() * (odd / part)) << (twos - own)
        });
        Self { mantissas, exponent: -twos }
    }

    pub(super) fn rows(&self) -> usize {
        self.mantissas.rows()
    }

    /// One entry.
    pub(super) fn entry(&self, row: usize, column: usize) -> Dyadic {
        Dyadic::new(self.mantissas[(row, column)].clone(), self.exponent)
    }

    /// The diagonal.
    pub(super) fn diagonal(&self) -> Vec<Dyadic> {
        (0..self.rows()).map(|i| self.entry(i, i)).collect()
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        Packed::from(self).times(&other.into()).dyadics()
    }

    /// `self · middle · selfᵀ` for a symmetric one in the middle.
    pub(super) fn congruence(&self, middle: &Self) -> Self {
        Packed::from(self).congruence(&middle.into()).dyadics()
    }

    /// `self · selfᵀ`
    pub(super) fn square(&self) -> Self {
        Packed::from(self).square().dyadics()
    }

    pub(super) fn transposed(&self) -> Self {
        Self { mantissas: self.mantissas.transpose(), exponent: self.exponent }
    }

    /// The multiple by an integer.
    pub(super) fn scaled(&self, factor: &BigInt) -> Self {
        if factor.is_one() {
            return self.clone();
        }
        Self { mantissas: self.mantissas.map(|entry| entry * factor), exponent: self.exponent }
    }

    /// The multiple by a dyadic number.
    pub(super) fn multiple(&self, factor: &Dyadic) -> Self {
        let (mantissa, exponent) = factor.parts();
        Self { mantissas: self.mantissas.map(|entry| entry * mantissa), exponent: self.exponent + exponent }
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        let (a, b, exponent) = aligned(self, other);
        Self { mantissas: a + b, exponent }
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        let (a, b, exponent) = aligned(self, other);
        Self { mantissas: a - b, exponent }
    }

    /// The sum of the diagonal.
    pub(super) fn trace(&self) -> Dyadic {
        let sum = (0..self.rows()).fold(BigInt::zero(), |sum, i| sum + &self.mantissas[(i, i)]);
        Dyadic::new(sum, self.exponent)
    }

    /// The sum of the squares of all entries.
    pub(super) fn squared_norm(&self) -> Dyadic {
        let entries = self.mantissas.entries();
        Dyadic::new(inner(entries, entries), 2 * self.exponent)
    }

    pub(super) fn is_zero(&self) -> bool {
        self.mantissas.entries().iter().all(Zero::is_zero)
    }
}

/// Both with the exponent of the one whose last bits lie lower.
fn aligned(one: &Dyadics, other: &Dyadics) -> (Matrix<BigInt>, Matrix<BigInt>, i64) {
    // Zeros have any exponent.
    let exponent = match (one.is_zero(), other.is_zero()) {
        (true, _) => other.exponent,
        (_, true) => one.exponent,
        _ => one.exponent.min(other.exponent),
    };
    let lifted = |matrix: &Dyadics| match matrix.exponent - exponent {
        places if places > 0 => matrix.mantissas.map(|entry| entry << places),
        _ => matrix.mantissas.clone(),
    };
    (lifted(one), lifted(other), exponent)
}

fn inner(one: &[BigInt], other: &[BigInt]) -> BigInt {
    one.iter().zip(other).fold(BigInt::zero(), |sum, (a, b)| if a.is_zero() || b.is_zero() { sum } else { sum + a * b })
}

/// A symmetric matrix by its lower triangle.
pub(super) fn symmetric(n: usize, mut entry: impl FnMut(usize, usize) -> BigInt) -> Matrix<BigInt> {
    let mut matrix = Matrix::<BigInt>::zeros(n, n);
    for i in 0..n {
        for j in 0..=i {
            let value = entry(i, j);
            matrix[(j, i)].clone_from(&value);
            matrix[(i, j)] = value;
        }
    }
    matrix
}
