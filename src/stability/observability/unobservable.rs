//! Proofs that windows do not see a direction.

use crate::matrix::Matrix;
use crate::scalar::OrderedField;
use crate::stability::{ModeProcess, Window};

/// A path of a window and a direction in which its Gramian vanishes: Gv = 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnobservablePath<S> {
    /// Which observations count.
    pub window: Window,
    /// The modes of k, k+1, …: h of them, or h + 1 for the printed window.
    pub modes: Vec<usize>,
    /// v ≠ 0, d×1.
    pub vector: Matrix<S>,
}

/// A path without end that never sees a direction: `modes`, and then for ever again those from the place `back_to` on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnobservableLoop<S> {
    /// Which observations count.
    pub window: Window,
    /// The modes of k, k+1, …, until they repeat.
    pub modes: Vec<usize>,
    /// Where the path goes on after the last of them.
    pub back_to: usize,
    /// For each of these times a basis of a subspace that is not seen there and led into the next one: HU = 0, and the columns
    /// of FU are combinations of the next basis. The first one is not zero.
    pub subspaces: Vec<Matrix<S>>,
}

impl<S: OrderedField> UnobservablePath<S> {
    /// Checks the proof, without the search: the path has positive probability, v ≠ 0, and H(i)Φ(i,k)v = 0 for all i of the
    /// window.
    pub fn is_valid_for(&self, process: &ModeProcess<S>) -> bool {
        if !is_path(process, &self.modes) || self.vector.shape() != Matrix::<S>::zeros(process.states(), 1).shape() {
            return false;
        }
        let mut carried = self.vector.clone();
        let unseen = self.modes.iter().enumerate().all(|(place, &mode)| {
            let mode = &process.modes()[mode];
            let unseen = place < self.window.skipped() || (mode.observation() * &carried).is_zero();
            carried = mode.transition() * &carried;
            unseen
        });
        unseen && !self.vector.is_zero()
    }
}

impl<S: OrderedField> UnobservableLoop<S> {
    /// A direction that the path never sees, d×1.
    pub fn vector(&self) -> Matrix<S> {
        self.subspaces[0].select_columns(&[0])
    }

    /// Checks the proof, without the search: each step has positive probability and does with its subspace what is said
    /// there.
    pub fn is_valid_for(&self, process: &ModeProcess<S>) -> bool {
        let (count, d) = (self.modes.len(), process.states());
        if self.back_to >= count || self.subspaces.len() != count || self.back_to < self.window.skipped() {
            return false;
        }
        let around: Vec<usize> = self.modes.iter().copied().chain([self.modes[self.back_to]]).collect();
        if !is_path(process, &around) || self.subspaces.iter().any(|basis| basis.rows() != d) {
            return false;
        }
        let carried = (0..count).all(|place| {
            let (mode, basis) = (&process.modes()[self.modes[place]], &self.subspaces[place]);
            let next = self.subspaces.get(place + 1).unwrap_or(&self.subspaces[self.back_to]);
            let unseen = place < self.window.skipped() || (mode.observation() * basis).is_zero();
            unseen && next.beside(&(mode.transition() * basis)).rank() == next.rank()
        });
        carried && self.subspaces[0].rank() > 0
    }
}

/// Whether these modes can follow each other, from some time on.
fn is_path<S: OrderedField>(process: &ModeProcess<S>, modes: &[usize]) -> bool {
    let known = modes.iter().all(|&mode| mode < process.modes().len());
    let begins = modes.first().is_none_or(|first| process.reachable().contains(first));
    known && begins && modes.windows(2).all(|pair| process.transition()[(pair[0], pair[1])] > S::zero())
}
