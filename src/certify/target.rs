//! The state after a step, enclosed.
//!
//! For any gain K̃, with `G = A − K̃H`, `ρ = K̃Σ̃ − Γ̃` and `J = G P̃ Gᵀ + [I −K̃] M [I −K̃]ᵀ` (the form of Joseph) at P̃ (EK-L1):
//!
//! > `φ(P) = J + G (P − P̃) Gᵀ − Δ`, `0 ≤ Δ ≤ (2/κ) (ρTᵀTρᵀ + w GWGᵀ)`
//!
//! since φ(P) is the least of all such forms at P, and Δ = (K̃ − K) Σ (K̃ − K)ᵀ (EK-L3). Hence (EK-T1)
//!
//! > `−W₊ ≤ φ(P) − J ≤ W₊ = (1 + 2w/κ) GWGᵀ + (2/κ) ρTᵀTρᵀ`
//!
//! The mean (EK-T2): x̂₊ − (A x̃ + b + K̃ν̃) = G e + (K − K̃)ν with e = x̂ − x̃, and the last term is a part in ρ and a part in GWGᵀ, each
//! at most τ² times what bounds Δ.

use num_bigint::BigInt;
use num_traits::One;

use super::enclosed::{Enclosed, Proof, ellipsoid_of, rounded_mean};
use super::grid::{BOUND_BITS, scale};
use super::innovation::Innovation;
use super::law::{Data, Input, Law, Target};
use super::packed::Packed;
use super::upper::BOUND;
use crate::scalar::{Dyadic, Toward, ratio};

/// Bits of W and E.
const GAP_BITS: u64 = 40;

/// Bits of the gain beyond those of the state: its defect enters the mean linearly.
const GUARD: u64 = 16;

/// A, as integers over e.
pub(super) struct Map<'l> {
    /// Nothing for the identity.
    pub(super) matrix: Option<&'l Packed>,
    pub(super) odd: &'l BigInt,
}

impl Map<'_> {
    pub(super) fn times(&self, right: &Packed) -> Packed {
        self.matrix.map_or_else(|| right.scaled(self.odd), |matrix| matrix.times(right))
    }

    pub(super) fn congruence(&self, middle: &Packed) -> Packed {
        self.matrix.map_or_else(|| middle.scaled(&(self.odd * self.odd)), |matrix| matrix.congruence(middle))
    }

    pub(super) fn less(&self, other: &Packed) -> Packed {
        match self.matrix {
            Some(matrix) => matrix.minus(other),
            None => Packed::identity(other.rows()).scaled(self.odd).minus(other),
        }
    }
}

/// `A P̃ Aᵀ + Q` of a target, over w.
pub(super) fn prior(belief: &Enclosed, law: &Law, target: &Target) -> Packed {
    let a = Map { matrix: target.map.as_ref(), odd: &law.odd };
    a.congruence(&belief.covariance).scaled(&law.lift).plus(&target.noise)
}

/// The law of a target given the reading, from its prior.
pub(super) fn updated(
    belief: &Enclosed,
    law: &Law,
    data: &Data,
    (target, prior): (&Target, &Packed),
    innovation: &Innovation,
    bits: u64,
) -> Enclosed {
    let a = Map { matrix: target.map.as_ref(), odd: &law.odd };
    // Γ̃ = A P̃ Hᵀ + S, over w.
    let gamma = a.times(&innovation.seen_covariance).scaled(&law.lift).plus(&target.cross);
    let gain = gain(&gamma, prior, innovation, &law.noise_odd, bits);
    let defect = gain.times(&innovation.covariance).minus(&gamma);
    // A P̃ Aᵀ + Q − Γ̃K̃ᵀ − K̃Γ̃ᵀ + K̃Σ̃K̃ᵀ
    let joseph = prior.with_products((&gain, &defect), (&gamma, &gain));
    let closed = a.less(&gain.times(&law.observation));
    let kept = closed.congruence(&belief.gap);
    let missed = defect.times_transposed(&innovation.whitening).square();
    let two = BOUND.of(&ratio(2, 1));
    let second = BOUND.product(&two, &innovation.inverse_kappa);
    let first = BOUND.sum(&Dyadic::one(), &BOUND.product(&second, &innovation.spread));
    let gap =
        kept.multiple(&BOUND.over(&first, &law.odd, 2)).plus(&missed.multiple(&BOUND.over(&second, &law.noise_odd, 2)));
    let scales = Enclosed::scales(&over_each(joseph.diagonal(), &law.noise_odd), &gap.diagonal());
    let (covariance, pad) = joseph.rounded(&law.noise_odd, &scales, bits);
    // The mean, over o.
    let moved = a.times(&belief.mean).scaled(&data.lift).plus(&gain.times(&innovation.value));
    let moved = with_input(moved, target, data);
    let (mean, errors) = rounded_mean(&moved, &data.odd, &scales, bits);
    let three = BOUND.product(&BOUND.of(&ratio(3, 1)), &BOUND.product(&innovation.square, &innovation.inverse_kappa));
    let local = kept
        .multiple(&BOUND.over(&BOUND.product(&three, &innovation.spread), &law.odd, 2))
        .plus(&missed.multiple(&BOUND.over(&three, &law.noise_odd, 2)))
        .plus(&ellipsoid_of(&errors).multiple(&BOUND.of(&ratio(3, 1))));
    let carried = closed.congruence(&belief.ellipsoid).multiple(&BOUND.over(&Dyadic::one(), &law.odd, 2));
    let (ellipsoid, balance) = joined(&carried, &local, &scales);
    let proof = Proof { gain: Some(gain), balance };
    Enclosed { covariance, gap: gap.up(&pad, GAP_BITS), mean, ellipsoid, proof }
}

/// The law of a target without a reading, from its prior.
pub(super) fn moved(
    belief: &Enclosed,
    law: &Law,
    data: &Data,
    (target, exact): (&Target, &Packed),
    bits: u64,
) -> Enclosed {
    let a = Map { matrix: target.map.as_ref(), odd: &law.odd };
    let square = BOUND.over(&Dyadic::one(), &law.odd, 2);
    let gap = a.congruence(&belief.gap).multiple(&square);
    let scales = Enclosed::scales(&over_each(exact.diagonal(), &law.noise_odd), &gap.diagonal());
    let (covariance, pad) = exact.rounded(&law.noise_odd, &scales, bits);
    let moved = with_input(a.times(&belief.mean).scaled(&data.lift), target, data);
    let (mean, errors) = rounded_mean(&moved, &data.odd, &scales, bits);
    let carried = a.congruence(&belief.ellipsoid).multiple(&square);
    let (ellipsoid, balance) = joined(&carried, &ellipsoid_of(&errors), &scales);
    let proof = Proof { gain: None, balance };
    Enclosed { covariance, gap: gap.up(&pad, GAP_BITS), mean, ellipsoid, proof }
}

fn with_input(mean: Packed, target: &Target, data: &Data) -> Packed {
    match &data.input {
        Some(input) if target.input == Input::Transition => mean.plus(input),
        _ => mean,
    }
}

/// K̃ ≈ Γ̃Σ̃⁻¹ ≈ Γ̃TᵀT, each entry to so many bits of what a deviation of its reading does to its state. Any gain would do.
pub(super) fn gain(gamma: &Packed, prior: &Packed, innovation: &Innovation, odd: &BigInt, bits: u64) -> Packed {
    let t = &innovation.whitening;
    let exact = gamma.times_transposed(t).times(t);
    let rows: Vec<i64> = over_each(prior.diagonal(), odd).iter().map(|v| scale(v).unwrap_or(0)).collect();
    // T has the unit of the reciprocal deviation of its column.
    let columns: Vec<i64> =
        (0..t.rows()).map(|j| (0..t.rows()).filter_map(|i| t.entry(i, j).magnitude()).max().unwrap_or(0)).collect();
    let kept = i64::try_from(bits + GUARD).unwrap_or(i64::MAX);
    let (row, column) = (rows.iter().min().unwrap_or(&0), columns.iter().min().unwrap_or(&0));
    let least = row + column - kept;
    exact.to_units(odd, (least, |i, j| rows[i] + columns[j] - kept), false, |_, _, _| ())
}

fn over_each(entries: Vec<Dyadic>, odd: &BigInt) -> Vec<Dyadic> {
    if odd.is_one() { entries } else { entries.iter().map(|entry| BOUND.over(entry, odd, 1)).collect() }
}

/// `(a + b)(a + b)ᵀ ≤ (1 + α) E₁ + (1 + 1/α) E₂`, with an α near the best in the units of the coordinates; and k of
/// α = 2⁻ᵏ.
fn joined(carried: &Packed, local: &Packed, scales: &[Option<i64>]) -> (Packed, Option<i64>) {
    let nothing = vec![Dyadic::zero(); carried.rows()];
    if carried.is_zero() || local.is_zero() {
        return (if carried.is_zero() { local } else { carried }.up(&nothing, GAP_BITS), None);
    }
    let size = |matrix: &Packed| {
        let entry = |(i, entry): (usize, Dyadic)| {
            entry.times(&Dyadic::new(BigInt::one(), -2 * scales[i].unwrap_or(0)), BOUND_BITS, Toward::Above)
        };
        let total = matrix.diagonal().into_iter().enumerate().map(entry);
        total.fold(Dyadic::zero(), |total, entry| BOUND.sum(&total, &entry)).magnitude().unwrap_or(0)
    };
    // α = 2^−k
    let k = ((size(carried) - size(local)) / 2).clamp(-64, 64);
    let alpha = Dyadic::new(BigInt::one(), -k);
    let inverse = Dyadic::new(BigInt::one(), k);
    let factor = |more: &Dyadic| BOUND.sum(&Dyadic::one(), more);
    let total = carried.multiple(&factor(&alpha)).plus(&local.multiple(&factor(&inverse)));
    (total.up(&nothing, GAP_BITS), Some(k))
}
