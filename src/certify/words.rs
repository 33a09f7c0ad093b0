//! Products of matrices of integers of a few words each.
//!
//! With integers this short, memory that is asked for and given back takes longer than multiplying. So the words of a whole matrix stand
//! beside each other, and a sum of products is made in one place.

use num_bigint::{BigInt, BigUint, Sign};

use crate::matrix::Matrix;

/// Beyond so many words, products of single integers are faster (Karatsuba and better).
const MOST_WORDS: usize = 24;

/// The entries of a matrix row by row, each as its magnitude of `length` words, the least first, and its sign.
#[derive(Debug)]
struct Words {
    rows: usize,
    columns: usize,
    length: usize,
    magnitudes: Vec<u64>,
    negative: Vec<bool>,
}

/// An integer of the matrix: no leading zeros.
#[derive(Clone, Copy)]
struct Integer<'w> {
    words: &'w [u64],
    negative: bool,
}

fn length(matrix: &Matrix<BigInt>) -> usize {
    matrix.entries().iter().map(|entry| entry.magnitude().iter_u64_digits().len()).max().unwrap_or(0)
}

impl Words {
    /// The entries of a matrix.
    fn of(matrix: &Matrix<BigInt>) -> Self {
        Self::pack(matrix.rows(), matrix.columns(), matrix.entries().iter(), length(matrix))
    }

    /// The entries of the transpose of a matrix.
    fn of_transpose(matrix: &Matrix<BigInt>) -> Self {
        let (rows, columns) = (matrix.columns(), matrix.rows());
        let entries = (0..rows).flat_map(|i| (0..columns).map(move |j| &matrix[(j, i)]));
        Self::pack(rows, columns, entries, length(matrix))
    }

    fn pack<'e>(rows: usize, columns: usize, entries: impl Iterator<Item = &'e BigInt>, length: usize) -> Self {
        let mut magnitudes = Vec::with_capacity(rows * columns * length);
        let mut negative = Vec::with_capacity(rows * columns);
        for entry in entries {
            magnitudes.extend(entry.magnitude().iter_u64_digits());
            negative.push(entry.sign() == Sign::Minus);
            magnitudes.resize(negative.len() * length, 0);
        }
        Self { rows, columns, length, magnitudes, negative }
    }

    fn integer(&self, row: usize, column: usize) -> Integer<'_> {
        let place = row * self.columns + column;
        let words = &self.magnitudes[place * self.length..(place + 1) * self.length];
        let leading = words.iter().rev().take_while(|&&word| word == 0).count();
        Integer { words: &words[..self.length - leading], negative: self.negative[place] }
    }

    /// `Σₖ aᵢₖ bⱼₖ` for all rows i of these and j of others, or for j ≤ i where the product is known to be symmetric.
    fn by_rows_of(&self, other: &Self, is_symmetric: bool) -> Self {
        let (rows, columns) = (self.rows, other.rows);
        // The last word takes the carries of all sums, and the sign.
        let length = self.length + other.length + 1;
        let mut magnitudes = vec![0; rows * columns * length];
        let mut negative = vec![false; rows * columns];
        for i in 0..rows {
            for j in 0..if is_symmetric { i + 1 } else { columns } {
                let place = i * columns + j;
                let sum = &mut magnitudes[place * length..(place + 1) * length];
                for k in 0..self.columns {
                    add_product(sum, self.integer(i, k), other.integer(j, k));
                }
                if sum.last().is_some_and(|last| last >> 63 == 1) {
                    negate(sum);
                    negative[place] = true;
                }
            }
        }
        Self { rows, columns, length, magnitudes, negative }
    }

    fn unpacked(&self, row: usize, column: usize) -> BigInt {
        let Integer { words, negative } = self.integer(row, column);
        #[expect(clippy::cast_possible_truncation, reason = "the two halves of a word")]
        let halves = words.iter().flat_map(|&word| [word as u32, (word >> 32) as u32]).collect();
        BigInt::from_biguint(if negative { Sign::Minus } else { Sign::Plus }, BigUint::new(halves))
    }
}

/// Adds a product to a sum in two's complement.
fn add_product(sum: &mut [u64], a: Integer<'_>, b: Integer<'_>) {
    let adds = a.negative == b.negative;
    for (i, &x) in a.words.iter().enumerate() {
        if x == 0 {
            continue;
        }
        let (mut carry, mut rest) = (0_u64, sum[i..].iter_mut());
        for &y in b.words {
            let Some(word) = rest.next() else { return };
            // (2^64 − 1)² + (2^64 − 1) < 2^128
            let product = u128::from(x) * u128::from(y) + u128::from(carry);
            #[expect(clippy::cast_possible_truncation, reason = "the two halves of a product")]
            let (low, high) = (product as u64, (product >> 64) as u64);
            let (next, overflows) = if adds { word.overflowing_add(low) } else { word.overflowing_sub(low) };
            *word = next;
            // The upper half is all ones only where the lower is zero, and then nothing overflows.
            carry = high + u64::from(overflows);
        }
        for word in rest {
            if carry == 0 {
                break;
            }
            let (next, overflows) = if adds { word.overflowing_add(carry) } else { word.overflowing_sub(carry) };
            *word = next;
            carry = u64::from(overflows);
        }
    }
}

fn negate(words: &mut [u64]) {
    let mut carry = true;
    for word in words {
        let (next, overflows) = (!*word).overflowing_add(u64::from(carry));
        *word = next;
        carry = overflows;
    }
}

/// Whether both are short enough.
fn are_short(a: &Matrix<BigInt>, b: &Matrix<BigInt>) -> bool {
    length(a).min(length(b)) <= MOST_WORDS
}

/// `a b`
pub(super) fn product(a: &Matrix<BigInt>, b: &Matrix<BigInt>) -> Matrix<BigInt> {
    if !are_short(a, b) {
        return a * b;
    }
    let product = Words::of(a).by_rows_of(&Words::of_transpose(b), false);
    Matrix::from_fn(product.rows, product.columns, |i, j| product.unpacked(i, j))
}

/// `a m aᵀ` for a symmetric matrix m; `a aᵀ` without one.
pub(super) fn congruence(a: &Matrix<BigInt>, middle: Option<&Matrix<BigInt>>) -> Matrix<BigInt> {
    if !are_short(a, middle.unwrap_or(a)) {
        let transpose = a.transpose();
        return middle.map_or_else(|| a * &transpose, |middle| &(a * middle) * &transpose);
    }
    let rows = Words::of(a);
    let product = match middle {
        Some(middle) => rows.by_rows_of(&Words::of(middle), false).by_rows_of(&rows, true),
        None => rows.by_rows_of(&rows, true),
    };
    Matrix::from_fn(product.rows, product.columns, |i, j| product.unpacked(i.max(j), i.min(j)))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Of up to five words; zeros, powers of two and words of ones are frequent, for carries.
    fn entry() -> impl Strategy<Value = BigInt> {
        let word = prop_oneof![Just(0), Just(u64::MAX), Just(1 << 63), any::<u64>()];
        (any::<bool>(), proptest::collection::vec(word, 0..5)).prop_map(|(negative, words)| {
            let magnitude = words.iter().fold(BigInt::from(0), |sum, &word| (sum << 64) + word);
            if negative { -magnitude } else { magnitude }
        })
    }

    fn matrix(rows: usize, columns: usize) -> impl Strategy<Value = Matrix<BigInt>> {
        proptest::collection::vec(entry(), rows * columns)
            .prop_map(move |entries| Matrix::from_fn(rows, columns, |i, j| entries[i * columns + j].clone()))
    }

    proptest! {
        /// Sums of products of single integers say what is right.
        #[test]
        fn products_are_sums_of_products((a, b, m) in (1..4_usize, 0..4_usize, 1..4_usize).prop_flat_map(|(r, k, c)| {
            (matrix(r, k), matrix(k, c), matrix(k, k))
        })) {
            let sum = |i: usize, j: usize| (0..b.rows()).map(|k| &a[(i, k)] * &b[(k, j)]).sum::<BigInt>();
            prop_assert_eq!(product(&a, &b), Matrix::from_fn(a.rows(), b.columns(), sum));
            let middle = &m + &m.transpose();
            let all = || (0..a.columns()).flat_map(|k| (0..a.columns()).map(move |l| (k, l)));
            let term = |i: usize, j: usize| all().map(|(k, l)| &a[(i, k)] * &middle[(k, l)] * &a[(j, l)]).sum::<BigInt>();
            prop_assert_eq!(congruence(&a, Some(&middle)), Matrix::from_fn(a.rows(), a.rows(), term));
            let square = |i: usize, j: usize| (0..a.columns()).map(|k| &a[(i, k)] * &a[(j, k)]).sum::<BigInt>();
            prop_assert_eq!(congruence(&a, None), Matrix::from_fn(a.rows(), a.rows(), square));
        }
    }

    /// Past the bound the other way gives the same.
    #[test]
    fn long_integers_too() {
        let long = |shift: usize| (BigInt::from(3) << (64 * MOST_WORDS + shift)) - 1;
        let a = Matrix::from_fn(2, 2, |i, j| long(i + 2 * j));
        let sum = |i: usize, j: usize| &a[(i, 0)] * &a[(0, j)] + &a[(i, 1)] * &a[(1, j)];
        assert_eq!(product(&a, &a), Matrix::from_fn(2, 2, sum));
        let square = |i: usize, j: usize| &a[(i, 0)] * &a[(j, 0)] + &a[(i, 1)] * &a[(j, 1)];
        assert_eq!(congruence(&a, None), Matrix::from_fn(2, 2, square));
    }
}
