//! Rounding in the Loewner order (EK-L6).
//!
//! A symmetric error with `|errᵢⱼ| ≤ cᵢⱼ 2^(sᵢ+sⱼ)` lies between ± diag(2^(2sᵢ) Σⱼ cᵢⱼ), since
//! `|vᵀ err v| ≤ Σᵢⱼ cᵢⱼ (2^(2sᵢ) vᵢ² + 2^(2sⱼ) vⱼ²)/2`. The scales s are those of the coordinates, so units do not matter: in others
//! that differ by powers of two the same bits are kept.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};

use super::dyadics::Dyadics;
use super::packed::Packed;
use crate::scalar::{Dyadic, Toward};

/// Bits of bounds that are single numbers.
pub(super) const BOUND_BITS: u64 = 64;

/// s with 4^(s−1) < v ≤ 4^s or so, for a positive v; zero has none.
pub(super) fn scale(variance: &Dyadic) -> Option<i64> {
    variance.magnitude().map(|magnitude| Integer::div_ceil(&magnitude, &2))
}

/// `mantissa · 2^places / odd`, rounded to the nearest integer, and whether it is one.
pub(super) fn nearest(mantissa: &BigInt, places: i64, odd: &BigInt) -> (BigInt, bool) {
    if mantissa.is_zero() {
        return (BigInt::zero(), true);
    }
    if places >= 0 && odd.is_one() {
        return (mantissa << places, true);
    }
    let (over, under) =
        if places >= 0 { (mantissa << places, odd.clone()) } else { (mantissa.clone(), odd << places.unsigned_abs()) };
    if odd.is_one() {
        // The unit of the shift is a power of two: half of it is added, and what lies below is cut off.
        let shift = places.unsigned_abs();
        let is_exact = over.trailing_zeros().is_some_and(|zeros| zeros >= shift);
        return ((over + (BigInt::one() << (shift - 1))) >> shift, is_exact);
    }
    let (quotient, rest) = (over * 2_u8 + &under).div_mod_floor(&(&under * 2_u8));
    (quotient, rest == under)
}

impl Packed {
    /// A symmetric matrix over an odd integer, each entry rounded to `bits` bits of its scale; and the diagonal that bounds the
    /// error from both sides.
    pub(super) fn rounded(&self, odd: &BigInt, scales: &[Option<i64>], bits: u64) -> (Self, Vec<Dyadic>) {
        let bits = i64::try_from(bits).unwrap_or(i64::MAX);
        let known = scales.iter().copied().flatten();
        let least = known.min().unwrap_or(0);
        // A row without a scale is zero, or exact.
        let of = |i: usize| scales[i].unwrap_or(least);
        let mut inexact = vec![0_u64; self.rows()];
        let count = |i: usize, j: usize, is_exact: bool| {
            if !is_exact {
                inexact[i] += 1;
                inexact[j] += u64::from(i != j);
            }
        };
        let rounded = self.to_units(odd, (2 * least - bits, |i, j| of(i) + of(j) - bits), true, count);
        let pad =
            inexact.iter().enumerate().map(|(i, &count)| Dyadic::new(count.into(), 2 * of(i) - bits - 1)).collect();
        (rounded, pad)
    }

    /// A positive semidefinite matrix of few bits that is not below this one plus a nonnegative diagonal.
    pub(super) fn up(&self, diagonal: &[Dyadic], bits: u64) -> Self {
        let own = self.diagonal();
        let sums = own.iter().zip(diagonal).map(|(entry, more)| entry.plus(more, BOUND_BITS, Toward::Above));
        let scales: Vec<Option<i64>> = sums.map(|sum| scale(&sum)).collect();
        let (rounded, pad) = self.rounded(&BigInt::one(), &scales, bits);
        let total: Vec<Dyadic> =
            pad.iter().zip(diagonal).map(|(pad, more)| pad.plus(more, BOUND_BITS, Toward::Above)).collect();
        rounded.raised(&total, &scales, bits)
    }

    /// The matrix plus a nonnegative diagonal, whose entries are rounded up to the bits of their scales.
    fn raised(&self, diagonal: &[Dyadic], scales: &[Option<i64>], bits: u64) -> Self {
        let bits = i64::try_from(bits).unwrap_or(i64::MAX);
        let more = |(entry, scale): (&Dyadic, &Option<i64>)| {
            let Some(scale) = scale else { return BigInt::zero() };
            let (mantissa, exponent) = entry.parts();
            // Never below the unit of the matrix, so that this does not lengthen it.
            let unit = 2 * scale - bits;
            let up = match exponent - unit {
                places if places >= 0 => mantissa << places,
                places => Integer::div_ceil(mantissa, &(BigInt::one() << places.unsigned_abs())),
            };
            up << (unit - self.exponent())
        };
        self.plus_diagonal(&diagonal.iter().zip(scales).map(more).collect::<Vec<_>>())
    }
}

/// [`Packed::rounded`]
pub(super) fn rounded(matrix: &Dyadics, odd: &BigInt, scales: &[Option<i64>], bits: u64) -> (Dyadics, Vec<Dyadic>) {
    let (rounded, pad) = Packed::from(matrix).rounded(odd, scales, bits);
    (rounded.dyadics(), pad)
}

/// [`Packed::up`]
pub(super) fn up(matrix: &Dyadics, diagonal: &[Dyadic], bits: u64) -> Dyadics {
    Packed::from(matrix).up(diagonal, bits).dyadics()
}
