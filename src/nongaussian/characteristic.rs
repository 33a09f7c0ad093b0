//! The conditional characteristic function of the state, exact in its exponents.

use num_bigint::BigInt;

use super::enclosure::{MOST_BITS, sizes, width};
use super::posterior::half;
use super::{Evidence, Posterior, Quantity, TooWide};
use crate::matrix::Matrix;
use crate::scalar::{Dyadic, Exponentials, Interval, OrderedField, Rational};

/// What a component adds: its evidence times `exp(−damping + i phase)`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CharacteristicTerm<S> {
    /// What its probability is made of.
    pub evidence: Evidence<S>,
    /// ½ θᵀCθ ≥ 0, C being the covariance of the state in it.
    pub damping: S,
    /// θᵀm, m being the mean of the state in it.
    pub phase: S,
}

/// The conditional characteristic function at one θ: `Σ (evidence) exp(−damping + i phase) / Σ (evidence)`.
///
/// SM-4.26: `E[exp(iθᵀX°(t+1)) | 𝒴(t)] = exp(iθᵀX̄(t+1) − ½ θᵀP(t+1)θ) ∫ exp(zᵀ[iQ*ᵀ(t+1)θ + B̄(t+1)] − ½ zᵀR*(t+1)z) dF(z) / ∫ exp(zᵀB̄(t+1) − ½ zᵀR*(t+1)z) dF(z)`
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CharacteristicFunction<S> {
    /// One for each component.
    pub terms: Vec<CharacteristicTerm<S>>,
}

impl<S: OrderedField> Posterior<S> {
    /// The characteristic function of the state given the readings, at θ of shape n×1.
    ///
    /// SM-4.22: `E[exp(iθᵀX°(t+1)) | 𝒴(t)] = q(t+1; θ) / q(t+1; 0)`
    ///
    /// # Panics
    ///
    /// If θ has another shape.
    pub fn characteristic(&self, theta: &Matrix<S>) -> CharacteristicFunction<S> {
        let term = |part: &super::PosteriorComponent<S>| {
            let exponent = part.state.characteristic_exponent(theta);
            CharacteristicTerm {
                evidence: part.evidence.clone(),
                damping: half(&exponent.quadratic),
                phase: exponent.linear,
            }
        };
        CharacteristicFunction { terms: self.components.iter().map(term).collect() }
    }
}

impl CharacteristicFunction<Rational> {
    /// Its real and its imaginary part, each in an interval of width at most 2^−bits.
    ///
    /// # Errors
    ///
    /// [`TooWide`] if that takes too many bits of work, as for a phase beyond 2^131072.
    pub fn value(&self, bits: u64) -> Result<[Interval; 2], TooWide> {
        let part = Dyadic::new(BigInt::from(1), -i64::try_from(bits).unwrap_or(i64::MAX));
        let mut work = bits.saturating_add(32);
        // Widths here are absolute, so that little more is needed than what is asked for.
        let most = work.saturating_mul(4).min(MOST_BITS);
        while work <= most {
            if let Some(found) = self.enclosed(work)
                && found.iter().all(|found| width(found) <= part)
            {
                return Ok(found);
            }
            work *= 2;
        }
        Err(TooWide { quantity: Quantity::Characteristic, bits, most, known: None })
    }

    fn enclosed(&self, work: u64) -> Option<[Interval; 2]> {
        let evidence: Vec<Evidence<Rational>> = self.terms.iter().map(|term| term.evidence.clone()).collect();
        let largest = evidence.iter().map(|evidence| &evidence.exponent).max()?;
        let sizes = sizes(&evidence, largest, work).ok()?;
        let exponentials = Exponentials::new(work);
        let (mut real, mut imaginary, mut whole) = (Interval::zero(), Interval::zero(), Interval::zero());
        for (term, size) in self.terms.iter().zip(&sizes) {
            // No damping is negative.
            let damped = size.times(&exponentials.of(&-&term.damping).ok()?, work);
            let (cosine, sine) = Interval::cosine_and_sine(&term.phase, work);
            real = real.plus(&damped.times(&cosine, work), work);
            imaginary = imaginary.plus(&damped.times(&sine, work), work);
            whole = whole.plus(size, work);
        }
        Some([real.over(&whole, work).ok()?, imaginary.over(&whole, work).ok()?])
    }
}
