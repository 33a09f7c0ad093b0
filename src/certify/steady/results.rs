//! What follows from a proof, entry by entry.

use num_bigint::BigInt;

use super::equation::{Equation, FACTOR};
use super::known::Known;
use super::point::{Image, widened};
use super::proof::Proof;
use super::{BOUND_BITS, Dyadics, SteadyState, around, intervals, root};
use crate::matrix::Matrix;
use crate::scalar::{Dyadic, Interval, Toward};

pub(super) struct Results<'a> {
    pub(super) proof: &'a Proof,
    pub(super) equation: &'a Equation,
    pub(super) kept: &'a [usize],
    /// States whose filtered variances are known to be zero.
    pub(super) told: &'a [usize],
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
        let known = proof.known(|i| open_covariance[(i, i)].lower().clone());
        let innovation_covariance = self.covariance(&proof.reading.covariance, &self.image(&equation.observation));
        let solution = intervals(&proof.reading.point, &proof.gap, bits);
        let mut filtered_covariance = self.covariance(&filtered.joseph, &gap);
        for &state in self.told {
            for other in 0..filtered_covariance.rows() {
                filtered_covariance[(state, other)] = Interval::zero();
                filtered_covariance[(other, state)] = Interval::zero();
            }
        }
        let filtered_known = Known::of_intervals(&filtered_covariance, |i| solution[(i, i)].lower().clone());
        let open_known = Known::of_intervals(&open_covariance, |_| Dyadic::zero());
        let innovation_known = Known::of_intervals(&innovation_covariance, |_| Dyadic::zero());
        let digits = [&known, &innovation_known].into_iter().filter_map(Known::digits).min();
        SteadyState {
            solution,
            gain: self.gain(&proof.image),
            innovation_covariance,
            filtered_covariance,
            filter_gain: self.gain(&filtered),
            open_covariance,
            rate_squared: proof.rate_squared.clone(),
            digits,
            vanishing: known.vanishing,
            open_digits: open_known.digits(),
            open_vanishing: open_known.vanishing,
            filtered_digits: filtered_known.digits(),
            filtered_vanishing: filtered_known.vanishing,
            bits,
            kept: self.kept.to_vec(),
            #[cfg(feature = "judge")]
            evidence: proof.evidence((self.kept.len() < self.sensors).then_some(self.kept)),
        }
    }

    /// The gap of an image under a map over e.
    fn image(&self, map: &Dyadics) -> Dyadics {
        map.congruence(&self.proof.gap).multiple(&FACTOR.over(&Dyadic::one(), &self.equation.odd, 2))
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
            let square = FACTOR.product(&FACTOR.product(&missing[i], &whitening[j]), &self.proof.inverse_kappa);
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
