//! What a reading says for the model, enclosed: νᵀΣ⁻¹ν, det Σ, and the logarithm of the density (EK-D2, EK-D3).
//!
//! For any z, with r = ν̃ − Σ̃z and μ = 2zᵀν̃ − zᵀΣ̃z, completing the square gives
//! `νᵀΣ⁻¹ν = 2zᵀν − zᵀΣz + (ν − Σz)ᵀ Σ⁻¹ (ν − Σz)`, and so, with `l = 2√(zᵀHEHᵀz) + zᵀHWHᵀz`,
//!
//! > `μ − l ≤ νᵀΣ⁻¹ν ≤ μ + l + (‖Tr‖ + √tr(THEHᵀTᵀ) + √(w zᵀHWHᵀz))² / κ`.
//!
//! The eigenvalues λ of `Σ̃^−½ (Σ − Σ̃) Σ̃^−½` have `Σ|λ| ≤ ϑ = w/(1 − η)`, so `|ln det Σ − ln det Σ̃| ≤ ϑ/(1 − ϑ) = w/κ`.

use num_bigint::BigInt;
use num_traits::One;

use super::enclosed::{Enclosed, root};
use super::grid::BOUND_BITS;
use super::innovation::{Innovation, about};
use super::law::{Data, Law};
use super::packed::Packed;
use super::upper::BOUND;
use crate::scalar::{Dyadic, Interval, Logarithms, Rational, Toward, ratio};

/// The parts of the log likelihood of a reading, `−½ (quadratic + ln pseudo_determinant + rank · ln 2π)`, each in its interval.
#[derive(Clone, Debug)]
pub struct EnclosedLikelihood {
    /// νᵀS⁺ν
    pub quadratic: Interval,
    /// The product of the nonzero eigenvalues of S.
    pub pseudo_determinant: Interval,
    /// Its logarithm, known better.
    pub log_pseudo_determinant: Interval,
    /// The log likelihood; nothing where S is singular.
    pub log_likelihood: Option<Interval>,
    /// The sum of the log likelihoods from the step with which the filter began to this one; nothing once one is missing.
    pub sum: Option<Interval>,
}

/// Likelihoods to a number of bits; what all of them need is computed once.
#[derive(Debug)]
pub(super) struct Likelihoods {
    logarithms: Logarithms,
    of_two: Interval,
    of_two_pi: Interval,
    sum: Option<Interval>,
    bits: u64,
}

impl Likelihoods {
    /// Nothing where logarithms have no value, which does not happen.
    pub(super) fn new(bits: u64) -> Option<Self> {
        let long = bits + BOUND_BITS;
        let logarithms = Logarithms::new(long);
        let of_two = logarithms.of(&ratio(2, 1)).ok()?;
        let pi = Interval::pi(long);
        let sum = Some(Interval::zero());
        let unfinished = Self { logarithms, of_two_pi: of_two.clone(), of_two, sum, bits: long };
        let of_pi = unfinished.logarithm(pi.lower())?.joined(&unfinished.logarithm(pi.upper())?);
        Some(Self { of_two_pi: of_pi.plus(&unfinished.of_two, long), ..unfinished })
    }

    /// Those of a reading with entries that were used; nothing where a determinant lies beyond all numbers.
    pub(super) fn of(
        &mut self,
        belief: &Enclosed,
        law: &Law,
        data: &Data,
        innovation: &Innovation,
    ) -> Option<EnclosedLikelihood> {
        let parts = self.parts(belief, law, data, innovation);
        self.add(parts.as_ref().and_then(|parts| parts.log_likelihood.as_ref()));
        parts.map(|parts| EnclosedLikelihood { sum: self.sum.clone(), ..parts })
    }

    fn parts(&self, belief: &Enclosed, law: &Law, data: &Data, innovation: &Innovation) -> Option<EnclosedLikelihood> {
        let quadratic = quadratic(belief, law, data, innovation, self.bits);
        let determinant = determinant(law, innovation, self.bits)?;
        // w/κ
        let radius = BOUND.product(&innovation.spread, &innovation.inverse_kappa);
        let ends = [determinant.lower(), determinant.upper()].map(|end| self.logarithm(end));
        let [Some(lower), Some(upper)] = ends else { return None };
        let mut log = widened(&lower.joined(&upper), &radius, self.bits);
        let mut pseudo = multiplied(&determinant, &radius, self.bits);
        if let Some(more) = law.readings.determinant() {
            log = log.plus(&self.logarithms.of(&more).ok()?, self.bits);
            pseudo = pseudo.times(&Interval::of(&more, self.bits), self.bits);
        }
        let is_regular = law.readings.determinant().is_none();
        let count = Interval::of(&ratio(i64::try_from(innovation.covariance.rows()).ok()?, 1), self.bits);
        let constant = self.of_two_pi.times(&count, self.bits);
        let twice = quadratic.plus(&log, self.bits).plus(&constant, self.bits);
        let minus_half = Interval::of(&ratio(-1, 2), 1);
        let log_likelihood = is_regular.then(|| twice.times(&minus_half, self.bits));
        Some(EnclosedLikelihood {
            quadratic,
            pseudo_determinant: pseudo,
            log_pseudo_determinant: log,
            log_likelihood,
            sum: None,
        })
    }

    /// Those of a step of whose reading no entry is used; where none is read at all the likelihood is one.
    pub(super) fn of_nothing(&mut self, is_read: bool) -> EnclosedLikelihood {
        let log_likelihood = (!is_read).then(Interval::zero);
        self.add(log_likelihood.as_ref());
        let one = Interval::of(&ratio(1, 1), 1);
        EnclosedLikelihood {
            quadratic: Interval::zero(),
            pseudo_determinant: one,
            log_pseudo_determinant: Interval::zero(),
            log_likelihood,
            sum: self.sum.clone(),
        }
    }

    fn add(&mut self, term: Option<&Interval>) {
        self.sum = self.sum.take().zip(term).map(|(sum, term)| sum.plus(term, self.bits + BOUND_BITS));
    }

    /// ln x of a positive number of any size: x = m 2^k with 1/2 ≤ m < 1.
    fn logarithm(&self, x: &Dyadic) -> Option<Interval> {
        let (mantissa, exponent) = x.parts();
        let length = mantissa.bits();
        let places = exponent.checked_add(i64::try_from(length).ok()?)?;
        let fraction = self.logarithms.of(&Rational::new(mantissa.clone(), BigInt::one() << length)).ok()?;
        let whole = Interval::of(&Rational::from(BigInt::from(places)), 64);
        Some(fraction.plus(&self.of_two.times(&whole, self.bits), self.bits))
    }
}

/// det Σ̃
fn determinant(law: &Law, innovation: &Innovation, bits: u64) -> Option<Interval> {
    let matrix = &innovation.covariance;
    let m = matrix.rows();
    let whole = matrix.dyadics().mantissas.determinant().ok()?;
    let exponent = matrix.exponent().checked_mul(i64::try_from(m).ok()?)?;
    let divisor = law.noise_odd.pow(u32::try_from(m).ok()?);
    let whole = Dyadic::new(whole, 0);
    let power = Dyadic::new(One::one(), exponent);
    let quotient = about(&whole, &divisor, &Dyadic::zero(), bits);
    let end = |end: &Dyadic, toward| end.times(&power, bits + BOUND_BITS, toward);
    let ends = (end(quotient.lower(), Toward::Below), end(quotient.upper(), Toward::Above));
    // It is positive: T Σ̃ Tᵀ is near the identity.
    (!ends.0.is_negative() && !ends.0.is_zero()).then(|| Interval::between(ends.0, ends.1))
}

/// All numbers between `x e^−d` and `x eᵈ` for positive x, and more: `1 − d ≤ e^−d`, and `eᵈ ≤ 1/(1 − d)` or `4^⌈d⌉`.
fn multiplied(x: &Interval, d: &Dyadic, bits: u64) -> Interval {
    let (one, zero) = (Dyadic::one(), Dyadic::zero());
    let less = one.plus(&d.negated(), bits, Toward::Below).max(zero);
    let half = Dyadic::new(One::one(), -1);
    let more = if less > half {
        one.over(&less, bits, Toward::Above).unwrap_or(one)
    } else {
        // κ ≥ 1/4 and w ≤ 3/4, so d ≤ 3; of a larger one the exponent would follow.
        let size = d.magnitude().unwrap_or(0).clamp(0, 61);
        Dyadic::new(One::one(), 2 << size)
    };
    Interval::between(x.lower().times(&less, bits, Toward::Below), x.upper().times(&more, bits, Toward::Above))
}

fn widened(x: &Interval, radius: &Dyadic, bits: u64) -> Interval {
    Interval::between(
        x.lower().plus(&radius.negated(), bits, Toward::Below),
        x.upper().plus(radius, bits, Toward::Above),
    )
}

/// νᵀΣ⁻¹ν
fn quadratic(belief: &Enclosed, law: &Law, data: &Data, innovation: &Innovation, bits: u64) -> Interval {
    let (t, h, value) = (&innovation.whitening, &law.observation, &innovation.value);
    // z = TᵀTν̃, over o, and 2zᵀν̃ − zᵀΣ̃z over w o².
    let z = t.transposed().times(&t.times(value));
    let row = z.transposed();
    let two = &law.noise_odd * 2_u8;
    let middle = row.times(value).scaled(&two).minus(&row.congruence(&innovation.covariance)).entry(0, 0);
    let divisor = &law.noise_odd * &data.odd * &data.odd;
    let rest = value.scaled(&law.noise_odd).minus(&innovation.covariance.times(&z));
    let rest = BOUND.over(&BOUND.over(&t.times(&rest).squared_norm(), &law.noise_odd, 2), &data.odd, 2);
    let through = row.times(h);
    let along =
        |matrix: &Packed| BOUND.over(&BOUND.over(&through.congruence(matrix).entry(0, 0), &law.odd, 2), &data.odd, 2);
    let (of_gap, of_mean) = (along(&belief.gap), along(&belief.ellipsoid));
    let unknown = BOUND.over(&t.times(h).congruence(&belief.ellipsoid).trace(), &law.odd, 2);
    let root_of = |square: &Dyadic| if square.is_zero() { Dyadic::zero() } else { root(square) };
    let below = BOUND.sum(&BOUND.product(&BOUND.of(&ratio(2, 1)), &root_of(&of_mean)), &of_gap);
    let parts = [&rest, &unknown, &BOUND.product(&innovation.spread, &of_gap)];
    let norm = parts.into_iter().fold(Dyadic::zero(), |norm, part| BOUND.sum(&norm, &root_of(part)));
    let beyond = BOUND.product(&BOUND.product(&norm, &norm), &innovation.inverse_kappa);
    let around = about(&middle, &divisor, &below, bits);
    let lower = around.lower().clone().max(Dyadic::zero());
    let upper = around.upper().plus(&beyond, bits + BOUND_BITS, Toward::Above);
    Interval::between(lower, upper)
}
