//! Matrices of integers over one denominator: sums and products, and nothing that could fail.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::document::DyadicMatrix;
use crate::scalar::Rational;

/// The least common multiple of positive integers, of which the first may be far longer.
fn common_multiple(long: &BigInt, short: &BigInt) -> BigInt {
    let rest = long % short;
    if rest.is_zero() { long.clone() } else { long * (short / rest.gcd(short)) }
}

/// `entries · 2^exponent / denominator`, by rows; the denominator is positive.
///
/// A number is a table with one entry.
#[derive(Clone, Debug)]
pub(super) struct Table {
    pub(super) rows: usize,
    pub(super) columns: usize,
    pub(super) entries: Vec<BigInt>,
    pub(super) exponent: i64,
    pub(super) denominator: BigInt,
}

impl Table {
    fn whole(rows: usize, columns: usize, entries: Vec<BigInt>) -> Self {
        Self { rows, columns, entries, exponent: 0, denominator: BigInt::one() }
    }

    pub(super) fn zero(rows: usize, columns: usize) -> Self {
        Self::whole(rows, columns, vec![BigInt::zero(); rows * columns])
    }

    pub(super) fn identity(n: usize) -> Self {
        let entries = (0..n * n).map(|place| BigInt::from(u8::from(place / n == place % n))).collect();
        Self::whole(n, n, entries)
    }

    /// An integer.
    pub(super) fn number(value: i64) -> Self {
        Self::whole(1, 1, vec![value.into()])
    }

    /// 2^exponent
    pub(super) fn power(exponent: i64) -> Self {
        Self { exponent, ..Self::number(1) }
    }

    /// Fractions over their least common denominator, its powers of two apart.
    pub(super) fn of<'a>(rows: usize, columns: usize, entry: impl Fn(usize, usize) -> &'a Rational) -> Self {
        let all = || (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j))).map(|(i, j)| entry(i, j));
        let common = all().fold(BigInt::one(), |common, value| common_multiple(&common, value.denom()));
        let entries = all().map(|value| value.numer() * (&common / value.denom())).collect();
        let twos = common.trailing_zeros().unwrap_or(0);
        let exponent = -i64::try_from(twos).unwrap_or(i64::MAX);
        Self { rows, columns, entries, exponent, denominator: common >> twos }
    }

    /// A matrix of a certificate; nothing where it has another shape.
    pub(super) fn full(matrix: &DyadicMatrix, rows: usize, columns: usize) -> Option<Self> {
        let fits = matrix.rows.len() == rows && matrix.rows.iter().all(|row| row.len() == columns);
        let entries = || matrix.rows.iter().flatten().map(|entry| entry.0.clone()).collect();
        fits.then(|| Self { exponent: matrix.exponent, ..Self::whole(rows, columns, entries()) })
    }

    /// A symmetric matrix by its lower triangle; nothing where it has another shape.
    pub(super) fn symmetric(matrix: &DyadicMatrix, n: usize) -> Option<Self> {
        let fits = matrix.rows.len() == n && matrix.rows.iter().enumerate().all(|(i, row)| row.len() == i + 1);
        let entry = |place: usize| matrix.rows[(place / n).max(place % n)][(place / n).min(place % n)].0.clone();
        fits.then(|| Self { exponent: matrix.exponent, ..Self::whole(n, n, (0..n * n).map(entry).collect()) })
    }

    pub(super) fn at(&self, row: usize, column: usize) -> &BigInt {
        &self.entries[row * self.columns + column]
    }

    /// One entry as a number.
    pub(super) fn entry(&self, row: usize, column: usize) -> Self {
        let entries = vec![self.at(row, column).clone()];
        Self { rows: 1, columns: 1, entries, exponent: self.exponent, denominator: self.denominator.clone() }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.entries.iter().all(Zero::is_zero)
    }

    /// Whether a number is above zero.
    pub(super) fn is_positive(&self) -> bool {
        self.entries.iter().all(Signed::is_positive)
    }

    /// e with all magnitudes, and all that are not zero inversely, below 2^e or so.
    pub(super) fn magnitude(&self) -> u64 {
        if self.is_zero() {
            return 0;
        }
        let longest = self.entries.iter().map(BigInt::bits).max().unwrap_or(0);
        self.exponent.unsigned_abs() + longest + self.denominator.bits()
    }

    fn map(&self, entry: impl FnMut(&BigInt) -> BigInt) -> Self {
        let entries = self.entries.iter().map(entry).collect();
        Self { entries, denominator: self.denominator.clone(), ..*self }
    }

    pub(super) fn negated(&self) -> Self {
        self.map(|entry| -entry)
    }

    pub(super) fn transposed(&self) -> Self {
        let entry = |place: usize| self.at(place % self.rows, place / self.rows).clone();
        let entries = (0..self.entries.len()).map(entry).collect();
        Self {
            rows: self.columns,
            columns: self.rows,
            entries,
            exponent: self.exponent,
            denominator: self.denominator.clone(),
        }
    }

    pub(super) fn times(&self, right: &Self) -> Self {
        debug_assert_eq!(self.columns, right.rows, "shapes were checked");
        let entry = |place: usize| {
            let (i, j) = (place / right.columns, place % right.columns);
            (0..self.columns).map(|k| self.at(i, k) * right.at(k, j)).sum()
        };
        Self {
            rows: self.rows,
            columns: right.columns,
            entries: (0..self.rows * right.columns).map(entry).collect(),
            exponent: self.exponent + right.exponent,
            denominator: &self.denominator * &right.denominator,
        }
    }

    /// `self · middle · selfᵀ`
    pub(super) fn around(&self, middle: &Self) -> Self {
        self.times(middle).times(&self.transposed())
    }

    /// `self · selfᵀ`
    pub(super) fn square(&self) -> Self {
        self.times(&self.transposed())
    }

    /// Both side by side.
    pub(super) fn beside(&self, right: &Self) -> Self {
        let padded = |table: &Self, before: usize| {
            let columns = self.columns + right.columns;
            let entry = |place: usize| match (place % columns).checked_sub(before) {
                Some(column) if column < table.columns => table.at(place / columns, column).clone(),
                _ => BigInt::zero(),
            };
            let entries = (0..table.rows * columns).map(entry).collect();
            Self { columns, entries, denominator: table.denominator.clone(), ..*table }
        };
        padded(self, 0).plus(&padded(right, self.columns))
    }

    /// The multiple by a number.
    pub(super) fn scaled(&self, factor: &Self) -> Self {
        let scaled = self.map(|entry| entry * factor.at(0, 0));
        Self {
            exponent: self.exponent + factor.exponent,
            denominator: &self.denominator * &factor.denominator,
            ..scaled
        }
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        debug_assert_eq!((self.rows, self.columns), (other.rows, other.columns), "shapes were checked");
        if self.is_zero() || other.is_zero() {
            return if self.is_zero() { other } else { self }.clone();
        }
        let (own, others, denominator) = if self.denominator == other.denominator {
            (BigInt::one(), BigInt::one(), self.denominator.clone())
        } else {
            let common = common_multiple(&self.denominator, &other.denominator);
            (&common / &self.denominator, &common / &other.denominator, common)
        };
        let exponent = self.exponent.min(other.exponent);
        let lift = |table: &Self, factor: &BigInt| factor << table.exponent.abs_diff(exponent);
        let (own, others) = (lift(self, &own), lift(other, &others));
        let entries = self.entries.iter().zip(&other.entries).map(|(a, b)| a * &own + b * &others).collect();
        Self { rows: self.rows, columns: self.columns, entries, exponent, denominator }
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negated())
    }

    /// The sum of the diagonal.
    pub(super) fn trace(&self) -> Self {
        let sum = (0..self.rows).map(|i| self.at(i, i)).sum();
        Self { rows: 1, columns: 1, entries: vec![sum], exponent: self.exponent, denominator: self.denominator.clone() }
    }

    /// The largest sum of the magnitudes of a row.
    pub(super) fn row_norm(&self) -> Self {
        let sums = (0..self.rows).map(|i| (0..self.columns).map(|j| self.at(i, j).abs()).sum::<BigInt>());
        let entries = vec![sums.max().unwrap_or_default()];
        Self { rows: 1, columns: 1, entries, exponent: self.exponent, denominator: self.denominator.clone() }
    }

    /// The rows with these places.
    pub(super) fn select_rows(&self, places: &[usize]) -> Self {
        let entries = places.iter().flat_map(|&i| (0..self.columns).map(move |j| self.at(i, j).clone())).collect();
        Self { rows: places.len(), entries, denominator: self.denominator.clone(), ..*self }
    }

    pub(super) fn select_columns(&self, places: &[usize]) -> Self {
        self.transposed().select_rows(places).transposed()
    }

    /// A number without denominator and of so many bits, not below the given one; of a smaller one, not above it.
    pub(super) fn above(&self, bits: u64) -> Self {
        let mantissa = self.at(0, 0);
        let length = i64::try_from(mantissa.bits()).unwrap_or(i64::MAX)
            - i64::try_from(self.denominator.bits()).unwrap_or(i64::MAX);
        let shift = i64::try_from(bits).unwrap_or(i64::MAX) - length;
        if self.denominator.is_one() && shift >= 0 {
            return self.clone();
        }
        let (over, under) = if shift >= 0 {
            (mantissa << shift, self.denominator.clone())
        } else {
            (mantissa.clone(), &self.denominator << shift.unsigned_abs())
        };
        Self { exponent: self.exponent - shift, ..Self::whole(1, 1, vec![Integer::div_ceil(&over, &under)]) }
    }

    /// The same from below.
    pub(super) fn below(&self, bits: u64) -> Self {
        self.negated().above(bits).negated()
    }
}
