//! What a simulation may be asked.

use std::num::NonZeroUsize;

use super::{BioreactorError, Start};

/// Where the true start comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Truth {
    /// x(1) = [25; 30] in every run, as in the paper. No law of the start is right then, and no predictor optimal.
    Fixed,
    /// Drawn in every run from the belief of the extended predictor, which must be semidefinite. The standard predictor
    /// starts with the law of x(1) given the old substrates, which HV-C4b asks for.
    Drawn,
}

/// A simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// How the predictors start.
    pub start: Start,
    /// Where the true start comes from.
    pub truth: Truth,
    /// How many steps before a transition the substrate and the reading were taken on which its rates depend.
    pub delay: usize,
    /// d, how many steps ahead is predicted; at most one more than the delay.
    pub ahead: NonZeroUsize,
    /// n, the number of steps.
    pub steps: usize,
    /// The number of runs.
    pub runs: u64,
    /// The seed of run 0; run r has seed + r. All values of β see the same noise.
    pub seed: u64,
}

impl Options {
    /// One step ahead, a thousand runs of 150 steps, delay 1.
    pub fn one_step(start: Start) -> Self {
        Self { start, truth: Truth::Fixed, delay: 1, ahead: NonZeroUsize::MIN, steps: 150, runs: 1000, seed: 0 }
    }

    /// Two steps ahead, delay 2, else as [`Options::one_step`].
    pub fn two_steps(start: Start) -> Self {
        Self { delay: 2, ahead: NonZeroUsize::MIN.saturating_add(1), ..Self::one_step(start) }
    }

    /// Refuses what has no meaning.
    ///
    /// # Errors
    ///
    /// [`BioreactorError::Empty`], [`BioreactorError::Unknown`], and those of [`Start::checked`].
    pub fn checked(&self) -> Result<(), BioreactorError> {
        let ahead = self.ahead.get();
        if self.steps < 2 || self.steps < ahead || self.runs == 0 {
            return Err(BioreactorError::Empty);
        }
        if ahead > self.delay + 1 {
            return Err(BioreactorError::Unknown { ahead, delay: self.delay });
        }
        self.start.checked(self.delay)
    }
}
