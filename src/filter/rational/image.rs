//! What a linear map with noise makes of a state, in integers.

use num_bigint::BigInt;
use num_traits::{One, Zero};

use super::state::State;
use crate::matrix::{Fractions, Matrix};

/// The places of E N Eᵀ at and below the diagonal that are asked for; zero elsewhere.
///
/// > `(w/e²) Eᵢ N Eᵢᵀ + u d Qᵢ` over `w u d`, w a common denominator of E ⊗ E and of the noise
pub(super) fn covariance(
    state: &State,
    map: &Fractions,
    noise: &Fractions,
    w: &BigInt,
    wanted: impl Fn(usize, usize) -> bool,
) -> Matrix<BigInt> {
    let rows = map.numerators.rows();
    // N is symmetric: its rows are its columns.
    let half =
        Matrix::from_fn(rows, map.numerators.columns(), |i, k| dot(map.numerators.row(i), state.numerators.row(k)));
    let map = map.over(&(w / &map.denominator));
    let unit = &state.scale * &state.divisor * (w / &noise.denominator);
    Matrix::from_fn(rows, rows, |i, j| {
        if j > i || !wanted(i, j) {
            return BigInt::zero();
        }
        let seen = dot(map.row(i), half.row(j));
        let noise = &noise.numerators[(i, j)];
        if noise.is_zero() { seen } else { seen + noise * &unit }
    })
}

/// > `(z/e) Eᵢ X − u d cᵢ` over `z u d`, z a common denominator of E and of the constants c, u the scale of the mean
pub(super) fn mean(state: &State, map: &Fractions, constant: &Fractions, z: &BigInt) -> Matrix<BigInt> {
    let factor = z / &map.denominator;
    let unit = &state.mean_scale * &state.divisor * (z / &constant.denominator);
    Matrix::from_fn(map.numerators.rows(), 1, |i, _| {
        let seen = dot(map.numerators.row(i), state.mean_numerators.entries());
        let seen = if factor.is_one() { seen } else { seen * &factor };
        let constant = &constant.numerators[(i, 0)];
        if constant.is_zero() { seen } else { seen - constant * &unit }
    })
}

/// Systems have many zeros, which cost nothing here.
fn dot(left: &[BigInt], right: &[BigInt]) -> BigInt {
    let pairs = left.iter().zip(right).filter(|(a, b)| !a.is_zero() && !b.is_zero());
    pairs.map(|(a, b)| a * b).reduce(|sum, term| sum + term).unwrap_or_else(BigInt::zero)
}
