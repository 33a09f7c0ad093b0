//! Small matrices of residues, and their ranks by minors.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Residue, Scalar};

use crate::harness::below;

/// Any residue.
pub fn residue<const P: u64>() -> Residue<P> {
    Residue::new(below(P))
}

/// Any matrix of residues.
pub fn matrix<const P: u64>(rows: usize, columns: usize) -> Matrix<Residue<P>> {
    Matrix::from_fn(rows, columns, |_, _| residue())
}

/// `ad − bc`
pub fn minor<const P: u64>(matrix: &Matrix<Residue<P>>) -> Residue<P> {
    let at = |i, j| &matrix[(i, j)];
    at(0, 0).times(at(1, 1)).minus(&at(0, 1).times(at(1, 0)))
}

/// The rank of a 2×2 matrix: the order of its largest minor that is not zero.
pub fn rank_by_minors<const P: u64>(matrix: &Matrix<Residue<P>>) -> usize {
    if minor(matrix) == Residue::zero() {
        usize::from(matrix.entries().iter().any(|entry| *entry != Residue::zero()))
    } else {
        2
    }
}
