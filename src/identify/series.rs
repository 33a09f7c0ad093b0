//! The data: equally spaced readings of all components.

use crate::matrix::Matrix;

/// The readings y(1), …, y(n) of AK-1.2, counted from 1 as in the paper: n ≥ 3 columns of one length p ≥ 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Series<S>(Vec<Matrix<S>>);

/// Why readings are no series.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SeriesError {
    /// There are fewer than three: AK-2.1 has no term.
    #[error("{found} readings; the first estimate needs y(1), y(2) and y(3)")]
    TooShort {
        /// How many there are.
        found: usize,
    },
    /// The readings have no component.
    #[error("the readings have no component")]
    NoComponent,
    /// A reading has another length than the first.
    #[error("reading {index} has {found} components where reading 0 has {expected}")]
    Ragged {
        /// The first such reading, counted from 0.
        index: usize,
        /// The length of reading 0.
        expected: usize,
        /// The length of that reading.
        found: usize,
    },
}

impl<S> Series<S> {
    /// The series of the given readings.
    ///
    /// # Errors
    ///
    /// [`SeriesError`] if they are fewer than three, empty, or of different lengths.
    pub fn new(readings: Vec<Vec<S>>) -> Result<Self, SeriesError> {
        let expected = readings.first().map_or(0, Vec::len);
        let lengths = readings.iter().map(Vec::len).enumerate();
        if let Some((index, found)) = lengths.into_iter().find(|(_, found)| *found != expected) {
            return Err(SeriesError::Ragged { index, expected, found });
        }
        if readings.len() < 3 {
            return Err(SeriesError::TooShort { found: readings.len() });
        }
        if expected == 0 {
            return Err(SeriesError::NoComponent);
        }
        Ok(Self(readings.into_iter().map(Matrix::column).collect()))
    }

    /// The readings, each p×1; y(k) is `readings()[k − 1]`.
    pub fn readings(&self) -> &[Matrix<S>] {
        &self.0
    }

    /// p, the number of components.
    pub fn dimension(&self) -> usize {
        self.0[0].rows()
    }
}
