//! What a reading says, enclosed: the covariance of the innovation is regular, and how far from what was computed.

use num_bigint::BigInt;
use num_traits::One;

use super::Undecided;
use super::enclosed::{Enclosed, column};
use super::grid::BOUND_BITS;
use super::law::{Data, Law};
use super::packed::Packed;
use super::upper::BOUND;
use super::whitening::whitening;
use crate::matrix::Matrix;
use crate::scalar::{Dyadic, Interval, Toward, ratio};

/// Σ̃ = H P̃ Hᵀ + R and a T with T Σ̃ Tᵀ ≈ I.
///
/// EK-L7: with `η ≥ ‖TΣ̃Tᵀ − I‖∞`, `w ≥ tr(T H W Hᵀ Tᵀ)` and κ = 1 − η − w > 0 every P with −W ≤ P − P̃ ≤ W has
/// T Σ Tᵀ ≥ κ I, so Σ is regular and Σ⁻¹ ≤ TᵀT/κ.
#[derive(Clone, Debug)]
pub(super) struct Innovation {
    /// P̃ Hᵀ, over e.
    pub(super) seen_covariance: Packed,
    /// Σ̃, over w = e² l.
    pub(super) covariance: Packed,
    /// T
    pub(super) whitening: Packed,
    /// 1/κ, or more.
    pub(super) inverse_kappa: Dyadic,
    /// w
    pub(super) spread: Dyadic,
    /// ν̃ = y − c − H x̃, over o.
    pub(super) value: Packed,
    /// τ² ≥ νᵀ Σ⁻¹ ν for every P and x̂ that are enclosed.
    pub(super) square: Dyadic,
}

/// `2⁻¹⁰`: (a + b)² ≤ (1 + 2⁻¹⁰) a² + (1 + 2¹⁰) b².
const SLIGHT: u32 = 10;

impl Innovation {
    /// The innovation of a belief under a law.
    ///
    /// # Errors
    ///
    /// [`Undecided`] unless κ ≥ 1/4: Σ is singular, or too near to it for so many bits.
    pub(super) fn of(belief: &Enclosed, law: &Law, data: &Data, bits: u64) -> Result<Self, Undecided> {
        let h = &law.observation;
        let seen_covariance = belief.covariance.times_transposed(h);
        let covariance = h.times(&seen_covariance).scaled(&law.lift).plus(&law.noise);
        let t = Packed::from(&whitening(&covariance.dyadics(), &law.noise_odd, bits).ok_or(Undecided)?);
        let eta = BOUND.over(&excess(&t.congruence(&covariance), &law.noise_odd).largest_row_sum(), &law.noise_odd, 1);
        let through = t.times(h);
        let spread =
            BOUND.over(&through.congruence(&belief.gap).trace(), &law.odd, 2).shortened(BOUND_BITS, Toward::Above);
        let kappa = Dyadic::one().plus(&BOUND.sum(&eta, &spread).negated(), BOUND_BITS, Toward::Below);
        if kappa < BOUND.of(&ratio(1, 4)) {
            return Err(Undecided);
        }
        let inverse_kappa = Dyadic::one().over(&kappa, BOUND_BITS, Toward::Above).ok_or(Undecided)?;
        let value = data.seen.minus(&h.times(&belief.mean).scaled(&data.lift));
        let known = BOUND.over(&t.times(&value).squared_norm(), &data.odd, 2);
        let unknown = BOUND.over(&through.congruence(&belief.ellipsoid).trace(), &law.odd, 2);
        let slight = ratio(1, 1 << SLIGHT);
        let square = BOUND.sum(
            &BOUND.product(&known, &BOUND.of(&(ratio(1, 1) + &slight))),
            &BOUND.product(&unknown, &BOUND.of(&(ratio(1, 1) + slight.recip()))),
        );
        let square = BOUND.product(&square, &inverse_kappa);
        Ok(Self { seen_covariance, covariance, whitening: t, inverse_kappa, spread, value, square })
    }

    /// Each entry of Σ: `−HWHᵀ ≤ Σ − Σ̃ ≤ HWHᵀ`.
    pub(super) fn covariance_intervals(&self, belief: &Enclosed, law: &Law, bits: u64) -> Matrix<Interval> {
        let gap = law.observation.congruence(&belief.gap).scaled(&law.lift);
        let entries = self.covariance.within(&gap, bits);
        if law.noise_odd.is_one() {
            return entries;
        }
        let odd = Interval::between(whole(&law.noise_odd), whole(&law.noise_odd));
        let entry = |entry: &Interval| entry.over(&odd, bits + BOUND_BITS).unwrap_or_else(|_| unreachable!("odd"));
        entries.map(entry)
    }

    /// Each entry of ν: `|νⱼ − ν̃ⱼ| ≤ √(HEHᵀ)ⱼⱼ`.
    pub(super) fn value_intervals(&self, belief: &Enclosed, law: &Law, data: &Data, bits: u64) -> Matrix<Interval> {
        let unknown = law.observation.congruence(&belief.ellipsoid);
        let unknown = if law.odd.is_one() {
            unknown
        } else {
            let entries: Vec<Dyadic> = unknown.diagonal().iter().map(|entry| BOUND.over(entry, &law.odd, 2)).collect();
            super::enclosed::diagonal(&entries)
        };
        column(&self.value, &data.odd, &unknown, bits)
    }
}

/// All numbers within a radius of `middle / divisor`.
pub(super) fn about(middle: &Dyadic, divisor: &BigInt, radius: &Dyadic, bits: u64) -> Interval {
    let (divisor, bits) = (whole(divisor), bits + BOUND_BITS);
    let end = |toward| middle.over(&divisor, bits, toward).unwrap_or_else(Dyadic::zero);
    Interval::between(
        end(Toward::Below).plus(&radius.negated(), bits, Toward::Below),
        end(Toward::Above).plus(radius, bits, Toward::Above),
    )
}

fn whole(integer: &BigInt) -> Dyadic {
    Dyadic::new(integer.clone(), 0)
}

/// A symmetric matrix less d I.
fn excess(matrix: &Packed, d: &BigInt) -> Packed {
    matrix.minus(&Packed::identity(matrix.rows()).scaled(d))
}
