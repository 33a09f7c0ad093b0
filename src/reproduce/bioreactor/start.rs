//! What is believed at the start: the paper's numbers, repairs of them, and readings of what it leaves out.

use std::fmt;

use super::{BioreactorError, Concentration};
use crate::float::Linearisation;
use crate::matrix::{Ldl, LdlError, Matrix};
use crate::scalar::{Rational, ratio};

/// The mean and the covariance with which a predictor starts.
#[derive(Clone, Debug, PartialEq)]
pub struct Belief<T> {
    /// n×1.
    pub mean: Matrix<T>,
    /// n×n.
    pub covariance: Matrix<T>,
}

impl<T: Concentration> Belief<T> {
    /// The same with every number the nearest double.
    pub fn doubles(&self) -> Belief<f64> {
        Belief { mean: self.mean.map(T::double), covariance: self.covariance.map(T::double) }
    }

    pub(super) fn check_states(&self, predictor: &'static str, expected: usize) -> Result<(), BioreactorError> {
        let rows = [self.mean.rows(), self.covariance.rows(), self.covariance.columns()];
        match rows.into_iter().find(|&found| found != expected) {
            Some(found) => Err(BioreactorError::States { predictor, expected, found }),
            None if self.mean.columns() != 1 => Err(BioreactorError::States { predictor, expected, found: 0 }),
            None => Ok(()),
        }
    }
}

impl Belief<Rational> {
    /// The factors LDLᵀ of the covariance.
    pub(super) fn factors(&self, predictor: &'static str) -> Result<Ldl<Rational>, BioreactorError> {
        self.covariance.ldl().map_err(|error| match error {
            LdlError::Asymmetric { .. } => BioreactorError::Asymmetric { predictor },
            LdlError::Indefinite(proof) => {
                BioreactorError::Indefinite { predictor, covariance: self.covariance.clone(), proof }
            }
        })
    }
}

/// How both predictors start, and where the extended one is made linear.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// Of the standard predictor: x̂(1|0) and P(1|0), two states.
    pub standard: Belief<Rational>,
    /// Of the extended predictor: two states and one for each step of delay, the most recent old substrate first.
    pub extended: Belief<Rational>,
    /// The paper does not say.
    pub linearisation: Linearisation,
    /// Runs the predictors even if a covariance is not positive semidefinite, which no random vector has.
    pub allow_indefinite: bool,
}

impl Start {
    /// Refuses what does not belong to a delay of d steps, and indefinite covariances unless the override is set.
    ///
    /// # Errors
    ///
    /// [`BioreactorError::States`], [`BioreactorError::Asymmetric`]; [`BioreactorError::Indefinite`] with a witness.
    pub fn checked(&self, delay: usize) -> Result<(), BioreactorError> {
        for (predictor, belief, states) in [("standard", &self.standard, 2), ("extended", &self.extended, 2 + delay)] {
            belief.check_states(predictor, states)?;
            match belief.factors(predictor) {
                Err(BioreactorError::Indefinite { .. }) if self.allow_indefinite => {}
                outcome => drop(outcome?),
            }
        }
        Ok(())
    }
}

/// A choice of the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Preset {
    /// The numbers as printed. Both covariances are indefinite. Not given, and chosen here: ẑ(1) = 30 and linearisation
    /// at the prediction.
    Printed,
    /// The choice that comes closest to Table 1 of those that were tried: P_BB = 500, P_SS = 100, ẑ(1) = 10. Indefinite.
    Closest,
    /// As printed but P_BB = 5000, which makes both covariances positive definite.
    Repaired,
    /// A law that the true start may be drawn from: mean [25, 30, 30], standard deviations 5, 4 and 3.
    Drawn,
}

/// The numbers of a preset.
struct Numbers {
    mean: [i64; 3],
    /// Rows B, S and z.
    covariance: [[i64; 3]; 3],
}

impl Preset {
    /// Every preset, in order.
    pub const ALL: [Self; 4] = [Self::Printed, Self::Closest, Self::Repaired, Self::Drawn];

    /// The name: one word.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Printed => "printed",
            Self::Closest => "closest",
            Self::Repaired => "repaired",
            Self::Drawn => "drawn",
        }
    }

    const fn numbers(self) -> Numbers {
        let (mean, covariance) = match self {
            Self::Printed => ([10, 45, 30], [[80, 500, 20], [500, 80, 50], [20, 50, 100]]),
            Self::Closest => ([10, 45, 10], [[500, 500, 20], [500, 100, 50], [20, 50, 100]]),
            Self::Repaired => ([10, 45, 30], [[5000, 500, 20], [500, 80, 50], [20, 50, 100]]),
            Self::Drawn => ([25, 30, 30], [[25, 8, 2], [8, 16, 3], [2, 3, 9]]),
        };
        Numbers { mean, covariance }
    }

    /// The start for a delay of d steps, linear at the prediction, the override not set.
    ///
    /// HV-Start: `x̂(1|0) = [10; 45]`
    ///
    /// HV-P1.SKP: `P(1|0) = [[80, 500], [500, 80]]`
    ///
    /// HV-P1.EKP: `P(1|0) = [[80, 500, 20], [500, 80, 50], [20, 50, 100]]`
    ///
    /// The paper gives no start for more than one old substrate; all are taken for copies of the first, with equal means
    /// and full correlation.
    pub fn start(self, delay: usize) -> Start {
        let Numbers { mean, covariance } = self.numbers();
        let place = |i: usize| i.min(2);
        let belief = |states: usize| Belief {
            mean: Matrix::from_fn(states, 1, |i, _| ratio(mean[place(i)], 1)),
            covariance: Matrix::from_fn(states, states, |i, j| ratio(covariance[place(i)][place(j)], 1)),
        };
        Start {
            standard: belief(2),
            extended: belief(2 + delay),
            linearisation: Linearisation::Prediction,
            allow_indefinite: false,
        }
    }
}

impl fmt::Display for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
