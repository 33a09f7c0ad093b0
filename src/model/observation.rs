//! One observation, of which entries may be missing.

use crate::matrix::Matrix;

/// The reading y_k: one entry per sensor, `None` where there is none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Observation<T>(Vec<Option<T>>);

impl<T> Observation<T> {
    /// An observation with the given entries.
    pub fn new(entries: Vec<Option<T>>) -> Self {
        Self(entries)
    }

    /// An observation without a missing entry.
    pub fn complete(entries: impl IntoIterator<Item = T>) -> Self {
        Self(entries.into_iter().map(Some).collect())
    }

    /// An observation of the given dimension, all missing.
    pub fn missing(dimension: usize) -> Self {
        Self((0..dimension).map(|_| None).collect())
    }

    /// The number of entries, missing ones included.
    pub fn dimension(&self) -> usize {
        self.0.len()
    }

    /// The entries.
    pub fn entries(&self) -> &[Option<T>] {
        &self.0
    }

    /// The places that were observed, in increasing order.
    pub fn present(&self) -> Vec<usize> {
        (0..self.0.len()).filter(|&i| self.0[i].is_some()).collect()
    }

    /// The values at those places, as a column.
    pub fn values(&self) -> Matrix<T>
    where
        T: Clone,
    {
        Matrix::column(self.0.iter().flatten().cloned().collect())
    }

    /// The observation of the images of the entries, or the first failure.
    ///
    /// # Errors
    ///
    /// What `image` returns.
    pub fn try_map<U, E>(&self, mut image: impl FnMut(&T) -> Result<U, E>) -> Result<Observation<U>, E> {
        self.0.iter().map(|entry| entry.as_ref().map(&mut image).transpose()).collect::<Result<_, _>>().map(Observation)
    }
}
