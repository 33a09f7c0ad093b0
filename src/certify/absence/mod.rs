//! Whether a step has a stabilising solution at all.
//!
//! Two kinds of modes forbid it: unobservable ones of modulus 1 or more, and ones of modulus 1 that no noise reaches. Both are
//! decided over the fractions, without a number that is rounded: spaces and polynomials are searched modulo a prime and checked exactly.

mod circle;
mod disc;
mod invariant;
mod polynomial;
mod proof;
mod remainder;
mod search;
mod span;
mod spectrum;

pub use proof::Absence;

use search::Found;

use crate::matrix::Matrix;
use crate::model::UnifiedStep;
use crate::scalar::Rational;

/// Whether `S = A S Aᵀ + Q − Γ Σ⁻¹ Γᵀ` with `Γ = A S Hᵀ + S_c`, `Σ = H S Hᵀ + R > 0` has a symmetric solution such that
/// `A − Γ Σ⁻¹ H` has spectral radius below 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Existence {
    /// There is none.
    Absent(Box<Absence>),
    /// There is one, since R > 0, the noise is positive semidefinite, and neither kind of modes is there (S. Chan, G. Goodwin, K. Sin,
    /// Convergence properties of the Riccati difference equation, 1984; C. de Souza, M. Gevers, G. Goodwin, Riccati equations in
    /// optimal filtering of nonstabilizable systems, 1986).
    Present,
    /// Not known.
    Undecided(Unknown),
}

/// Why it is not known whether there is a stabilising solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unknown {
    /// The model is too large for the search.
    #[error("more than {LARGEST} states or sensors: modes that forbid a solution were not searched")]
    TooLarge,
    /// The search ended at numbers that are too long.
    #[error("modes that may forbid a solution are given by numbers too long to be decided")]
    TooLong,
    /// R is singular, and nothing was found that forbids a solution.
    #[error(
        "nothing was found that forbids a solution; with a singular covariance of the observations that proves nothing"
    )]
    SingularNoise,
    /// The noise has no covariance, and nothing was found that forbids a solution.
    #[error(
        "nothing was found that forbids a solution; with noise that is not positive semidefinite that proves nothing"
    )]
    IndefiniteNoise,
}

/// More states or sensors are not searched.
const LARGEST: usize = 128;

impl Existence {
    /// Decides for a step; work and memory are bounded.
    ///
    /// Shapes: those of the step, which fit.
    ///
    /// # Examples
    ///
    /// A level that no noise moves, seen with noise: 1 is an eigenvalue that no noise reaches.
    ///
    /// ```
    /// use exact_kalman::certify::{Absence, Existence};
    /// use exact_kalman::matrix::Matrix;
    /// use exact_kalman::model::{Timing, UnifiedStep};
    /// use exact_kalman::scalar::ratio;
    ///
    /// let number = |value| Matrix::from_fn(1, 1, |_, _| ratio(value, 1));
    /// let step = |noise| UnifiedStep::new(
    ///     Timing::Departing, number(1), &number(1), number(noise), &number(0), number(1));
    /// let Existence::Absent(absence) = Existence::of(&step(0)) else { panic!("no noise") };
    /// assert_eq!(absence.to_string(), "no noise reaches the eigenvalue 1, on the unit circle");
    /// assert_eq!(Existence::of(&step(1)), Existence::Present);
    /// ```
    pub fn of(step: &UnifiedStep) -> Self {
        if step.states() > LARGEST || step.sensors() > LARGEST {
            return Self::Undecided(Unknown::TooLarge);
        }
        let unobservable = search::unobservable(step);
        if let Found::Proof(absence) = unobservable {
            return Self::Absent(absence);
        }
        let unreachable = search::unreachable(step);
        if let Found::Proof(absence) = unreachable {
            return Self::Absent(absence);
        }
        // Where R is singular, a search that found nothing proves nothing.
        let unknown = match (unobservable, noise(step), unreachable) {
            (Found::Nothing, None, Found::Nothing) => return Self::Present,
            (Found::Nothing, Some(unknown), _) => unknown,
            _ => Unknown::TooLong,
        };
        Self::Undecided(unknown)
    }
}

/// What keeps the theorem of existence from holding: R that is not positive definite, or noise that is no covariance.
fn noise(step: &UnifiedStep) -> Option<Unknown> {
    let (process, cross, observation) = (&step.process_noise, &step.cross_noise, &step.observation_noise);
    let joint = process.beside(cross).above(&cross.transpose().beside(observation));
    if is_long(&joint) {
        return Some(Unknown::TooLong);
    }
    if joint.ldl().is_err() {
        return Some(Unknown::IndefiniteNoise);
    }
    let is_definite = observation.ldl().is_ok_and(|ldl| ldl.is_positive_definite());
    (!is_definite).then_some(Unknown::SingularNoise)
}

/// Whether an elimination would be long: entries that are not zero off the diagonal, many of them, of many bits.
fn is_long(matrix: &Matrix<Rational>) -> bool {
    let coupled =
        (0..matrix.rows()).filter(|&i| (0..matrix.columns()).any(|j| i != j && matrix[(i, j)] != Rational::default()));
    let order = u64::try_from(coupled.count()).unwrap_or(u64::MAX);
    let bits = matrix.entries().iter().map(|entry| entry.numer().bits() + entry.denom().bits()).max().unwrap_or(0);
    order.saturating_pow(4).saturating_mul(bits / 64 + 1) > ELIMINATION
}

/// The work on the elimination of the noise, in products of words.
const ELIMINATION: u64 = 100_000_000;
