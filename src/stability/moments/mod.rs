//! Whether a moment of P(k) stays bounded: yes with a proof, no with a proof, or undecided.

mod bound;
mod gain_search;
mod growth;
mod intermittent;
mod largest;

pub use bound::MomentBound;
pub use growth::MomentGrowth;
pub use intermittent::CriticalArrival;
pub use largest::LargestMoment;

use crate::matrix::Matrix;
use crate::scalar::Rational;
use crate::stability::ModeProcess;

/// The order of the largest linear system or characteristic polynomial that is begun.
const LARGEST_OPERATOR: usize = 40;

/// What is known of `sup_k E‖P(k)‖ˢ`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MomentVerdict {
    /// It is finite.
    Bounded(MomentBound),
    /// It is infinite.
    Unbounded(MomentGrowth),
    /// It was not decided.
    Undecided(MomentDoubt),
}

/// Why it was not decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MomentDoubt {
    /// No gains that are constant in each mode were found to prove it bounded, and nothing that is never observed proves it unbounded.
    NoCertificate,
    /// An operator of this order would be needed.
    TooLarge {
        /// The order.
        order: usize,
    },
}

impl ModeProcess<Rational> {
    /// Whether `sup_k E‖P(k)‖ˢ` is finite for the start P(0) ≥ 0.
    ///
    /// WG-D1.1: `{A(k)} is L_r-stable (r > 0) if sup_k E‖A(k)‖^r < ∞`
    ///
    /// Here r = s. For modes that each observe everything (rank H = d) or nothing (H = 0), with Q > 0, this is exact and decided but for
    /// one case ([`ModeProcess::moment_growth`]): for one state, f and loss of probability a at each time, exactly a f²ˢ < 1 is bounded.
    /// With n modes of d states, the work is that of solving linear systems and finding characteristic polynomials of order
    /// n·C(d(d+1)/2 + s, s), at most 40, and of up to 2ⁿ smaller ones (n ≤ 8).
    ///
    /// # Panics
    ///
    /// If the start is not d×d, or s is zero.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}};
    /// use exact_kalman::stability::{Mode, ModeProcess, MomentVerdict};
    ///
    /// let scalar = |value| Matrix::<Rational>::diagonal(&[value]);
    /// let mode = |h| Mode::new(scalar(ratio(3, 2)), scalar(ratio(h, 1)), scalar(ratio(1, 1)), scalar(ratio(1, 1)));
    /// let link = ModeProcess::independent(vec![mode(0)?, mode(1)?], vec![ratio(1, 4), ratio(3, 4)])?;
    /// let MomentVerdict::Bounded(mean) = link.moment(1, &scalar(ratio(2, 1))) else { panic!("(1/4)(3/2)² < 1") };
    /// assert!(mean.bound <= ratio(43, 7));
    /// assert!(matches!(link.moment(2, &scalar(ratio(2, 1))), MomentVerdict::Unbounded(_)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn moment(&self, order: usize, start: &Matrix<Rational>) -> MomentVerdict {
        let triangle = self.states() * (self.states() + 1) / 2;
        let size = self.reachable().len().saturating_mul(binomial(triangle + order, order));
        if size > LARGEST_OPERATOR {
            return MomentVerdict::Undecided(MomentDoubt::TooLarge { order: size });
        }
        if let Some(growth) = self.moment_growth_from(order, start) {
            return MomentVerdict::Unbounded(growth);
        }
        match self.moment_bound(order, start) {
            Some(bound) => MomentVerdict::Bounded(bound),
            None => MomentVerdict::Undecided(MomentDoubt::NoCertificate),
        }
    }

    /// The least of the bounds of the moment of order s that the gains which were tried prove; nothing if they prove none.
    ///
    /// # Panics
    ///
    /// If the start is not d×d, or s is zero.
    pub fn moment_bound(&self, order: usize, start: &Matrix<Rational>) -> Option<MomentBound> {
        let bounds = self.likely_gains().filter_map(|gains| self.moment_bound_under(&gains, order, start));
        bounds.min_by(|one, other| one.bound.cmp(&other.bound))
    }
}

fn binomial(n: usize, k: usize) -> usize {
    (1..=k).fold(1_usize, |product, i| product.saturating_mul(n - k + i) / i)
}
