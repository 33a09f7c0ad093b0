//! Rounding a covariance outwards, so that a bound stays a bound and its entries stay short.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, Zero};

use crate::matrix::Matrix;
use crate::scalar::{Rational, Scalar};

/// Which way a matrix may be moved in the Loewner order.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Direction {
    Down,
    Up,
}

/// A power of two, or no rounding at all.
pub(super) struct Unit(Option<Rational>);

impl Unit {
    /// The unit for bounds that are to be closer than `gap`: a 2⁻³²th of it, so that the roundings of many steps together
    /// stay small beside it. A gap of zero allows none.
    pub(super) fn for_gap(gap: &Rational, order: usize) -> Self {
        if !gap.is_positive() {
            return Self(None);
        }
        let share = gap.times(&Rational::new_raw(BigInt::from(1), BigInt::from(order.max(1)) << 32_u8));
        // share > 2^(bits of the numerator − 1 − bits of the denominator)
        let (numerator, denominator) = (share.numer().bits(), share.denom().bits());
        let power = |bits: u64| Rational::from(BigInt::from(1) << bits);
        Self(Some(match numerator.checked_sub(denominator + 1) {
            Some(above) => power(above),
            None => power(denominator + 1 - numerator).recip(),
        }))
    }

    /// A symmetric matrix of multiples of the unit, below or above the given one.
    ///
    /// Rounding to the nearest multiple moves each of the p² entries by at most half a unit u, symmetric ones alike. So the
    /// change E has |xᵀEx| ≤ (u/2)(Σ|xᵢ|)² ≤ (pu/2)xᵀx, and ±pu on the diagonal outweighs it.
    pub(super) fn outward(&self, matrix: &Matrix<Rational>, direction: Direction) -> Matrix<Rational> {
        let Some(unit) = &self.0 else { return matrix.clone() };
        let nearest = matrix.map(|entry| nearest_multiple(entry, unit));
        if nearest == *matrix {
            return nearest;
        }
        let widening = unit.times(&Rational::from(BigInt::from(matrix.rows())));
        let widening = Matrix::identity(matrix.rows()).scaled(&widening);
        match direction {
            Direction::Down => nearest - widening,
            Direction::Up => nearest + widening,
        }
    }
}

/// The multiple of a positive unit that is nearest; of two, the greater.
fn nearest_multiple(value: &Rational, unit: &Rational) -> Rational {
    if value.is_zero() {
        return value.clone();
    }
    let over = value.numer() * unit.denom();
    let under = value.denom() * unit.numer();
    let count = Integer::div_floor(&((over << 1_u8) + &under), &(under << 1_u8));
    Rational::from(count).times(unit)
}
