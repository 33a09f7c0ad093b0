//! The step at a point, exactly: Joseph's form at a gain, the closed loop, and the bound of what the gain misses.
//!
//! With κ = 1 − η − w, where `η ≥ ‖TΣ̃Tᵀ − I‖∞` and `w ≥ tr(THEHᵀTᵀ)`, every P with −E ≤ P − S̃ ≤ E has a regular Σ, and
//!
//! > `φ(P) = J + G(P − S̃)Gᵀ − Δ`, `0 ≤ Δ = (K̃ − K)Σ(K̃ − K)ᵀ ≤ D̄ = (2/κ)(ρTᵀTρᵀ + w GEGᵀ)`

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::equation::{Equation, FACTOR, Target};
use super::{BOUND_BITS, Dyadics, nearest, scale, whitening};
use crate::matrix::Matrix;
use crate::scalar::{Dyadic, Toward, ratio};

/// Bits of the gain beyond those of the point: what it misses must not show.
const GUARD: u64 = 16;

/// What is read at a point S̃.
#[derive(Clone, Debug)]
pub(super) struct Reading {
    /// S̃
    pub(super) point: Dyadics,
    /// S̃ Hᵀ, over e.
    seen: Dyadics,
    /// Σ̃, over w.
    pub(super) covariance: Dyadics,
    /// T
    pub(super) whitening: Dyadics,
    /// T H, over e.
    pub(super) through: Dyadics,
    /// η
    eta: Dyadic,
}

impl Reading {
    /// Nothing where no T makes Σ̃ the identity, nearly.
    pub(super) fn at(point: &Dyadics, equation: &Equation, bits: u64) -> Option<Self> {
        let h = &equation.observation;
        let seen = point.times(&h.transposed());
        let covariance = h.times(&seen).scaled(&equation.lift).plus(&equation.noise);
        let whitening = whitening(&covariance, &equation.noise_odd, bits)?;
        let identity = Dyadics { mantissas: Matrix::identity(h.rows()), exponent: 0 }.scaled(&equation.noise_odd);
        let eta = largest_row_sum(&whitening.congruence(&covariance).minus(&identity));
        let eta = FACTOR.over(&eta, &equation.noise_odd, 1).shortened(BOUND_BITS, Toward::Above);
        let through = whitening.times(h);
        Some(Self { point: point.clone(), seen, covariance, whitening, through, eta })
    }

    /// `tr(T H X Hᵀ Tᵀ)`, or a little more.
    pub(super) fn spread(&self, matrix: &Dyadics, equation: &Equation) -> Dyadic {
        FACTOR.over(&self.through.congruence(matrix).trace(), &equation.odd, 2).shortened(BOUND_BITS, Toward::Above)
    }

    /// 1/κ or more, if κ ≥ 1/4.
    pub(super) fn inverse_kappa(&self, spread: &Dyadic) -> Option<Dyadic> {
        let kappa = Dyadic::one().plus(&FACTOR.sum(&self.eta, spread).negated(), BOUND_BITS, Toward::Below);
        if kappa < FACTOR.of(&ratio(1, 4)) {
            return None;
        }
        Dyadic::one().over(&kappa, BOUND_BITS, Toward::Above)
    }
}

/// A target at a point, with a gain.
#[derive(Clone, Debug)]
pub(super) struct Image {
    /// K̃
    pub(super) gain: Dyadics,
    /// J, over w.
    pub(super) joseph: Dyadics,
    /// G = A − K̃H, over e.
    pub(super) closed: Dyadics,
    /// `ρTᵀTρᵀ`, over w².
    pub(super) missed: Dyadics,
}

impl Image {
    pub(super) fn of(reading: &Reading, equation: &Equation, target: &Target, bits: u64) -> Self {
        let gamma = target.map.times(&reading.seen).scaled(&equation.lift).plus(&target.cross);
        let prior = target.map.congruence(&reading.point).scaled(&equation.lift).plus(&target.noise);
        let gain = gain(&gamma, &prior, &reading.whitening, &equation.noise_odd, bits);
        let defect = gain.times(&reading.covariance).minus(&gamma);
        let joseph = prior.minus(&gamma.times(&gain.transposed())).plus(&gain.times(&defect.transposed()));
        let closed = target.map.minus(&gain.times(&equation.observation));
        let missed = defect.times(&reading.whitening.transposed()).square();
        Self { gain, joseph, closed, missed }
    }

    /// G E Gᵀ, and D̄ but for the part of w: what the gap becomes.
    pub(super) fn parts(&self, gap: &Dyadics, equation: &Equation, inverse_kappa: &Dyadic) -> (Dyadics, Dyadics) {
        let second = FACTOR.product(&FACTOR.of(&ratio(2, 1)), inverse_kappa);
        let kept = self.closed.congruence(gap).multiple(&FACTOR.over(&Dyadic::one(), &equation.odd, 2));
        (kept, self.missed.multiple(&FACTOR.over(&second, &equation.noise_odd, 2)))
    }
}

/// `(1 + 2w/κ) GEGᵀ + (2/κ) ρTᵀTρᵀ`
pub(super) fn widened(kept: &Dyadics, missed: &Dyadics, spread: &Dyadic, inverse_kappa: &Dyadic) -> Dyadics {
    let more = FACTOR.product(&FACTOR.product(&FACTOR.of(&ratio(2, 1)), inverse_kappa), spread);
    kept.multiple(&FACTOR.sum(&Dyadic::one(), &more)).plus(missed)
}

/// D̄
pub(super) fn missing(kept: &Dyadics, missed: &Dyadics, spread: &Dyadic, inverse_kappa: &Dyadic) -> Dyadics {
    kept.multiple(&FACTOR.product(&FACTOR.product(&FACTOR.of(&ratio(2, 1)), inverse_kappa), spread)).plus(missed)
}

/// K̃ ≈ Γ̃TᵀT, each entry to so many bits of what a deviation of its reading does to its state.
fn gain(gamma: &Dyadics, prior: &Dyadics, whitening: &Dyadics, odd: &BigInt, bits: u64) -> Dyadics {
    let t = whitening;
    let exact = gamma.times(&t.transposed()).times(t);
    let size = |variance: &Dyadic| if variance.is_negative() { None } else { scale(variance) };
    let rows: Vec<i64> = prior.diagonal().iter().map(|v| size(&FACTOR.over(v, odd, 1)).unwrap_or(0)).collect();
    // T has the unit of the reciprocal deviation of its column.
    let columns: Vec<i64> =
        (0..t.rows()).map(|j| (0..t.rows()).filter_map(|i| t.entry(i, j).magnitude()).max().unwrap_or(0)).collect();
    let kept = i64::try_from(bits + GUARD).unwrap_or(i64::MAX);
    let least = rows.iter().min().unwrap_or(&0) + columns.iter().min().unwrap_or(&0) - kept;
    let mantissas = Matrix::from_fn(exact.rows(), t.rows(), |i, j| {
        let unit = rows[i] + columns[j] - kept;
        nearest(&exact.mantissas[(i, j)], exact.exponent - unit, odd).0 << (unit - least)
    });
    Dyadics { mantissas, exponent: least }
}

/// The largest sum of the magnitudes of a row.
pub(super) fn largest_row_sum(matrix: &Dyadics) -> Dyadic {
    let rows = (0..matrix.rows()).map(|i| matrix.mantissas.row(i));
    let sums = rows.map(|row| row.iter().fold(BigInt::zero(), |sum, entry| sum + entry.abs()));
    Dyadic::new(sums.max().unwrap_or_default(), matrix.exponent)
}

/// A diagonal that bounds a symmetric matrix over an odd integer from both sides: `dᵢ = 2^sᵢ Σⱼ |zᵢⱼ| 2^−sⱼ`.
pub(super) fn diagonal_bound(matrix: &Dyadics, odd: &BigInt, scales: &[i64]) -> Vec<Dyadic> {
    let most = scales.iter().copied().max().unwrap_or(0);
    let row = |i: usize| {
        let terms = matrix.mantissas.row(i).iter().zip(scales).map(|(entry, scale)| entry.abs() << (most - scale));
        let total = terms.fold(BigInt::zero(), |sum, term| sum + term);
        FACTOR
            .over(&Dyadic::new(total, matrix.exponent - most + scales[i]), odd, 1)
            .shortened(BOUND_BITS, Toward::Above)
    };
    (0..matrix.rows()).map(row).collect()
}

/// A symmetric matrix without its rows and columns of zeros.
pub(super) fn without_zero_rows(matrix: &Dyadics) -> Dyadics {
    let filled: Vec<usize> =
        (0..matrix.rows()).filter(|&i| matrix.mantissas.row(i).iter().any(|entry| !entry.is_zero())).collect();
    Dyadics { mantissas: matrix.mantissas.select(&filled, &filled), exponent: matrix.exponent }
}

/// Whether a symmetric matrix is proved positive definite: T times it times Tᵀ is near the identity for some T, of few bits, or
/// of as many as are given.
pub(super) fn is_definite(matrix: &Dyadics, most: u64) -> bool {
    let proves = |bits: u64| whitening(matrix, &BigInt::one(), bits).is_some_and(|t| whitens(&t, matrix));
    [64, 192].into_iter().any(proves) || most > 192 && proves(most)
}

/// Whether T M Tᵀ is so near to the identity that M is positive definite.
pub(super) fn whitens(t: &Dyadics, matrix: &Dyadics) -> bool {
    let identity = Dyadics { mantissas: Matrix::identity(matrix.rows()), exponent: 0 };
    largest_row_sum(&t.congruence(matrix).minus(&identity)) < Dyadic::one()
}
