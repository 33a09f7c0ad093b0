//! Whether a symmetric matrix of integers is positive semidefinite.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::table::Table;

/// Bits of the entries of a factor, and the power of two by which what is taken from the scaled diagonal before it is factored is
/// below it: few first, more for what is nearly singular.
const TRIALS: [(u64, u64); 3] = [(64, 10), (256, 128), (1024, 512)];

/// Beyond so many bits times (rows)³ times columns nothing is eliminated exactly.
const WORK: u128 = 1 << 34;

/// Whether elimination of so many rows and columns would take too long.
fn is_long(rows: usize, columns: usize, entries: impl Iterator<Item = u64>) -> bool {
    let [rows, columns] = [rows, columns].map(|count| u128::try_from(count).unwrap_or(u128::MAX));
    let bits = u128::from(entries.max().unwrap_or(0));
    rows.saturating_pow(3).saturating_mul(columns).saturating_mul(bits) > WORK
}

/// Why a matrix is not known to be positive semidefinite.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Indefinite {
    /// A row.
    pub(super) row: usize,
    /// The binary logarithm, rounded up, of how far it falls short there, as far as it is known.
    pub(super) size: Option<i64>,
    /// Whether it is known to be indefinite.
    pub(super) is_decided: bool,
}

/// `matrix ≥ 0`, proved.
///
/// # Errors
///
/// [`Indefinite`] if it is not, or if to decide it would take too long.
pub(super) fn nonnegative(matrix: &Table) -> Result<(), Indefinite> {
    let n = matrix.rows;
    let mut places = Vec::with_capacity(n);
    for i in 0..n {
        let diagonal = matrix.at(i, i);
        if diagonal.is_negative() {
            return Err(short(matrix, i, diagonal));
        }
        if diagonal.is_positive() {
            places.push(i);
        } else if let Some(other) = (0..n).map(|j| matrix.at(i, j)).find(|entry| !entry.is_zero()) {
            return Err(short(matrix, i, other));
        }
    }
    decided(matrix, &places, false)
}

/// `matrix > 0`, proved.
///
/// # Errors
///
/// As [`nonnegative`].
pub(super) fn positive(matrix: &Table) -> Result<(), Indefinite> {
    let places: Vec<usize> = (0..matrix.rows).collect();
    match places.iter().find(|&&i| !matrix.at(i, i).is_positive()) {
        Some(&i) => Err(short(matrix, i, matrix.at(i, i))),
        None => decided(matrix, &places, true),
    }
}

fn short(matrix: &Table, row: usize, entry: &BigInt) -> Indefinite {
    let size = length(entry) + 1 + matrix.exponent - length(&matrix.denominator);
    Indefinite { row, size: Some(size), is_decided: true }
}

/// Decides for some rows and columns, whose diagonal is positive.
fn decided(matrix: &Table, places: &[usize], strictly: bool) -> Result<(), Indefinite> {
    let rest: Vec<Vec<BigInt>> =
        places.iter().map(|&i| places.iter().map(|&j| matrix.at(i, j).clone()).collect()).collect();
    // What is short is eliminated sooner than factored again.
    let (least, more) = TRIALS.split_at(1);
    if least.iter().any(|&trial| has_factor(&rest, trial)) {
        return Ok(());
    }
    if is_long(rest.len(), rest.len(), rest.iter().flatten().map(BigInt::bits)) {
        if more.iter().any(|&trial| has_factor(&rest, trial)) {
            return Ok(());
        }
        return Err(Indefinite { row: places.first().copied().unwrap_or(0), size: None, is_decided: false });
    }
    eliminated(rest, strictly).map_err(|row| Indefinite { row: places[row], size: None, is_decided: true })
}

fn length(integer: &BigInt) -> i64 {
    i64::try_from(integer.bits()).unwrap_or(i64::MAX) - 1
}

/// Whether the matrix is a factor times its transpose plus what is dominated by its diagonal. The diagonal is positive.
///
/// Each coordinate is first brought to its unit s, `mᵢⱼ = ⌊dᵢⱼ 2^(2b − sᵢ − sⱼ)⌋` for b bits; what is cut off lies between ± n on the
/// diagonal. Then `m = L Lᵀ + rest` for the integers L that an approximate factorisation finds, whatever they are.
fn has_factor(matrix: &[Vec<BigInt>], (bits, spared): (u64, u64)) -> bool {
    let n = matrix.len();
    let units: Vec<i64> = (0..n).map(|i| length(&matrix[i][i]) / 2 + 1).collect();
    let places = i64::try_from(2 * bits).unwrap_or(0);
    let entry = |i: usize, j: usize| match places - units[i] - units[j] {
        up if up >= 0 => &matrix[i][j] << up,
        down => &matrix[i][j] >> down.unsigned_abs(),
    };
    let scaled: Vec<Vec<BigInt>> = (0..n).map(|i| (0..=i).map(|j| entry(i, j)).collect()).collect();
    let spared = BigInt::one() << (2 * bits - spared);
    let mut factor: Vec<Vec<BigInt>> = Vec::with_capacity(n);
    for (i, entries) in scaled.iter().enumerate() {
        let mut row: Vec<BigInt> = Vec::with_capacity(i + 1);
        for (entry, above) in entries.iter().zip(&factor) {
            let taken: BigInt = row.iter().zip(above).map(|(a, b)| a * b).sum();
            row.push((entry - taken) / &above[row.len()]);
        }
        let pivot = &entries[i] - &spared - row.iter().map(|a| a * a).sum::<BigInt>();
        if !pivot.is_positive() {
            return false;
        }
        row.push(pivot.sqrt());
        factor.push(row);
    }
    let mut slack = vec![-BigInt::from(n); n];
    for (i, row) in scaled.iter().enumerate() {
        for (j, entry) in row.iter().enumerate() {
            let product: BigInt = factor[i].iter().zip(&factor[j]).map(|(a, b)| a * b).sum();
            let rest = entry - product;
            if i == j {
                slack[i] += rest;
            } else {
                slack[i] -= rest.abs();
                slack[j] -= rest.abs();
            }
        }
    }
    slack.iter().all(|slack| !slack.is_negative())
}

/// Elimination without fractions; or the row where a pivot is negative, or zero beside what is not; strictly, or zero.
fn eliminated(mut matrix: Vec<Vec<BigInt>>, strictly: bool) -> Result<(), usize> {
    let n = matrix.len();
    let mut last = BigInt::one();
    for k in 0..n {
        let pivot = matrix[k][k].clone();
        if pivot.is_negative() || (pivot.is_zero() && (strictly || matrix[k][k..].iter().any(|entry| !entry.is_zero())))
        {
            return Err(k);
        }
        if pivot.is_zero() {
            continue;
        }
        for i in k + 1..n {
            for j in k + 1..=i {
                // Minors: the division is exact.
                let entry = (&matrix[i][j] * &pivot - &matrix[i][k] * &matrix[k][j]) / &last;
                matrix[j][i].clone_from(&entry);
                matrix[i][j] = entry;
            }
        }
        last = pivot;
    }
    Ok(())
}

/// The rank of rows of integers; nothing if it would take too long.
pub(super) fn rank(mut rows: Vec<Vec<BigInt>>) -> Option<usize> {
    let columns = rows.first().map_or(0, Vec::len);
    if is_long(rows.len(), columns, rows.iter().flatten().map(BigInt::bits)) {
        return None;
    }
    let (mut rank, mut last) = (0, BigInt::one());
    for column in 0..columns {
        let Some(found) = (rank..rows.len()).find(|&i| !rows[i][column].is_zero()) else { continue };
        rows.swap(rank, found);
        let (above, below) = rows.split_at_mut(rank + 1);
        let top = &above[rank];
        for row in below {
            for j in (column..columns).rev() {
                row[j] = (&row[j] * &top[column] - &row[column] * &top[j]) / &last;
            }
        }
        last.clone_from(&rows[rank][column]);
        rank += 1;
    }
    Some(rank)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Rational;

    fn table(rows: &[&[i64]]) -> Table {
        let entries: Vec<Rational> = rows.iter().flat_map(|row| row.iter().map(|&x| BigInt::from(x).into())).collect();
        Table::of(rows.len(), rows.len(), |i, j| &entries[i * rows.len() + j])
    }

    #[test]
    fn all_small_matrices_are_decided_by_their_minors() {
        for code in 0..5_i64.pow(6) {
            let digit = |place: u32| (code / 5_i64.pow(place)) % 5 - 2;
            let [a, b, c, d, e, f] = [0, 1, 2, 3, 4, 5].map(digit);
            let minors = [
                a,
                c,
                f,
                a * c - b * b,
                a * f - d * d,
                c * f - e * e,
                a * (c * f - e * e) - b * (b * f - e * d) + d * (b * e - c * d),
            ];
            let expected = minors.iter().all(|&minor| minor >= 0);
            let matrix = table(&[&[a, b, d], &[b, c, e], &[d, e, f]]);
            assert_eq!(nonnegative(&matrix).is_ok(), expected, "{matrix:?}");
            let is_positive = a > 0 && a * c > b * b && minors[6] > 0;
            assert_eq!(positive(&matrix).is_ok(), is_positive, "{matrix:?}");
            let rows: Vec<Vec<BigInt>> = matrix.entries.chunks(3).map(<[_]>::to_vec).collect();
            // What has a factor is semidefinite even where it is not asked for.
            assert!(
                expected || !(a > 0 && c > 0 && f > 0 && TRIALS.iter().any(|&trial| has_factor(&rows, trial))),
                "{matrix:?}"
            );
        }
    }

    /// [[1, 1 − t], [1 − t, 1]] in units that lie far apart, t = ± a little.
    #[test]
    fn nearly_singular_matrices_are_decided() {
        for place in [1, 5, 20, 63, 64, 65, 127, 200, 700] {
            for (unit, sign) in [(0, 1), (500, 1), (0, -1), (500, -1)] {
                let one: BigInt = BigInt::one() << place;
                let off: BigInt = &one - sign;
                let entries = vec![one.clone() << (2 * unit), &off << unit, off << unit, one];
                let matrix = Table { rows: 2, columns: 2, entries, exponent: 0, denominator: BigInt::one() };
                assert_eq!(nonnegative(&matrix).is_ok(), sign > 0, "{place} {unit}");
            }
        }
    }

    /// L Lᵀ with ones on the diagonal of L and fives below it: its least eigenvalue is about 5^−80 of its largest entry.
    #[test]
    fn factors_get_the_bits_that_they_need() {
        let entry = |i: usize, j: usize| match i.abs_diff(j) {
            0 => BigInt::from(if i == 0 { 1 } else { 26 }),
            1 => BigInt::from(5),
            _ => BigInt::zero(),
        };
        let mut matrix: Vec<Vec<BigInt>> = (0..40).map(|i| (0..40).map(|j| entry(i, j)).collect()).collect();
        let found = |matrix: &[Vec<BigInt>]| TRIALS.map(|trial| has_factor(matrix, trial));
        assert_eq!(found(&matrix), [false, false, true]);
        // Less a little it is indefinite.
        matrix[39][39] -= 2;
        assert_eq!(found(&matrix), [false; 3]);
    }

    #[test]
    fn the_rank_counts_independent_rows() {
        let rows = |rows: &[&[i64]]| rows.iter().map(|row| row.iter().map(|&x| x.into()).collect()).collect();
        assert_eq!(rank(rows(&[&[0, 0, 2], &[1, 2, 3], &[1, 2, 5], &[2, 4, 0]])), Some(2));
        assert_eq!(rank(rows(&[&[0, 3], &[0, 0]])), Some(1));
        assert_eq!(rank(rows(&[&[2, 3, 1], &[4, 5, 1], &[6, 7, 2]])), Some(3));
        assert_eq!(rank(Vec::new()), Some(0));
        // A unit matrix of long entries.
        let long =
            |n: usize| (0..n).map(|i| (0..n).map(|j| BigInt::from(u8::from(i == j)) << 4096).collect()).collect();
        assert_eq!((rank(long(40)), rank(long(50))), (Some(40), None));
    }
}
