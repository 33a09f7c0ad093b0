//! What the characteristic polynomial of a rational matrix tells, as long as it is short enough to be written down.

use num_bigint::BigInt;

use super::disc;
use super::polynomial::Polynomial;
use crate::matrix::{Fractions, Matrix};
use crate::scalar::{Rational, Scalar};

/// The work on one polynomial, in products of words: about a second.
const WORK: u64 = 200_000_000;

/// Above this order the intervals decide alone.
const EXACT_ORDER: usize = 12;

/// `det(z I − Λ)`, if that is not too long.
pub(super) fn characteristic_polynomial(map: &Matrix<Rational>) -> Option<Polynomial<Rational>> {
    let Fractions { numerators, denominator } = Fractions::of(map);
    let order = u64::try_from(map.rows()).ok()?;
    let bits = numerators.entries().iter().map(BigInt::bits).max().unwrap_or(0);
    let words = order.checked_mul(bits.checked_add(64)?)? / 64 + 1;
    if order.checked_pow(4)?.checked_mul(words)? / 4 > WORK {
        return None;
    }
    // det(z I − N/d) = Σ cᵢ zⁱ / d^(n−i), with cᵢ the coefficients for N.
    let mut power = BigInt::from(1);
    let mut coefficients = Vec::new();
    for coefficient in numerators.characteristic_polynomial().iter().rev() {
        coefficients.push(Rational::new(coefficient.clone(), power.clone()));
        power *= &denominator;
    }
    coefficients.reverse();
    Some(Polynomial::new(coefficients))
}

/// Whether ρ(Λ) ≥ 1; nothing where that would be too much work, or a root is nearer to the circle than can be told.
pub(super) fn is_unstable(map: &Matrix<Rational>) -> Option<bool> {
    let polynomial = characteristic_polynomial(map)?;
    let decided = disc::reaches_circle(&polynomial);
    if decided.is_none() && map.rows() <= EXACT_ORDER {
        return Some(!map.spectral_radius_lt(&Rational::one()));
    }
    decided
}
