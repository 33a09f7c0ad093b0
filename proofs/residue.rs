//! Residues against machine integers that are wide enough never to wrap.

use exact_kalman::scalar::{Residue, Scalar, Undefined};

use crate::harness::{Replays, below, cover, harness};

/// The four operations of `Residue<P>` at (a, b) against `u128`.
fn agrees<const P: u64>(a: u64, b: u64) {
    let (x, y) = (Residue::<P>::new(a), Residue::<P>::new(b));
    let (a, b, p) = (u128::from(a), u128::from(b), u128::from(P));
    let value = |residue: Residue<P>| u128::from(residue.representative());
    assert!(value(x.plus(&y)) == (a + b) % p);
    assert!(value(x.minus(&y)) == (a + p - b) % p);
    assert!(value(x.times(&y)) == a * b % p);
    match x.over(&y) {
        Ok(quotient) => assert!(b != 0 && value(quotient) < p && value(quotient) * b % p == a),
        Err(error) => assert!(b == 0 && error == Undefined::DivisionByZero),
    }
}

harness! {
    /// The four operations.
    ///
    /// Domain: all pairs modulo 127.
    residues_are_machine_integers, unwind 66, Replays::All(127 * 127),
    covers ["the sum wraps", "the difference wraps", "division by zero"], {
        let (a, b) = (below(127), below(127));
        cover!(a + b >= 127, "the sum wraps");
        cover!(a < b, "the difference wraps");
        cover!(b == 0, "division by zero");
        agrees::<127>(a, b);
    }
}

harness! {
    /// Pairs modulo 2⁶¹ − 1, where products need 122 bits.
    large_residues_are_machine_integers, unwind 66, Replays::Random(20_000),
    covers ["the sum wraps", "the product passes 64 bits"], {
        const P: u64 = (1 << 61) - 1;
        let (a, b) = (below(P), below(P));
        cover!(a + b >= P, "the sum wraps");
        cover!(a.checked_mul(b).is_none(), "the product passes 64 bits");
        agrees::<P>(a, b);
    }
}
