//! Lemma 4.1 on all small integer positive semidefinite matrices of order 2.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};

use crate::minors::{adjugate, determinant, principal, rank};
use crate::worlds::symmetric;

type Q = Matrix<Rational>;

fn is_semidefinite(p: &Q) -> bool {
    (1..=p.rows()).all(|order| principal(p, order).iter().all(|minor| *minor >= ratio(0, 1)))
}

/// All positive semidefinite matrices of order 2 with integer entries of at most `bound`.
fn world(bound: i64) -> Vec<Q> {
    let entries: Vec<_> = (-bound..=bound).map(|entry| ratio(entry, 1)).collect();
    symmetric(2, &entries).filter(is_semidefinite).collect()
}

/// The pseudo-inverse of a semidefinite matrix of order 2: by the adjugate if it is regular, P/(tr P)² if its rank is one.
fn pseudo_inverse(p: &Q) -> Q {
    let (determinant, trace) = (determinant(p), &p[(0, 0)] + &p[(1, 1)]);
    let zero = ratio(0, 1);
    if determinant != zero {
        adjugate(p).scaled(&determinant.recip())
    } else if trace != zero {
        p.scaled(&(&trace * &trace).recip())
    } else {
        Matrix::zeros(2, 2)
    }
}

fn sum(f: &Q, g: &Q) -> Q {
    f.parallel_sum(g).unwrap_or_else(|error| panic!("{f} and {g}: {error}"))
}

/// AK-Par, AK-L4.1, AK-L4.1ii, AK-L4.1iv, AK-Par-inverse: every pair, singular ones included, by the formula written out.
#[test]
fn parallel_sums_of_all_pairs() {
    let world = world(3);
    let mut counts = [0; 3];
    for f in &world {
        for g in &world {
            let (found, total) = (sum(f, g), f + g);
            let inverse = pseudo_inverse(&total);
            assert_eq!(found, f * &inverse * g, "{f} and {g}");
            assert_eq!(found, g * &inverse * f);
            assert_eq!(found, f - f * &inverse * f);
            assert_eq!(found, g - g * &inverse * g);
            assert!(is_semidefinite(&found) && is_semidefinite(&(f - &found)) && is_semidefinite(&(g - &found)));
            // The kernel of F:G is ker F + ker G: its range is the common part of both ranges.
            let common = rank(f) + rank(g) - rank(&f.beside(g));
            assert_eq!(rank(&found), common, "{f} and {g}");
            if rank(f) == 2 && rank(g) == 2 {
                let [f, g] = [f, g].map(|p| adjugate(p).scaled(&determinant(p).recip()));
                assert_eq!(found * (f + g), Matrix::identity(2));
            }
            counts[rank(&total)] += 1;
        }
    }
    assert_eq!(counts.iter().sum::<usize>(), 44 * 44);
    assert!(counts[1] > 50 && counts[2] > 1000, "{counts:?}");
}

/// AK-L4.1iii: every triple F ≤ H, G.
#[test]
fn parallel_sums_are_monotone_on_all_triples() {
    let world = world(2);
    assert_eq!(world.len(), 19);
    let mut count = 0;
    for f in &world {
        for h in world.iter().filter(|h| is_semidefinite(&(*h - f))) {
            for g in &world {
                assert!(is_semidefinite(&(sum(h, g) - sum(f, g))), "{f} ≤ {h}, {g}");
                count += 1;
            }
        }
    }
    assert!(count > 1500, "{count}");
}
