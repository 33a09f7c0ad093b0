//! Fraction-free elimination on integers of fixed width: all quotients are exact, and all entries are minors.

use exact_kalman::matrix::{Echelon, Matrix};

use crate::harness::{Replays, cover, harness};
use crate::ratio::{Whole, integer};

fn any(rows: usize, columns: usize, bound: u8) -> Matrix<Whole> {
    Matrix::from_fn(rows, columns, |_, _| Whole(integer(bound).into()))
}

harness! {
    /// The last pivot of a 3×3 matrix is the sum over all permutations, up to the sign of the swaps; no quotient leaves a rest.
    ///
    /// Domain: all 3×3 matrices over {−1, 0, 1}.
    integer_pivots_are_leibniz, unwind 12, Replays::All(19_683), covers ["singular", "regular", "a pivot that divides"], {
        let a = any(3, 3, 1);
        let term = |i: usize, j: usize, k: usize| a[(0, i)].0 * a[(1, j)].0 * a[(2, k)].0;
        let expected = term(0, 1, 2) + term(1, 2, 0) + term(2, 0, 1) - term(0, 2, 1) - term(1, 0, 2) - term(2, 1, 0);
        cover!(expected == 0, "singular");
        cover!(expected != 0, "regular");
        // The divisor of the third step is then the second pivot.
        cover!((a[(0, 0)].0 * a[(1, 1)].0 - a[(0, 1)].0 * a[(1, 0)].0).abs() == 2, "a pivot that divides");
        assert!(a.determinant() == Ok(Whole(expected)));
    }
}

harness! {
    /// Every entry of an eliminated 2×3 matrix is the minor in which its column replaces that of its row's pivot.
    ///
    /// Domain: all 2×3 matrices over {−2, …, 2}.
    undivided_entries_are_minors, unwind 10, Replays::All(15_625),
    covers ["rank 0", "rank 1", "rank 2", "the first two columns depend on each other"], {
        let a = any(2, 3, 2);
        let minor = |i: usize, j: usize| a[(0, i)].0 * a[(1, j)].0 - a[(0, j)].0 * a[(1, i)].0;
        let Ok(echelon) = Echelon::of(&a, 3) else { panic!("integers decide, and every quotient is exact") };
        let rank = [minor(0, 1), minor(0, 2), minor(1, 2)].iter().any(|minor| *minor != 0);
        let rank = if rank { 2 } else { usize::from(a.entries().iter().any(|entry| entry.0 != 0)) };
        assert!(echelon.rank() == rank);
        cover!(rank == 0, "rank 0");
        cover!(rank == 1, "rank 1");
        cover!(rank == 2, "rank 2");
        if let [p, q] = *echelon.pivots() {
            cover!(q == 2, "the first two columns depend on each other");
            // A swap of rows changes the sign of all of them.
            let sign = if echelon.divisor().0 == minor(p, q) { 1 } else { -1 };
            assert!(echelon.divisor().0 == sign * minor(p, q));
            for column in 0..3 {
                assert!(echelon.undivided()[(0, column)].0 == sign * minor(column, q));
                assert!(echelon.undivided()[(1, column)].0 == sign * minor(p, column));
            }
        }
    }
}
