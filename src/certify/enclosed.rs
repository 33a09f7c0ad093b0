//! An enclosed belief.

use num_bigint::BigInt;
use num_traits::One;

use super::dyadics::Dyadics;
use super::grid::{BOUND_BITS, scale};
use super::packed::Packed;
use crate::matrix::Matrix;
use crate::scalar::{Dyadic, Interval, Rational, Toward};

/// A belief with mean x̂ and covariance P, of which is known
///
/// > `−W ≤ P − P̃ ≤ W` and `(x̂ − x̃)(x̂ − x̃)ᵀ ≤ E`
///
/// in the order of Loewner. P̃ need not be positive semidefinite, and P need not be regular.
#[derive(Clone, Debug)]
pub(super) struct Enclosed {
    /// P̃
    pub(super) covariance: Packed,
    /// W
    pub(super) gap: Packed,
    /// x̃
    pub(super) mean: Packed,
    /// E
    pub(super) ellipsoid: Packed,
    /// What proves it from the belief before.
    #[cfg_attr(not(feature = "judge"), allow(dead_code, reason = "certificates alone need it"))]
    pub(super) proof: Proof,
}

/// What a checker must be told to prove a belief from the one before.
#[derive(Clone, Debug, Default)]
#[cfg_attr(not(feature = "judge"), allow(dead_code, reason = "certificates alone need it"))]
pub(super) struct Proof {
    /// K̃, where something is read.
    pub(super) gain: Option<Packed>,
    /// k of the α = 2⁻ᵏ with which two errors of the mean were added, if there are two.
    pub(super) balance: Option<i64>,
}

impl Enclosed {
    /// A belief that is known exactly, rounded to so many bits.
    pub(super) fn of(mean: &Matrix<Rational>, covariance: &Matrix<Rational>, bits: u64) -> Self {
        let n = covariance.rows();
        let odd = |matrix: &Matrix<Rational>| super::dyadics::odd_denominator(BigInt::one(), matrix.entries());
        let exact = {
            let odd = odd(covariance);
            (Packed::from(&Dyadics::of(covariance, &odd)), odd)
        };
        let scales: Vec<Option<i64>> =
            (0..n).map(|i| scale(&Dyadic::rounded(&covariance[(i, i)], BOUND_BITS, Toward::Above))).collect();
        let (covariance, pad) = exact.0.rounded(&exact.1, &scales, bits);
        let mean_odd = odd(mean);
        let (mean, errors) = rounded_mean(&Packed::from(&Dyadics::of(mean, &mean_odd)), &mean_odd, &scales, bits);
        Self { covariance, gap: diagonal(&pad), ellipsoid: ellipsoid_of(&errors), mean, proof: Proof::default() }
    }

    /// The variance by which units are chosen: that of P̃, or W where it is none.
    pub(super) fn scales(covariance: &[Dyadic], gap: &[Dyadic]) -> Vec<Option<i64>> {
        let larger = covariance.iter().zip(gap).map(|(variance, gap)| variance.max(gap));
        larger.map(|variance| if variance.is_negative() { None } else { scale(variance) }).collect()
    }

    /// Each entry of the covariance.
    pub(super) fn covariance_intervals(&self, bits: u64) -> Matrix<Interval> {
        self.covariance.within(&self.gap, bits)
    }

    /// Each entry of the mean.
    pub(super) fn mean_intervals(&self, bits: u64) -> Matrix<Interval> {
        column(&self.mean, &BigInt::one(), &self.ellipsoid, bits)
    }
}

impl Packed {
    /// Entries of a symmetric matrix that lies between ± a gap (EK-L5): `|zᵢⱼ| ≤ √(wᵢᵢ wⱼⱼ)`.
    pub(super) fn within(&self, gap: &Self, bits: u64) -> Matrix<Interval> {
        let diagonal = gap.diagonal();
        let roots: Vec<Dyadic> = diagonal.iter().map(root).collect();
        let entry = |i: usize, j: usize| {
            let middle = self.entry(i, j);
            if i == j {
                return around(&middle, &diagonal[i], bits);
            }
            around(&middle, &roots[i].times(&roots[j], BOUND_BITS, Toward::Above), bits)
        };
        let below: Vec<Vec<Interval>> = (0..self.rows()).map(|i| (0..=i).map(|j| entry(i, j)).collect()).collect();
        Matrix::from_fn(self.rows(), self.rows(), |i, j| below[i.max(j)][i.min(j)].clone())
    }
}

/// [`Packed::within`]
pub(super) fn intervals(matrix: &Dyadics, gap: &Dyadics, bits: u64) -> Matrix<Interval> {
    Packed::from(matrix).within(&gap.into(), bits)
}

/// Entries of a vector over an odd integer whose error e has `e eᵀ ≤ E`: `|eᵢ| ≤ √Eᵢᵢ`.
pub(super) fn column(vector: &Packed, odd: &BigInt, ellipsoid: &Packed, bits: u64) -> Matrix<Interval> {
    let divisor = (!odd.is_one()).then(|| Dyadic::new(odd.clone(), 0));
    Matrix::from_fn(vector.rows(), 1, |i, _| {
        let radius = root(&ellipsoid.entry(i, i));
        let middle = vector.entry(i, 0);
        let end = |toward| match &divisor {
            Some(divisor) => middle.over(divisor, bits, toward).unwrap_or_else(Dyadic::zero),
            None => middle.shortened(bits, toward),
        };
        Interval::between(
            end(Toward::Below).plus(&radius.negated(), bits, Toward::Below),
            end(Toward::Above).plus(&radius, bits, Toward::Above),
        )
    })
}

/// What is at most so far from a number.
pub(super) fn around(middle: &Dyadic, radius: &Dyadic, bits: u64) -> Interval {
    let bits = bits + BOUND_BITS;
    Interval::between(middle.plus(&radius.negated(), bits, Toward::Below), middle.plus(radius, bits, Toward::Above))
}

/// An upper bound of the root of a nonnegative number.
pub(super) fn root(square: &Dyadic) -> Dyadic {
    let square = square.shortened(2 * BOUND_BITS - 2, Toward::Above);
    let (mantissa, exponent) = square.parts();
    let short = u128::try_from(mantissa).unwrap_or_default();
    if short == 0 {
        return Dyadic::zero();
    }
    // An even exponent, and as many bits as there is room for.
    let shift = i64::from(short.leading_zeros());
    let shift = shift - (exponent - shift).rem_euclid(2);
    let lifted = short << shift;
    let root = lifted.isqrt();
    let root = root + u128::from(root * root != lifted);
    Dyadic::new(root.into(), (exponent - shift) / 2)
}

/// A diagonal matrix.
pub(super) fn diagonal(entries: &[Dyadic]) -> Packed {
    let least = entries.iter().filter(|entry| !entry.is_zero()).map(|entry| entry.parts().1).min().unwrap_or(0);
    let mantissa = |entry: &Dyadic| {
        let (mantissa, exponent) = entry.parts();
        mantissa << (exponent - least).max(0)
    };
    let mantissas = Matrix::diagonal(&entries.iter().map(mantissa).collect::<Vec<_>>());
    Packed::from(&Dyadics { mantissas, exponent: least }).symmetric()
}

/// A vector over an odd integer rounded to `bits` bits of the larger of its entries and of the scales; and how far each entry
/// may have moved.
pub(super) fn rounded_mean(exact: &Packed, odd: &BigInt, scales: &[Option<i64>], bits: u64) -> (Packed, Vec<Dyadic>) {
    let bits = i64::try_from(bits).unwrap_or(i64::MAX);
    let units: Vec<i64> = scales
        .iter()
        .enumerate()
        .map(|(i, scale)| {
            let length = |bits: u64| i64::try_from(bits).unwrap_or(i64::MAX);
            let own = Some(length(exact.integer(i, 0).bits())).filter(|&size| size > 0);
            let own = own.map(|size| size + exact.exponent() - length(odd.bits()));
            scale.or(own).unwrap_or(0) - bits
        })
        .collect();
    let least = units.iter().copied().min().unwrap_or(0);
    let mut errors = Vec::with_capacity(units.len());
    let mean = exact.to_units(odd, (least, |i, _| units[i]), false, |i, _, is_exact| {
        errors.push(if is_exact { Dyadic::zero() } else { Dyadic::new(BigInt::one(), units[i] - 1) });
    });
    (mean, errors)
}

/// E with `e eᵀ ≤ E` for all e whose entries are bounded: `(Σ vᵢ eᵢ)² ≤ n Σ vᵢ² eᵢ²`, n the number of those that are not zero.
pub(super) fn ellipsoid_of(errors: &[Dyadic]) -> Packed {
    let count = errors.iter().filter(|error| !error.is_zero()).count();
    let count = Dyadic::new(count.into(), 0);
    let square =
        |error: &Dyadic| error.times(error, BOUND_BITS, Toward::Above).times(&count, BOUND_BITS, Toward::Above);
    diagonal(&errors.iter().map(square).collect::<Vec<_>>())
}
