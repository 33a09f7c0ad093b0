//! The stabilising solution of an equation of Riccati, to any number of digits, with a proof.
//!
//! > `S = A S Aᵀ + Q − (A S Hᵀ + S₀)(H S Hᵀ + R)⁻¹(A S Hᵀ + S₀)ᵀ`
//!
//! Doubling in fixed point proposes it; integers prove that it lies within so much, that the closed loop A − KH contracts, and so
//! that it is the only one of which this is true. R may be singular or zero as long as HSHᵀ + R is regular.

mod doubling;
mod equation;
mod fixed;
mod known;
mod point;
mod proof;
mod results;
mod series;
#[cfg(all(test, feature = "judge"))]
mod tests;
#[cfg(feature = "judge")]
mod witness;

use super::dyadics::{Dyadics, odd_denominator, symmetric};
use super::enclosed::{around, intervals, root};
use super::grid::{BOUND_BITS, nearest, rounded, scale, up};
use super::whitening::whitening;
use crate::matrix::Matrix;
use crate::model::UnifiedStep;
use crate::scalar::{Dyadic, Interval};
use doubling::{Failure, Proposal};
use equation::{Equation, without_repeated};
use known::told;
use num_traits::Zero as _;
use proof::Proof;
use results::Results;

/// How many digits are wanted, and how many bits may be spent on them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SteadyEffort {
    /// Decimal digits of each entry of S and of H S Hᵀ + R, as parts of √(sᵢᵢ sⱼⱼ).
    pub digits: u32,
    /// Whether as many are wanted of what is left of S once y is known.
    pub filtered: bool,
    /// Whether as many are wanted of A S Aᵀ + Q.
    pub open: bool,
    /// The most bits of a number in the proof.
    pub most_bits: u64,
}

impl Default for SteadyEffort {
    /// 30 digits of all covariances, with at most 4096 bits.
    fn default() -> Self {
        Self { digits: 30, filtered: true, open: true, most_bits: 1 << 12 }
    }
}

/// The stabilising solution, its gain, and how fast the closed loop forgets: each entry lies in its interval.
///
/// # Examples
///
/// ```
/// use exact_kalman::certify::{SteadyEffort, SteadyState};
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::model::UnifiedStep;
/// use exact_kalman::scalar::ratio;
///
/// let one = Matrix::from_integers(&[[1]]);
/// let walk = UnifiedStep {
///     transition: one.clone(),
///     observation: one.clone(),
///     process_noise: one.clone(),
///     cross_noise: Matrix::from_integers(&[[0]]),
///     observation_noise: one,
/// };
/// let state = SteadyState::of(&walk, SteadyEffort::default())?;
/// // The golden section: s² = s + 1.
/// let least = state.solution[(0, 0)].lower().value().ok_or("long")?;
/// assert!(&least * &least <= &least + ratio(1, 1) && least > ratio(1_618, 1_000));
/// assert!(state.digits.is_none_or(|digits| digits >= 30));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct SteadyState {
    /// S, n×n.
    pub solution: Matrix<Interval>,
    /// `K = (A S Hᵀ + S₀)(H S Hᵀ + R)⁻¹`, n×m; a column of zeros for a sensor that repeats others.
    pub gain: Matrix<Interval>,
    /// `H S Hᵀ + R`, of the sensors that are kept.
    pub innovation_covariance: Matrix<Interval>,
    /// `S − S Hᵀ(H S Hᵀ + R)⁻¹H S`, n×n: what is left of S once y is known.
    pub filtered_covariance: Matrix<Interval>,
    /// `S Hᵀ(H S Hᵀ + R)⁻¹`, n×m: the gain of that.
    pub filter_gain: Matrix<Interval>,
    /// `A S Aᵀ + Q`, n×n: what S becomes without y.
    pub open_covariance: Matrix<Interval>,
    /// r² < 1, and the spectral radius of A − KH is at most r.
    pub rate_squared: Dyadic,
    /// Entries of S and of H S Hᵀ + R are known to so many decimal digits of √(sᵢᵢ sⱼⱼ); nothing if exactly.
    pub digits: Option<u32>,
    /// States whose variances are not told from zero: their digits are those of the variance in A S Aᵀ + Q.
    pub vanishing: Vec<usize>,
    /// The digits of the filtered covariance.
    pub filtered_digits: Option<u32>,
    /// States whose filtered variances are not told from zero, and may not be: their digits are those of the variance in S.
    pub filtered_vanishing: Vec<usize>,
    /// The digits of A S Aᵀ + Q.
    pub open_digits: Option<u32>,
    /// States whose variances in A S Aᵀ + Q are not told from zero.
    pub open_vanishing: Vec<usize>,
    /// The bits that the proof took.
    pub bits: u64,
    /// The sensors that are used: the others repeat them, noise included.
    pub kept: Vec<usize>,
    /// What somebody else needs to check it.
    #[cfg(feature = "judge")]
    pub evidence: crate::verify::Stabilising,
}

/// Why there is no proof. None of this says that there is no stabilising solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unproved {
    /// No T whitens H S Hᵀ + R, nearly.
    #[error("the covariance of the innovation may be singular: not decided with {bits} bits")]
    Singular {
        /// The bits that were tried.
        bits: u64,
    },
    /// Doubling found nothing.
    #[error(
        "the iterates from a large start do not come to rest: the closed loop may reach the unit circle, or there is no stabilising solution"
    )]
    Restless,
    /// The set is not mapped into itself.
    #[error("no set around the proposed solution is seen to be mapped into itself with {bits} bits")]
    Bracket {
        /// The bits that were tried.
        bits: u64,
    },
    /// The closed loop is not seen to contract.
    #[error("the closed loop at the proposed solution is not seen to contract with {bits} bits")]
    Contraction {
        /// The bits that were tried.
        bits: u64,
    },
    /// The numbers of the model are too long for this, or there are too many.
    #[error("the model is too large: {what}")]
    TooLarge {
        /// What is too large.
        what: &'static str,
    },
}

/// Bits beyond those of the digits.
const MARGIN: u64 = 64;

/// More states or sensors take too long.
const MOST_STATES: usize = 200;

/// Longer common denominators do.
const MOST_DENOMINATOR_BITS: u64 = 1 << 16;

/// Iterates that do not come to rest are given so many times the bits of the first trial and of how far apart the numbers lie.
const RESTLESS: u64 = 4;

impl SteadyState {
    /// Proves it with as many bits as that takes.
    ///
    /// If the digits that are wanted are not reached with the bits that may be spent, those that are reached are returned.
    ///
    /// # Errors
    ///
    /// [`Unproved`], of the last trial.
    ///
    /// # Panics
    ///
    /// If the shapes of the matrices do not fit.
    pub fn of(step: &UnifiedStep, effort: SteadyEffort) -> Result<Self, Unproved> {
        if step.states().max(step.sensors()) > MOST_STATES {
            return Err(Unproved::TooLarge { what: "more than 200 states or sensors" });
        }
        let first = (u64::from(effort.digits) * 10).div_ceil(3) + MARGIN;
        let mut bits = first.min(effort.most_bits);
        let sensors = step.sensors();
        let all: Vec<usize> = (0..sensors).collect();
        let (mut step, mut kept) = (step.clone(), all);
        let mut best: Result<Self, Unproved> = Err(Unproved::Restless);
        let mut is_guess = false;
        loop {
            let equation = Equation::of(&step);
            if equation.noise_odd.bits() > MOST_DENOMINATOR_BITS {
                return Err(Unproved::TooLarge { what: "the common denominator of its numbers is too long" });
            }
            let tried = match Proposal::of(&step, bits) {
                Ok(proposal) => Proof::of(&proposal, &equation, bits),
                Err(Failure::Restless) => Err(Unproved::Restless),
                Err(Failure::Singular) => {
                    let (less, left) = without_repeated(&step);
                    if left.len() < step.sensors() {
                        kept = left.iter().map(|&place| kept[place]).collect();
                        step = less;
                        continue;
                    }
                    Err(Unproved::Singular { bits })
                }
            };
            match tried {
                Ok(proof) => {
                    let results = |told: &[usize]| {
                        Results { proof: &proof, equation: &equation, kept: &kept, told, sensors, bits }.state()
                    };
                    let mut state = results(&[]);
                    if !state.filtered_vanishing.is_empty() {
                        state = results(&told(&step.observation, &step.observation_noise));
                    }
                    if state.reaches(effort) {
                        return Ok(state);
                    }
                    best = Ok(state);
                }
                Err(reason) => {
                    if best.is_err() {
                        best = Err(reason);
                    }
                    if reason == Unproved::Restless && bits >= RESTLESS * (first + breadth(&step)) {
                        return best;
                    }
                }
            }
            if bits >= effort.most_bits {
                return best;
            }
            // A bit more makes a bit more known; where that was tried in vain, twice as many are next.
            let more = best.as_ref().ok().filter(|state| state.bits == bits).and_then(|state| state.missing(effort));
            let more = more.filter(|more| !is_guess && *more < bits);
            is_guess = more.is_some();
            bits += more.unwrap_or(bits);
            bits = bits.min(effort.most_bits);
        }
    }

    /// Digits, and states whose variances are not told from zero, of each covariance that is wanted.
    fn wanted(&self, effort: SteadyEffort) -> impl Iterator<Item = (Option<u32>, &[usize])> {
        let all = [
            (true, self.digits, &self.vanishing[..]),
            (effort.filtered, self.filtered_digits, &self.filtered_vanishing),
            (effort.open, self.open_digits, &self.open_vanishing),
        ];
        all.into_iter().filter_map(|(is_wanted, digits, vanishing)| is_wanted.then_some((digits, vanishing)))
    }

    /// Whether all is known that is wanted.
    fn reaches(&self, effort: SteadyEffort) -> bool {
        let is_enough = |digits: u32| digits >= effort.digits;
        self.wanted(effort).all(|(digits, vanishing)| vanishing.is_empty() && digits.is_none_or(is_enough))
    }

    /// The bits that the digits take which are missing, and some; nothing where a variance is not told from zero, so that nobody knows.
    fn missing(&self, effort: SteadyEffort) -> Option<u64> {
        if self.wanted(effort).any(|(digits, vanishing)| !vanishing.is_empty() || digits == Some(0)) {
            return None;
        }
        let least = self.wanted(effort).filter_map(|(digits, _)| digits).min()?;
        Some(u64::from(effort.digits.saturating_sub(least)) * 4 + MARGIN / 4)
    }
}

/// By how many bits the sizes of its numbers differ.
fn breadth(step: &UnifiedStep) -> u64 {
    let UnifiedStep { transition, observation, process_noise, cross_noise, observation_noise } = step;
    let all = [transition, observation, process_noise, cross_noise, observation_noise];
    let sizes = all.into_iter().flat_map(Matrix::entries).filter(|entry| !entry.is_zero()).map(|entry| {
        let bits = |integer: &num_bigint::BigInt| i64::try_from(integer.bits()).unwrap_or(i64::MAX);
        bits(entry.numer()) - bits(entry.denom())
    });
    let (least, most) = sizes.fold((0, 0), |(least, most), size| (size.min(least), size.max(most)));
    most.abs_diff(least)
}
