//! Subspaces in canonical form, so that equal ones are equal matrices.

use crate::matrix::{Echelon, Matrix};
use crate::scalar::OrderedField;
use crate::stability::Mode;

/// A subspace of the d-dimensional space.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Subspace<S> {
    /// The reduced echelon form of any basis, one vector a row.
    rows: Matrix<S>,
}

impl<S: OrderedField> Subspace<S> {
    pub(super) fn whole(d: usize) -> Self {
        Self { rows: Matrix::identity(d) }
    }

    /// {v : v is a combination of these columns}.
    fn spanned_by(columns: &Matrix<S>) -> Self {
        let Ok(rows) = Echelon::of(&columns.transpose(), columns.rows()).and_then(|echelon| echelon.reduced()) else {
            unreachable!("a field decides zero")
        };
        Self { rows }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.rows.rows() == 0
    }

    pub(super) fn lies_in(&self, other: &Self) -> bool {
        self.rows.rows() <= other.rows.rows() && other.rows.above(&self.rows).rank() == other.rows.rows()
    }

    /// A basis as the columns of a matrix.
    pub(super) fn basis(&self) -> Matrix<S> {
        self.rows.transpose()
    }

    /// {v : Fv is in this subspace}.
    pub(super) fn before_transition(&self, mode: &Mode<S>) -> Self {
        Self::spanned_by(&(self.annihilator() * mode.transition()).kernel())
    }

    /// {v : Hv = 0 and Fv is in this subspace}.
    pub(super) fn before(&self, mode: &Mode<S>) -> Self {
        Self::spanned_by(&mode.observation().above(&(self.annihilator() * mode.transition())).kernel())
    }

    /// A matrix whose kernel is this subspace.
    fn annihilator(&self) -> Matrix<S> {
        self.rows.kernel().transpose()
    }

    /// The members of a family that lie in no other: their union is that of the whole family.
    pub(super) fn largest<T>(mut family: Vec<(Self, T)>) -> Vec<(Self, T)> {
        // Larger ones first, and then in a fixed order, so that equal unions give equal lists.
        let key = |(space, _): &(Self, T)| (std::cmp::Reverse(space.rows.rows()), space.rows.entries().to_vec());
        family.sort_by_cached_key(key);
        let mut kept: Vec<(Self, T)> = Vec::new();
        for (space, tag) in family {
            if !kept.iter().any(|(larger, _)| space.lies_in(larger)) {
                kept.push((space, tag));
            }
        }
        kept
    }
}
