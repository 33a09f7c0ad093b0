//! HV-L3 over small fields, where a pseudo-inverse need not exist.
//!
//! Modulo 2 and 5 a vector of two entries may be orthogonal to itself: (1, 1) and (1, 2). Modulo 3 none is, since −1
//! is no square there, so every 2×2 matrix has a pseudo-inverse.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::Residue;

use crate::harness::{Replays, cover, harness};
use crate::matrices::{matrix, rank_by_minors};

/// P⁺, after checking that it exists iff rank P = rank PPᵀ = rank PᵀP, and then obeys the equations of Penrose.
fn checked<const P: u64>(p: &Matrix<Residue<P>>) -> Option<Matrix<Residue<P>>> {
    let rank = rank_by_minors(p);
    let gram = [rank_by_minors(&(p * p.transpose())), rank_by_minors(&(p.transpose() * p))];
    let inverse = p.pseudo_inverse().ok();
    assert!(inverse.is_some() == (gram == [rank; 2]), "{p:?} has rank {rank}, its Gram matrices have {gram:?}");
    if let Some(x) = &inverse {
        assert!(p * x * p == *p);
        assert!(x * p * x == *x);
        assert!((p * x).transpose() == p * x);
        assert!((x * p).transpose() == x * p);
    }
    inverse
}

harness! {
    /// HV-L3, CKS-L3-pinv over a field: it exists iff rank P = rank PPᵀ = rank PᵀP, and obeys the four equations.
    ///
    /// Domain: all 2×2 matrices modulo 2.
    pseudo_inverse_modulo_2, unwind 10, Replays::All(16),
    covers ["exists at rank 1", "exists at rank 2", "does not exist"], {
        let p = matrix::<2>(2, 2);
        let inverse = checked(&p);
        cover!(inverse.is_some() && rank_by_minors(&p) == 1, "exists at rank 1");
        cover!(inverse.is_some() && rank_by_minors(&p) == 2, "exists at rank 2");
        cover!(inverse.is_none(), "does not exist");
    }
}

harness! {
    /// HV-L3, CKS-L3-pinv over a field: it exists iff rank P = rank PPᵀ = rank PᵀP, and obeys the four equations;
    /// here every matrix has one.
    ///
    /// Domain: all 2×2 matrices modulo 3.
    pseudo_inverse_modulo_3, unwind 10, Replays::All(81), covers ["rank 0", "rank 1", "rank 2"], {
        let p = matrix::<3>(2, 2);
        assert!(checked(&p).is_some());
        cover!(rank_by_minors(&p) == 0, "rank 0");
        cover!(rank_by_minors(&p) == 1, "rank 1");
        cover!(rank_by_minors(&p) == 2, "rank 2");
    }
}

harness! {
    /// HV-L3, CKS-L3-pinv over a field: it exists iff rank P = rank PPᵀ = rank PᵀP, and obeys the four equations.
    ///
    /// Domain: all 2×2 matrices modulo 5.
    pseudo_inverse_modulo_5, unwind 10, Replays::All(625),
    covers ["exists at rank 1", "exists at rank 2", "does not exist"], {
        let p = matrix::<5>(2, 2);
        let inverse = checked(&p);
        cover!(inverse.is_some() && rank_by_minors(&p) == 1, "exists at rank 1");
        cover!(inverse.is_some() && rank_by_minors(&p) == 2, "exists at rank 2");
        cover!(inverse.is_none(), "does not exist");
    }
}
