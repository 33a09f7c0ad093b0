//! Lemma 4.1 on small integer positive semidefinite matrices, singular ones above all, and the formula modulo primes.

use exact_kalman::matrix::{Matrix, PseudoInverseError};
use exact_kalman::scalar::{Field, Rational, Residue, ratio};

use crate::minors::{determinant, inverse, is_semidefinite, pseudo_inverse, rank, schur_complement};
use crate::worlds::{covariances, residues, symmetric};

type Q = Matrix<Rational>;

fn sum(f: &Q, g: &Q) -> Q {
    f.parallel_sum(g).unwrap_or_else(|error| panic!("{f} and {g}: {error}"))
}

/// AK-Par, AK-L4.1, AK-L4.1ii, AK-L4.1iv, AK-Par-inverse: every pair, singular ones included, by the formula written out.
///
/// Domain: all pairs of positive semidefinite 2×2 matrices over {−3, …, 3}.
#[test]
fn parallel_sums_of_all_pairs() {
    let world = covariances(2, 3);
    let mut counts = [0; 3];
    for f in &world {
        for g in &world {
            let (found, total) = (sum(f, g), f + g);
            let middle = pseudo_inverse(&total);
            assert_eq!(found, f * &middle * g, "{f} and {g}");
            assert_eq!(found, g * &middle * f);
            assert_eq!(found, f - f * &middle * f);
            assert_eq!(found, g - g * &middle * g);
            assert!(is_semidefinite(&found) && is_semidefinite(&(f - &found)) && is_semidefinite(&(g - &found)));
            // The kernel of F:G is ker F + ker G: its range is the common part of both ranges.
            let common = rank(f) + rank(g) - rank(&f.beside(g));
            assert_eq!(rank(&found), common, "{f} and {g}");
            if rank(f) == 2 && rank(g) == 2 {
                let [f, g] = [f, g].map(inverse);
                assert_eq!(found * (f + g), Matrix::identity(2));
            }
            counts[rank(&total)] += 1;
        }
    }
    assert_eq!(counts.iter().sum::<usize>(), 44 * 44);
    assert!(counts[1] > 50 && counts[2] > 1000, "{counts:?}");
}

/// AK-L4.1iii: every triple F ≤ H, G.
///
/// Domain: all triples F ≤ H, G of positive semidefinite 2×2 matrices over {−2, …, 2}.
#[test]
fn parallel_sums_are_monotone_on_all_triples() {
    let world = covariances(2, 2);
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
    // 80 pairs F ≤ H.
    assert_eq!(count, 80 * 19);
}

/// AK-Par, AK-L4.1ii, AK-L4.1iv: F:G is the Schur complement of F + G in [[F, F], [F, F + G]], entry by entry a quotient of
/// minors, also where F + G is singular.
///
/// Domain: all pairs of positive semidefinite 3×3 matrices over {−1, 0, 1}.
#[test]
fn parallel_sums_of_order_three_are_schur_complements() {
    let world = covariances(3, 1);
    let mut counts = [0; 4];
    for f in &world {
        for g in &world {
            let total = f + g;
            let whole = f.beside(f).above(&f.beside(&total));
            let expected = schur_complement(&whole, &[0, 1, 2], &[3, 4, 5]);
            assert_eq!(sum(f, g), expected, "{f} and {g}");
            assert!(is_semidefinite(&expected) && is_semidefinite(&(f - &expected)));
            assert_eq!(expected, sum(g, f));
            counts[rank(&total)] += 1;
        }
    }
    assert_eq!(counts.iter().sum::<usize>(), 24 * 24);
    assert!(counts[1] > 10 && counts[2] > 200 && counts[3] > 200, "{counts:?}");
}

/// AK-L4.1i, with its modulus: where F + G > 0 and both are raised by at most εI, F:G rises, by at most ε(GM²G + FM²F).
///
/// Domain: all pairs of positive semidefinite 2×2 matrices over {−2, …, 2} with a regular sum, ε = 1, 1/8, 1/64.
#[test]
fn parallel_sums_move_no_farther_than_their_modulus() {
    let world = covariances(2, 2);
    let mut counts = [0; 2];
    for (f, g) in world.iter().flat_map(|f| world.iter().map(move |g| (f, g))) {
        let total = f + g;
        if determinant(&total) == ratio(0, 1) {
            counts[0] += 1;
            continue;
        }
        let inverse = inverse(&total);
        let (left, right) = (&inverse * f, &inverse * g);
        let modulus = left.transpose() * &left + right.transpose() * &right;
        for epsilon in [1, 8, 64].map(|parts| ratio(1, parts)) {
            let raised = Q::identity(2).scaled(&epsilon);
            let risen = sum(&(f + &raised), &(g + &raised)) - sum(f, g);
            assert!(is_semidefinite(&risen) && is_semidefinite(&(modulus.scaled(&epsilon) - risen)), "{f} and {g}");
        }
        counts[1] += 1;
    }
    assert_eq!(counts[0] + counts[1], 19 * 19);
    assert!(counts[0] > 20 && counts[1] > 200, "{counts:?}");
}

/// F(F + G)⁺G of every pair of symmetric matrices, with (F + G)⁺ by trying all matrices; how many have none, one at a singular
/// sum, and one at a regular sum.
fn modulo<const P: u64>() -> [usize; 3] {
    let symmetric: Vec<Matrix<Residue<P>>> = symmetric(2, &residues::<P>()).collect();
    // S⁺ is symmetric where S is: trying the symmetric ones is enough.
    let obeys = |s: &Matrix<Residue<P>>, x: &Matrix<Residue<P>>| {
        s * x * s == *s && x * s * x == *x && (s * x).asymmetry().is_none() && (x * s).asymmetry().is_none()
    };
    let tried: Vec<_> = symmetric.iter().map(|s| (s, symmetric.iter().find(|x| obeys(s, x)))).collect();
    let mut counts = [0; 3];
    for (f, g) in symmetric.iter().flat_map(|f| symmetric.iter().map(move |g| (f, g))) {
        let total = f + g;
        let Some((_, inverse)) = tried.iter().find(|(s, _)| **s == total) else { panic!("sums are symmetric") };
        match (f.parallel_sum(g), inverse) {
            (Ok(found), Some(inverse)) => {
                assert_eq!(found, f * *inverse * g, "{f:?} and {g:?}");
                let regular = !determinant(&total).is_zero();
                if regular {
                    assert!(found == g * *inverse * f && found == f - f * *inverse * f);
                }
                counts[1 + usize::from(regular)] += 1;
            }
            (Err(PseudoInverseError::DoesNotExist { .. }), None) => counts[0] += 1,
            (found, inverse) => panic!("{f:?} and {g:?}: {found:?}, but {inverse:?}"),
        }
    }
    counts
}

/// AK-Par, AK-L4.1ii, AK-L4.1iv over fields: the formula with a pseudo-inverse that is found by trying; where F + G is regular it is
/// symmetric in F and G, and F − F(F + G)⁻¹F.
///
/// Domain: all pairs of symmetric 2×2 matrices modulo 3 and 5.
#[test]
fn parallel_sums_modulo_primes() {
    let counts = [modulo::<3>(), modulo::<5>()];
    assert_eq!(counts.map(|counts| counts.iter().sum::<usize>()), [27 * 27, 125 * 125]);
    assert_eq!(counts[0][0], 0, "modulo 3 every symmetric 2×2 matrix has a pseudo-inverse");
    assert!(counts[1].iter().all(|&count| count > 500), "{counts:?}");
}
