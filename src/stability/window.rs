//! Which observations a window holds.

use std::ops::Range;

/// Which observations the window of h steps that starts at time k holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Window {
    /// y(k), …, y(k+h−1): those that the filter has seen when it predicts x(k+h).
    Shifted,
    /// y(k+1), …, y(k+h), as the paper prints: one that the filter has not seen yet, and one that it has left out.
    Printed,
}

impl Window {
    /// The times of the observations of the window of this length that starts at `start`.
    pub fn times(self, start: usize, length: usize) -> Range<usize> {
        let first = start + self.skipped();
        first..first + length
    }

    /// How many observations from its start on it leaves out.
    pub(super) fn skipped(self) -> usize {
        match self {
            Self::Shifted => 0,
            Self::Printed => 1,
        }
    }
}
