//! How well the entries of an enclosed covariance are known.

use super::BOUND_BITS;
use crate::matrix::Matrix;
use crate::scalar::{Dyadic, Interval, Rational, Toward, ratio};

/// How well: a part 2⁻ᵇ of √(pᵢᵢ pⱼⱼ), for the worst coordinate.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Known {
    /// The states whose variances are not told from zero; their unit is another one.
    pub(super) vanishing: Vec<usize>,
    /// b; nothing if all is exact.
    pub(super) bits: Option<u64>,
}

impl Known {
    /// From how far each variance is from zero at least, how far it may be off, and the unit of those that may be zero.
    pub(super) fn of(variances: impl IntoIterator<Item = (Dyadic, Dyadic)>, other: impl Fn(usize) -> Dyadic) -> Self {
        let is_positive = |number: &Dyadic| !number.is_negative() && !number.is_zero();
        let mut known = Self::default();
        for (i, (least, off)) in variances.into_iter().enumerate().filter(|(_, (_, off))| !off.is_zero()) {
            let may_vanish = !is_positive(&least);
            let unit = if may_vanish { other(i) } else { least };
            if may_vanish {
                known.vanishing.push(i);
            }
            let part = off.over(&unit, BOUND_BITS, Toward::Above).filter(|_| is_positive(&unit));
            let bits = part.and_then(|part| part.magnitude()).map_or(0, |size| (-size).max(0).unsigned_abs());
            known.bits = Some(known.bits.map_or(bits, |least| least.min(bits)));
        }
        known
    }

    /// From the intervals of a covariance.
    pub(super) fn of_intervals(covariance: &Matrix<Interval>, other: impl Fn(usize) -> Dyadic) -> Self {
        let half = Dyadic::rounded(&ratio(1, 2), 1, Toward::Above);
        let diagonal = (0..covariance.rows()).map(|i| {
            let (lower, upper) = (covariance[(i, i)].lower(), covariance[(i, i)].upper());
            let width = upper.plus(&lower.negated(), BOUND_BITS, Toward::Above);
            (lower.clone(), width.times(&half, BOUND_BITS, Toward::Above))
        });
        Self::of(diagonal, other)
    }

    /// The same as decimal digits: ⌊b · log₁₀ 2⌋, or one less.
    pub(super) fn digits(&self) -> Option<u32> {
        self.bits.map(|bits| u32::try_from(bits.saturating_mul(30_102) / 100_000).unwrap_or(u32::MAX))
    }
}

/// The states that readings without noise tell: with e = Hᵀk and R k = 0, `(S − S Hᵀ(H S Hᵀ + R)⁻¹H S) e = S Hᵀ(H S Hᵀ + R)⁻¹R k`
/// is zero, whatever S is.
pub(super) fn told(observation: &Matrix<Rational>, noise: &Matrix<Rational>) -> Vec<usize> {
    let span = observation.transpose() * noise.kernel();
    let (n, rank) = (span.rows(), span.rank());
    let unit = |i: usize| Matrix::from_fn(n, 1, |row, _| ratio(i64::from(row == i), 1));
    (0..n).filter(|&i| span.beside(&unit(i)).rank() == rank).collect()
}
