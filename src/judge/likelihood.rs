//! The log likelihood of a reading, to many more digits than are judged.
//!
//! `−½ (νᵀS⁻¹ν + ln det S + m ln 2π)` is irrational. ν and S are eliminated in intervals, and what is kept is the middle of an
//! enclosure narrower than 2⁻¹⁰⁰, so that its digits are counted like those of the exact values.

use crate::filter::StepValues;
use crate::matrix::Matrix;
use crate::scalar::{Dyadic, Interval, Logarithms, Rational, Scalar as _, Undefined, ratio};
use crate::trace::Quantity;

/// Bits of the intervals in the elimination: what a nearly singular S takes of them, it may take.
const BITS: u64 = 256;

/// The width in bits of the logarithms.
const LOGARITHM_BITS: u64 = 128;

/// The width in bits beyond which nothing is judged.
const NARROW: i32 = 100;

/// Log likelihoods; ln 2π is computed once.
pub(super) struct LogLikelihood {
    logarithms: Logarithms,
    of_two_pi: Option<Interval>,
}

impl Default for LogLikelihood {
    fn default() -> Self {
        let logarithms = Logarithms::new(LOGARITHM_BITS);
        let two = Interval::of(&ratio(2, 1), BITS);
        let of_two_pi = of(&logarithms, &Interval::pi(BITS).times(&two, BITS)).ok();
        Self { logarithms, of_two_pi }
    }
}

impl LogLikelihood {
    /// Adds the log likelihood to the values of each step whose innovation covariance is regular, or at which nothing is read.
    ///
    /// On a singular one a density is one on a subspace, and a diffuse part leaves a constant open: customs differ, so neither
    /// is judged.
    pub(super) fn insert_into(&self, steps: &mut [StepValues]) {
        for step in steps {
            self.insert(step);
        }
    }

    fn insert(&self, step: &mut StepValues) {
        let [innovation, covariance] =
            [Quantity::Innovation, Quantity::InnovationCovariance].map(|quantity| step.values.get(&quantity));
        let (Some(innovation), Some(covariance)) = (innovation, covariance) else {
            // Nothing is read of a state that has a law: the likelihood is one.
            if step.values.contains_key(&Quantity::PredictedMean) {
                step.values.insert(Quantity::LogLikelihood, Matrix::zeros(1, 1));
            }
            return;
        };
        if step.innovation_rank == covariance.rows()
            && let Some(value) = self.of(innovation, covariance)
        {
            step.values.insert(Quantity::LogLikelihood, Matrix::column(vec![value]));
        }
    }

    fn of(&self, innovation: &Matrix<Rational>, covariance: &Matrix<Rational>) -> Option<Rational> {
        let (quadratic, determinant) = eliminated(innovation, covariance).ok()?;
        let count = Interval::of(&ratio(i64::try_from(covariance.rows()).ok()?, 1), BITS);
        let constant = self.of_two_pi.as_ref()?.times(&count, BITS);
        let twice = quadratic.plus(&of(&self.logarithms, &determinant).ok()?, BITS).plus(&constant, BITS);
        let (lower, upper) = (twice.lower().value()?, twice.upper().value()?);
        let is_narrow = upper.minus(&lower) <= ratio(1, 2).pow(NARROW);
        is_narrow.then(|| lower.plus(&upper).times(&ratio(-1, 4)))
    }
}

/// ln of all positive numbers between two.
fn of(logarithms: &Logarithms, x: &Interval) -> Result<Interval, Undefined> {
    let end = |x: &Dyadic| logarithms.of(&x.value().ok_or(Undefined::Undecided)?);
    Ok(end(x.lower())?.joined(&end(x.upper())?))
}

/// νᵀS⁻¹ν and det S, by elimination.
fn eliminated(innovation: &Matrix<Rational>, covariance: &Matrix<Rational>) -> Result<(Interval, Interval), Undefined> {
    let interval = |entry: &Rational| Interval::of(entry, BITS);
    let (mut s, mut v) = (covariance.map(interval), innovation.map(interval));
    let (mut quadratic, mut determinant) = (Interval::zero(), Interval::of(&ratio(1, 1), BITS));
    for k in 0..s.rows() {
        let pivot = s[(k, k)].clone();
        quadratic = quadratic.plus(&v[(k, 0)].times(&v[(k, 0)], BITS).over(&pivot, BITS)?, BITS);
        determinant = determinant.times(&pivot, BITS);
        for i in k + 1..s.rows() {
            let factor = s[(i, k)].over(&pivot, BITS)?;
            v[(i, 0)] = v[(i, 0)].minus(&factor.times(&v[(k, 0)], BITS), BITS);
            for j in k + 1..s.rows() {
                s[(i, j)] = s[(i, j)].minus(&factor.times(&s[(k, j)], BITS), BITS);
            }
        }
    }
    Ok((quadratic, determinant))
}
