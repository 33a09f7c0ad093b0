//! CKS-L3i and CKS-L3ii on all small laws, singular ones above all: against quotients of minors and the normal equations.

use exact_kalman::gaussian::{ConditionError, Gaussian};
use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, Scalar, ratio};

use crate::minors::{choices, determinant, principal, rank};
use crate::worlds::{matrices, signs, symmetric};

type Q = Matrix<Rational>;

/// What was met.
#[derive(Default, Debug)]
struct Census {
    regular: usize,
    singular: usize,
    zero: usize,
    refused: usize,
}

/// The positive semidefinite matrices of order 3: all with entries −1, 0, 1, and all L Lᵀ of rank at most 2.
fn covariances() -> Vec<Q> {
    let semidefinite = |p: &Q| (1..=3).all(|order| principal(p, order).iter().all(|minor| *minor >= ratio(0, 1)));
    let signs = signs();
    let small = symmetric(3, &signs).filter(semidefinite);
    let mut all: Vec<Q> = small.chain(matrices(3, 2, &signs).map(|factor| &factor * factor.transpose())).collect();
    all.sort_by_key(|p| p.entries().to_vec());
    all.dedup();
    all
}

/// A largest independent part of the observed entries: no larger minor of their covariance is nonzero.
fn basis(p: &Q, observed: &[usize]) -> Vec<usize> {
    let parts = (0..=observed.len()).rev().flat_map(|count| choices(observed.len(), count));
    let part = |choice: Vec<usize>| choice.iter().map(|&i| observed[i]).collect::<Vec<_>>();
    let regular = |part: &Vec<usize>| determinant(&p.select(part, part)) != ratio(0, 1);
    parts.map(part).find(regular).unwrap_or_default()
}

/// The quotient of minors det P[i∪b, j∪b] / det P[b, b]: the Schur complement of a regular block, entry by entry.
fn schur(p: &Q, block: &[usize], i: usize, j: usize) -> Rational {
    let with = |extra: usize| [&[extra], block].concat();
    determinant(&p.select(&with(i), &with(j))) / determinant(&p.select(block, block))
}

/// E(xᵢ) + (its regression on the block), by the same quotient with the innovations as one more column.
fn regressed(p: &Q, mean: &Q, block: &[usize], innovation: impl Fn(usize) -> Rational, i: usize) -> Rational {
    let size = block.len();
    // det [0, P[i, b]; ν, P[b, b]] = −P[i, b] adj(P[b, b]) ν
    let bordered = Matrix::from_fn(size + 1, size + 1, |row, column| match (row, column) {
        (0, 0) => ratio(0, 1),
        (0, column) => p[(i, block[column - 1])].clone(),
        (row, 0) => innovation(block[row - 1]),
        (row, column) => p[(block[row - 1], block[column - 1])].clone(),
    });
    &mean[(i, 0)] - determinant(&bordered) / determinant(&p.select(block, block))
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
    let block = basis(p, observed);
    let place = |i: usize| observed.iter().position(|&entry| entry == i).unwrap_or_default();
    for (row, &i) in hidden.iter().enumerate() {
        let expected = regressed(p, &mean, &block, |k| innovation[(place(k), 0)].clone(), i);
        assert_eq!(given.law.mean()[(row, 0)], expected, "{p} given {observed:?} = {values}");
        for (column, &j) in hidden.iter().enumerate() {
            assert_eq!(given.law.covariance()[(row, column)], schur(p, &block, i, j), "{p} given {observed:?}");
        }
    }
    assert!(given.law.definiteness().is_ok());
    if block.len() == observed.len() {
        census.regular += 1;
    } else if yy.is_zero() {
        census.zero += 1;
    } else {
        census.singular += 1;
    }
}

/// CKS-L3i, CKS-L3ii: mean and covariance as quotients of minors, K P_yy = P_xy (so nothing is left of P_xy), psd results and
/// refusals, on all small covariances, singular ones above all.
#[test]
fn conditioning_is_regression_on_a_basis_of_what_is_observed() {
    let covariances = covariances();
    assert!(covariances.len() > 100, "{}", covariances.len());
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
    println!("{census:?}");
    assert_eq!(census.regular + census.singular + census.zero + census.refused, asked);
    assert_eq!(asked, covariances.len() * (3 + 3 + 9 + 9));
    assert!(census.regular > 1000 && census.singular > 100 && census.zero > 10 && census.refused > 500, "{census:?}");
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
fn a_quotient_of_minors_is_a_schur_complement() {
    let p = Matrix::<Rational>::from_integers(&[[2, 1, 0], [1, 2, 1], [0, 1, 2]]);
    // 2 − 1·(1/2)·1
    assert_eq!(schur(&p, &[1], 0, 0), ratio(3, 2));
    assert_eq!(schur(&p, &[1], 0, 2), ratio(-1, 2).times(&ratio(1, 1)));
    assert_eq!(regressed(&p, &Matrix::zeros(3, 1), &[1], |_| ratio(1, 1), 0), ratio(1, 2));
}
