//! What follows from a proof, entry by entry.

use num_bigint::BigInt;

use super::equation::{Equation, product};
use super::point::{Image, widened};
use super::proof::Proof;
use super::{BOUND_BITS, Dyadics, SteadyState, around, intervals, root};
use crate::matrix::Matrix;
use crate::scalar::{Dyadic, Interval, Toward};

pub(super) struct Results<'a> {
    pub(super) proof: &'a Proof,
    pub(super) equation: &'a Equation,
    pub(super) kept: &'a [usize],
    pub(super) sensors: usize,
    pub(super) bits: u64,
}

impl Results<'_> {
    pub(super) fn state(&self) -> SteadyState {
        let Self { proof, equation, bits, .. } = *self;
        let same = equation.same();
        let filtered = Image::of(&proof.reading, equation, &same, bits);
        let (kept, missed) = filtered.parts(&proof.gap, equation, &proof.inverse_kappa);
        let gap = widened(&kept, &missed, &proof.spread, &proof.inverse_kappa);
        let ahead = &equation.ahead;
        let open = ahead.map.congruence(&proof.reading.point).scaled(&equation.lift).plus(&ahead.noise);
        let open_covariance = self.covariance(&open, &self.image(&ahead.map));
        let before: Vec<Dyadic> = (0..open.rows()).map(|i| open_covariance[(i, i)].lower().clone()).collect();
        let (vanishing, known) = proof.accuracy(&before);
        SteadyState {
            solution: intervals(&proof.reading.point, &proof.gap, bits),
            gain: self.gain(&proof.image),
            innovation_covariance: self.covariance(&proof.reading.covariance, &self.image(&equation.observation)),
            filtered_covariance: self.covariance(&filtered.joseph, &gap),
            filter_gain: self.gain(&filtered),
            open_covariance,
            vanishing,
            rate_squared: proof.rate_squared.clone(),
            digits: known.map(|bits| decimals(bits.unsigned_abs())),
            bits,
            kept: self.kept.to_vec(),
            #[cfg(feature = "judge")]
            evidence: proof.evidence(),
        }
    }

    /// The gap of an image under a map over e.
    fn image(&self, map: &Dyadics) -> Dyadics {
        map.congruence(&self.proof.gap).multiple(&super::equation::over(&Dyadic::one(), &self.equation.odd, 2))
    }

    /// A matrix over w that is known up to a gap.
    fn covariance(&self, matrix: &Dyadics, gap: &Dyadics) -> Matrix<Interval> {
        let diagonal: Vec<Dyadic> =
            gap.diagonal().iter().map(|entry| entry.shortened(BOUND_BITS, Toward::Above)).collect();
        Matrix::from_fn(matrix.rows(), matrix.rows(), |i, j| {
            let square = diagonal[i].times(&diagonal[j], BOUND_BITS, Toward::Above);
            let radius = if i == j { diagonal[i].clone() } else { root(&square) };
            widest(&self.divided(&matrix.entry(i, j)), &radius, self.bits)
        })
    }

    /// `|K − K̃| ≤ √(D̄ᵢᵢ (TᵀT)ⱼⱼ/κ)`, with zeros for sensors that are not used.
    fn gain(&self, image: &Image) -> Matrix<Interval> {
        let missing = self.proof.missing(image, self.equation).diagonal();
        let whitening = self.proof.reading.whitening.transposed().square().diagonal();
        let place = |sensor: usize| self.kept.iter().position(|kept| *kept == sensor);
        Matrix::from_fn(missing.len(), self.sensors, |i, sensor| {
            let Some(j) = place(sensor) else { return Interval::zero() };
            let square = product(&product(&missing[i], &whitening[j]), &self.proof.inverse_kappa);
            around(&image.gain.entry(i, j), &root(&square), self.bits)
        })
    }

    /// A number over w.
    fn divided(&self, entry: &Dyadic) -> Interval {
        let odd = Dyadic::new(BigInt::clone(&self.equation.noise_odd), 0);
        let bits = self.bits + BOUND_BITS;
        let end = |toward| entry.over(&odd, bits, toward).unwrap_or_else(Dyadic::zero);
        Interval::between(end(Toward::Below), end(Toward::Above))
    }
}

fn widest(middle: &Interval, radius: &Dyadic, bits: u64) -> Interval {
    let bits = bits + BOUND_BITS;
    Interval::between(
        middle.lower().plus(&radius.negated(), bits, Toward::Below),
        middle.upper().plus(radius, bits, Toward::Above),
    )
}

/// ⌊bits · log₁₀ 2⌋, or one less.
fn decimals(bits: u64) -> u32 {
    u32::try_from(bits.saturating_mul(30_102) / 100_000).unwrap_or(u32::MAX)
}
