//! Covariances over fractions of fixed width: pseudo-inverse, verdicts and the symmetric update.

use exact_kalman::matrix::{Ldl, LdlError, Matrix};
use exact_kalman::riccati::RiccatiMap;
use exact_kalman::scalar::Scalar;

use crate::harness::{Replays, below, cover, harness};
use crate::ratio::{Ratio, covariance, integer, is_semidefinite, square};

harness! {
    /// HV-L3, CKS-L3-pinv: the four equations of Penrose, over the same code with numbers of fixed width.
    ///
    /// Domain: all 2×2 matrices over {−2, …, 2}.
    pseudo_inverse_of_fixed_width, unwind 94, Replays::All(625), covers ["zero", "singular", "regular"], {
        let p = square(2);
        let Ok(x) = p.pseudo_inverse() else { panic!("no fraction is orthogonal to itself") };
        assert!(&p * &x * &p == p && &x * &p * &x == x);
        assert!((&p * &x).transpose() == &p * &x && (&x * &p).transpose() == &x * &p);
        let minor = p[(0, 0)].times(&p[(1, 1)]).minus(&p[(0, 1)].times(&p[(1, 0)]));
        cover!(p.is_zero(), "zero");
        cover!(minor == Ratio::zero() && !p.is_zero(), "singular");
        cover!(minor != Ratio::zero(), "regular");
    }
}

harness! {
    /// AK-Order, for G = 0: the verdict is that of the minors, and a refusal comes with vᵀFv < 0.
    ///
    /// Domain: all symmetric 2×2 matrices over {−4, …, 4}.
    verdicts_of_fixed_width, unwind 94, Replays::All(729),
    covers ["semidefinite", "definite", "a pivot below zero", "a zero pivot beside an entry"], {
        let [a, b, c] = [(); 3].map(|()| integer(4));
        let p = Matrix::from_fn(2, 2, |i, j| if i != j { b } else if i == 0 { a } else { c }.into());
        let verdict = p.ldl();
        assert!(verdict.is_ok() == is_semidefinite(&p));
        cover!(verdict.as_ref().is_ok_and(|ldl| !ldl.is_positive_definite()), "semidefinite");
        cover!(verdict.as_ref().is_ok_and(Ldl::is_positive_definite), "definite");
        cover!(a < 0, "a pivot below zero");
        cover!(a == 0 && b != 0, "a zero pivot beside an entry");
        if let Err(error) = verdict {
            let LdlError::Indefinite(proof) = error else { panic!("it is symmetric") };
            let v = |i: usize| &proof.witness[(i, 0)];
            let term = |entry: i32, i: usize, j: usize| v(i).times(&Ratio::from(entry)).times(v(j));
            let value = term(a, 0, 0).plus(&term(2 * b, 0, 1)).plus(&term(c, 1, 1));
            assert!(value == proof.value && value < Ratio::zero());
        }
    }
}

harness! {
    /// AK-1.4a, AK-1.4b, AK-1.4c: P(k) = (I − Δ(k))S(k) is symmetric, positive semidefinite and at most S(k), and Δ(k) solves
    /// Δ(S + W) = S.
    ///
    /// Domain: all 2×2 matrices A over {−1, 0, 1}, all P, W ≥ 0 of size 2×2 over {−2, …, 2}, V = 0 or I.
    updates_are_symmetric_and_below_the_prior, unwind 94, Replays::All(81 * 19 * 19 * 2),
    covers ["regular", "singular", "everything is known", "off the diagonal"], {
        let (a, last, noise) = (square(1), covariance(2), covariance(2));
        let v = if below(2) == 0 { Matrix::zeros(2, 2) } else { Matrix::identity(2) };
        let Ok(map) = RiccatiMap::new(a.clone(), v.clone(), noise.clone()) else { panic!("V and W are covariances") };
        let step = map.step(&last);
        // A P Aᵀ + V, entry by entry.
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let mut entry = v[(i, j)];
            for (k, l) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                entry = entry.plus(&a[(i, k)].times(&last[(k, l)]).times(&a[(j, l)]));
            }
            assert!(step.predicted[(i, j)] == entry);
        }
        let total = &step.predicted + &noise;
        assert!(&step.gain * &total == step.predicted);
        assert!(step.filtered == (Matrix::identity(2) - &step.gain) * &step.predicted);
        assert!(is_semidefinite(&step.filtered) && is_semidefinite(&(&step.predicted - &step.filtered)));
        let minor = total[(0, 0)].times(&total[(1, 1)]).minus(&total[(0, 1)].times(&total[(1, 0)]));
        cover!(minor != Ratio::zero(), "regular");
        cover!(minor == Ratio::zero() && !total.is_zero(), "singular");
        cover!(total.is_zero(), "everything is known");
        cover!(step.filtered[(0, 1)] != Ratio::zero(), "off the diagonal");
    }
}
