//! What a reading is multiplied by, enclosed: the gain, and the covariance of the state with the reading (EK-D1).
//!
//! With D̄ ≥ (K − K̃) Σ (K − K̃)ᵀ, as `target` bounds it, and Σ⁻¹ ≤ TᵀT/κ,
//!
//! > `|(K − K̃)ᵢⱼ| ≤ √(D̄ᵢᵢ (TᵀT)ⱼⱼ / κ)`,
//!
//! which is the inequality of Cauchy and Schwarz for `K − K̃ = ((K − K̃) Σ^½) Σ^−½`.

use super::enclosed::{Enclosed, root};
use super::grid::BOUND_BITS;
use super::innovation::{Innovation, about};
use super::law::{Law, Target};
use super::packed::Packed;
use super::target::{Map, gain, prior};
use super::upper::BOUND;
use crate::matrix::Matrix;
use crate::scalar::{Interval, ratio};

/// The covariance of a target with a reading, and the gain.
pub(super) struct Weights {
    /// Γ = A P Hᵀ + S
    pub(super) cross_covariance: Matrix<Interval>,
    /// K = Γ Σ⁺
    pub(super) gain: Matrix<Interval>,
}

impl Weights {
    /// Those of a target, for all entries of the reading.
    pub(super) fn of(belief: &Enclosed, law: &Law, target: &Target, innovation: &Innovation, bits: u64) -> Self {
        let a = Map { matrix: target.map.as_ref(), odd: &law.odd };
        let gamma = a.times(&innovation.seen_covariance).scaled(&law.lift).plus(&target.cross);
        let long = bits + BOUND_BITS;
        let gain = enclosed_gain(belief, law, target, innovation, &gamma, bits);
        Self {
            cross_covariance: law.readings.cross(enclosed_cross(belief, law, &a, &gamma, bits), long),
            gain: law.readings.gain(gain, long),
        }
    }
}

/// `|(A (P − P̃) Hᵀ)ᵢⱼ| ≤ √((AWAᵀ)ᵢᵢ (HWHᵀ)ⱼⱼ)`
fn enclosed_cross(belief: &Enclosed, law: &Law, a: &Map<'_>, gamma: &Packed, bits: u64) -> Matrix<Interval> {
    let (rows, columns) = (a.congruence(&belief.gap), law.observation.congruence(&belief.gap));
    Matrix::from_fn(gamma.rows(), columns.rows(), |i, j| {
        let square = BOUND.over(&BOUND.product(&rows.entry(i, i), &columns.entry(j, j)), &law.odd, 4);
        about(&gamma.entry(i, j), &law.noise_odd, &root(&square), bits)
    })
}

fn enclosed_gain(
    belief: &Enclosed,
    law: &Law,
    target: &Target,
    innovation: &Innovation,
    gamma: &Packed,
    bits: u64,
) -> Matrix<Interval> {
    let a = Map { matrix: target.map.as_ref(), odd: &law.odd };
    let proposed = gain(gamma, &prior(belief, law, target), innovation, &law.noise_odd, bits);
    let defect = proposed.times(&innovation.covariance).minus(gamma);
    let missed = defect.times_transposed(&innovation.whitening).square();
    let kept = a.less(&proposed.times(&law.observation)).congruence(&belief.gap);
    let two = BOUND.product(&BOUND.of(&ratio(2, 1)), &innovation.inverse_kappa);
    // (2/κ) (ρTᵀTρᵀ + w GWGᵀ), its diagonal.
    let row = |i: usize| {
        let missed = BOUND.over(&missed.entry(i, i), &law.noise_odd, 2);
        let kept = BOUND.product(&innovation.spread, &BOUND.over(&kept.entry(i, i), &law.odd, 2));
        BOUND.product(&two, &BOUND.sum(&missed, &kept))
    };
    let columns = innovation.whitening.transposed().square();
    let column = |j: usize| BOUND.product(&columns.entry(j, j), &innovation.inverse_kappa);
    Matrix::from_fn(proposed.rows(), columns.rows(), |i, j| {
        about(&proposed.entry(i, j), &num_traits::One::one(), &root(&BOUND.product(&row(i), &column(j))), bits)
    })
}
