//! Bareiss' elimination against the formula of Leibniz.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Residue, Scalar};

use crate::harness::{Replays, cover, harness};
use crate::matrices::{matrix, minor, rank_by_minors};

/// The sum over all permutations of three, written out.
fn leibniz<const P: u64>(a: &Matrix<Residue<P>>) -> Residue<P> {
    let term = |i: usize, j: usize, k: usize| a[(0, i)].times(&a[(1, j)]).times(&a[(2, k)]);
    let even = term(0, 1, 2).plus(&term(1, 2, 0)).plus(&term(2, 0, 1));
    let odd = term(0, 2, 1).plus(&term(1, 0, 2)).plus(&term(2, 1, 0));
    even.minus(&odd)
}

harness! {
    /// The last pivot is the sum over all permutations, with zero pivots wherever they can stand.
    ///
    /// Domain: all 3×3 matrices modulo 3.
    bareiss_is_leibniz, unwind 12, Replays::All(19_683),
    covers ["singular", "regular", "regular with a zero first pivot"], {
        let a = matrix::<3>(3, 3);
        let expected = leibniz(&a);
        let regular = expected != Residue::zero();
        cover!(!regular, "singular");
        cover!(regular, "regular");
        cover!(regular && a[(0, 0)] == Residue::zero(), "regular with a zero first pivot");
        assert!(a.determinant() == Ok(expected));
    }
}

harness! {
    /// The number of pivots is the order of the largest nonzero minor.
    ///
    /// Domain: all 2×2 matrices modulo 5.
    rank_is_that_of_minors, unwind 10, Replays::All(625), covers ["rank 0", "rank 1", "rank 2"], {
        let a = matrix::<5>(2, 2);
        let expected = rank_by_minors(&a);
        cover!(expected == 0, "rank 0");
        cover!(expected == 1, "rank 1");
        cover!(expected == 2 && minor(&a) != Residue::zero(), "rank 2");
        assert!(a.rank() == expected);
    }
}
