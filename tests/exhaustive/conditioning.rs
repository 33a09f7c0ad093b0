//! CKS-L3i and CKS-L3ii on all small laws, singular ones above all: against quotients of minors and the normal equations.

use exact_kalman::gaussian::{ConditionError, Gaussian};
use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, Residue, ratio};

use crate::minors::{is_semidefinite, rank, schur_complement};
use crate::worlds::{self, matrices, residues, signs, symmetric};

type Q = Matrix<Rational>;

/// What was met.
#[derive(Default, Debug)]
struct Census {
    regular: usize,
    singular: usize,
    zero: usize,
    refused: usize,
}

/// The positive semidefinite matrices of order 3: all with entries −2, …, 2, and all L Lᵀ with L of size 3×2 over {−1, 0, 1}.
fn covariances() -> Vec<Q> {
    let mut all = worlds::covariances(3, 2);
    all.extend(matrices(3, 2, &signs()).map(|factor| &factor * factor.transpose()));
    all.sort_by_key(|p| p.entries().to_vec());
    all.dedup();
    all
}

/// P_xy P_yy⁻ ν, what a regression adds to the mean: 0 − [0, P_xy; ν, P_yy] / P_yy, of any square shape.
fn regression(xy: &Q, yy: &Q, innovation: &Q) -> Q {
    let (hidden, size) = (xy.rows(), yy.rows());
    let spread = innovation * Matrix::from_fn(1, hidden, |_, _| ratio(1, 1));
    let bordered = Matrix::zeros(hidden, hidden).beside(xy).above(&spread.beside(yy));
    let (kept, removed): (Vec<usize>, Vec<usize>) = (0..hidden + size).partition(|&i| i < hidden);
    -schur_complement(&bordered, &kept, &removed).select_columns(&[0])
}

fn check(p: &Q, observed: &[usize], innovation: &Q, census: &mut Census) {
    let mean = Matrix::column(vec![ratio(1, 1), ratio(-1, 2), ratio(2, 1)]);
    let law = Gaussian::new(mean.clone(), p.clone()).unwrap_or_else(|error| panic!("{error}"));
    let values = innovation + mean.select_rows(observed);
    let yy = p.select(observed, observed);
    let consistent = rank(&yy.beside(innovation)) == rank(&yy);
    let hidden: Vec<usize> = (0..3).filter(|i| !observed.contains(i)).collect();
    let given = match law.conditioned(observed, &values) {
        Ok(given) => given,
        Err(ConditionError::Inconsistent(proof)) => {
            assert!(!consistent, "{p} given {observed:?} = {values}");
            assert!((&yy * &proof.direction).is_zero());
            let value = (proof.direction.transpose() * innovation)[(0, 0)].clone();
            assert!(value != ratio(0, 1) && value == proof.value);
            census.refused += 1;
            return;
        }
        Err(error) => panic!("{p} given {observed:?}: {error}"),
    };
    assert!(consistent, "{p} given {observed:?} = {values} has probability zero");
    assert_eq!(&given.gain * &yy, p.select(&hidden, observed), "the normal equations");
    assert_eq!((&given.innovation, &given.innovation_covariance), (innovation, &yy));
    // The gain that is zero on the kernel of P_yy.
    assert_eq!(rank(&yy.above(&given.gain)), rank(&yy), "{p} given {observed:?}");
    let expected = mean.select_rows(&hidden) + regression(&p.select(&hidden, observed), &yy, innovation);
    assert_eq!(*given.law.mean(), expected, "{p} given {observed:?} = {values}");
    assert_eq!(*given.law.covariance(), schur_complement(p, &hidden, observed), "{p} given {observed:?}");
    assert!(is_semidefinite(given.law.covariance()));
    if rank(&yy) == observed.len() {
        census.regular += 1;
    } else if yy.is_zero() {
        census.zero += 1;
    } else {
        census.singular += 1;
    }
}

/// CKS-L3i, CKS-L3ii, HV-L3-mean, HV-L3-cov: mean and covariance as quotients of minors, K P_yy = P_xy (so nothing is left of
/// P_xy) with K zero on the kernel of P_yy, semidefinite results and refusals.
///
/// Domain: all 3×3 covariances over {−2, …, 2} and all LLᵀ, L 3×2 over {−1, 0, 1}; one or two entries observed (four choices), ν over {−1, 0, 1}.
#[test]
fn conditioning_is_regression_on_a_basis_of_what_is_observed() {
    let covariances = covariances();
    assert_eq!(covariances.len(), COVARIANCES);
    let mut census = Census::default();
    let mut asked = 0;
    for p in &covariances {
        for observed in [&[2][..], &[0], &[1, 2], &[2, 0]] {
            for innovation in matrices(observed.len(), 1, &signs()) {
                check(p, observed, &innovation, &mut census);
                asked += 1;
            }
        }
    }
    assert_eq!(census.regular + census.singular + census.zero + census.refused, asked);
    assert_eq!(asked, covariances.len() * (3 + 3 + 9 + 9));
    assert!(census.regular > 1000 && census.singular > 100 && census.zero > 10 && census.refused > 500, "{census:?}");
}

/// How many covariances there are in that world.
const COVARIANCES: usize = 241;

/// What was met: given, given with P_xy outside the range of P_yy (as for no covariance), refused, without a pseudo-inverse.
fn searched<const P: u64>() -> [usize; 4] {
    let vectors: Vec<Matrix<Residue<P>>> = matrices(2, 1, &residues::<P>()).collect();
    let mut counts = [0; 4];
    for p in symmetric(3, &residues::<P>()) {
        let law = Gaussian::new(Matrix::zeros(3, 1), p.clone()).unwrap_or_else(|error| panic!("{error}"));
        let (yy, yx) = (p.select(&[1, 2], &[1, 2]), p.select(&[1, 2], &[0]));
        let images: Vec<_> = vectors.iter().map(|vector| &yy * vector).collect();
        let gains: Vec<_> = vectors.iter().zip(&images).filter(|(_, image)| **image == yx).map(|(k, _)| k).collect();
        let exists = rank(&(&yy * &yy)) == rank(&yy);
        for innovation in &vectors {
            let consistent = images.contains(innovation);
            match law.conditioned(&[1, 2], innovation) {
                Ok(given) => {
                    assert!(exists && consistent, "{p:?} at {innovation:?}");
                    for gain in &gains {
                        let gain = gain.transpose();
                        assert_eq!(*given.law.mean(), &gain * innovation, "{p:?} at {innovation:?}");
                        assert_eq!(*given.law.covariance(), p.select(&[0], &[0]) - gain * &yx, "{p:?}");
                    }
                    counts[usize::from(gains.is_empty())] += 1;
                }
                Err(ConditionError::Inconsistent(proof)) => {
                    assert!(exists && !consistent && (&yy * &proof.direction).is_zero(), "{p:?} at {innovation:?}");
                    // A vector that is not zero may be orthogonal to itself.
                    assert!(!proof.direction.is_zero(), "{p:?} at {innovation:?}");
                    assert_eq!(proof.direction.transpose() * innovation, Matrix::column(vec![proof.value]));
                    counts[2] += 1;
                }
                Err(ConditionError::PseudoInverse(_)) => {
                    assert!(!exists, "{p:?}");
                    counts[3] += 1;
                }
                Err(ConditionError::Diffuse) => panic!("nothing is diffuse"),
            }
        }
    }
    counts
}

/// CKS-L3i over fields: every K with K P_yy = P_xy, found by trying all, gives the mean and the covariance that are found; data
/// outside the range of P_yy are refused, and so is P_yy where rank P_yy² < rank P_yy.
///
/// Domain: all symmetric 3×3 matrices modulo 3 and 5, the last two entries observed with every innovation.
#[test]
fn conditioning_over_fields_is_what_every_gain_says() {
    let counts = [searched::<3>(), searched::<5>()];
    assert_eq!(counts.map(|counts| counts.iter().sum::<usize>()), [729 * 9, 15_625 * 25]);
    assert!(counts[0][..3].iter().all(|&count| count > 400) && counts[0][3] == 0, "{counts:?}");
    assert!(counts[1].iter().all(|&count| count > 5000), "{counts:?}");
}

/// Nothing is observed: nothing changes.
#[test]
fn an_empty_observation_says_nothing() {
    let covariances = covariances();
    for p in &covariances {
        let law = Gaussian::new(Matrix::zeros(3, 1), p.clone()).unwrap_or_else(|error| panic!("{error}"));
        let given = law.conditioned(&[], &Matrix::zeros(0, 1)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(given.law, law);
    }
    assert!(!covariances.is_empty());
}

#[test]
fn a_regression_by_hand() {
    let xy = Matrix::<Rational>::from_integers(&[[1, 0], [4, 2]]);
    let yy = Matrix::from_integers(&[[2, 1], [1, 1]]);
    // P_yy⁻¹ = [[1, −1], [−1, 2]] takes (3, 1) to (2, −1).
    assert_eq!(regression(&xy, &yy, &Matrix::from_integers(&[[3], [1]])), Matrix::from_integers(&[[2], [6]]));
}
