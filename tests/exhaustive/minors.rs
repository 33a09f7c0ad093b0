//! Determinants by Laplace's expansion, and what they say about rank, inverse and definiteness.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Field, OrderedField, Scalar};

/// The determinant, expanded along the first row; one for the 0×0 matrix.
pub fn determinant<S: Scalar>(a: &Matrix<S>) -> S {
    let n = a.rows();
    if n == 0 {
        return S::one();
    }
    let rest: Vec<usize> = (1..n).collect();
    (0..n).fold(S::zero(), |sum, j| {
        let others: Vec<usize> = (0..n).filter(|&column| column != j).collect();
        let term = a[(0, j)].times(&determinant(&a.select(&rest, &others)));
        if j % 2 == 0 { sum.plus(&term) } else { sum.minus(&term) }
    })
}

/// All choices of `count` out of `0..n`.
pub fn choices(n: usize, count: usize) -> Vec<Vec<usize>> {
    let chosen = |code: usize| (0..n).filter(|i| code >> i & 1 == 1).collect::<Vec<_>>();
    (0..1 << n).map(chosen).filter(|choice| choice.len() == count).collect()
}

/// The order of the largest minor that is not zero.
pub fn rank<S: Field>(a: &Matrix<S>) -> usize {
    let has = |order: usize| {
        let columns = choices(a.columns(), order);
        choices(a.rows(), order)
            .iter()
            .any(|rows| columns.iter().any(|columns| !determinant(&a.select(rows, columns)).is_zero()))
    };
    (0..=a.rows().min(a.columns())).rev().find(|&order| has(order)).unwrap_or(0)
}

/// The principal minors of an order.
pub fn principal<S: Scalar>(a: &Matrix<S>, order: usize) -> Vec<S> {
    choices(a.rows(), order).iter().map(|choice| determinant(&a.select(choice, choice))).collect()
}

/// Positive semidefinite: all principal minors are nonnegative, not only the leading ones.
pub fn is_semidefinite<S: OrderedField>(p: &Matrix<S>) -> bool {
    (1..=p.rows()).all(|order| principal(p, order).iter().all(|minor| *minor >= S::zero()))
}

/// The adjugate: A · adj A = det A · I.
pub fn adjugate<S: Scalar>(a: &Matrix<S>) -> Matrix<S> {
    let without = |i: usize| (0..a.rows()).filter(|&k| k != i).collect::<Vec<_>>();
    Matrix::from_fn(a.rows(), a.rows(), |i, j| {
        let minor = determinant(&a.select(&without(j), &without(i)));
        if (i + j) % 2 == 0 { minor } else { minor.negated() }
    })
}

/// The inverse by the adjugate.
pub fn inverse<S: Field>(a: &Matrix<S>) -> Matrix<S> {
    let determinant = determinant(a);
    adjugate(a).map(|entry| entry.over(&determinant).unwrap_or_else(|_| panic!("{a:?} is singular")))
}

/// The pseudo-inverse of a matrix with at most two rows or columns, by a formula for each rank.
pub fn pseudo_inverse<S: OrderedField>(p: &Matrix<S>) -> Matrix<S> {
    let transposed = p.transpose();
    match rank(p) {
        0 => transposed,
        1 => {
            let squares = p.entries().iter().fold(S::zero(), |sum, entry| sum.plus(&entry.times(entry)));
            transposed.map(|entry| entry.over(&squares).unwrap_or_else(|_| panic!("{p:?} is not zero")))
        }
        r if r == p.rows() => &transposed * inverse(&(p * &transposed)),
        r => {
            assert_eq!(r, p.columns(), "a formula is missing");
            inverse(&(&transposed * p)) * transposed
        }
    }
}

/// The generalised Schur complement `A − B D⁻ C` of a matrix [[A, B], [C, D]] with a symmetric D, the rows of C and the columns of B in
/// the range of D, by quotients of minors: det [[aᵢⱼ, bᵢ], [cⱼ, D]] / det D, D cut down to rows and columns that are
/// independent and as many as its rank.
pub fn schur_complement<S: Field>(whole: &Matrix<S>, kept: &[usize], removed: &[usize]) -> Matrix<S> {
    let parts = (0..=removed.len()).rev().flat_map(|count| choices(removed.len(), count));
    let mut regular = parts.filter_map(|choice| {
        let part: Vec<usize> = choice.iter().map(|&i| removed[i]).collect();
        let minor = determinant(&whole.select(&part, &part));
        (!minor.is_zero()).then_some((part, minor))
    });
    // The empty part has the minor 1.
    let Some((part, minor)) = regular.next() else { unreachable!() };
    let with = |i: usize| [&[i], part.as_slice()].concat();
    Matrix::from_fn(kept.len(), kept.len(), |i, j| {
        let bordered = determinant(&whole.select(&with(kept[i]), &with(kept[j])));
        bordered.over(&minor).unwrap_or_else(|error| panic!("{error}"))
    })
}

#[test]
fn the_expansion_knows_a_determinant_by_heart() {
    use exact_kalman::scalar::{Rational, ratio};
    let a = Matrix::<Rational>::from_integers(&[[2, -3, 1], [2, 0, -1], [1, 4, 5]]);
    assert_eq!(determinant(&a), ratio(49, 1));
    assert_eq!(&a * adjugate(&a), Matrix::identity(3).scaled(&ratio(49, 1)));
    assert_eq!(choices(4, 2).len(), 6);
}

#[test]
fn schur_complements_by_hand() {
    use exact_kalman::scalar::{Rational, ratio};
    let p = Matrix::<Rational>::from_integers(&[[2, 1, 0], [1, 2, 1], [0, 1, 2]]);
    // 2 − 1·(1/2)·1, and 0 − 1·(1/2)·1 off the diagonal.
    let expected = Matrix::from_rows(vec![vec![ratio(3, 2), ratio(-1, 2)], vec![ratio(-1, 2), ratio(3, 2)]]);
    assert_eq!(Ok(schur_complement(&p, &[0, 2], &[1])), expected);
    // D = (1, 1; 1, 1): either reading serves. 1 − 1·1·1.
    let ones = Matrix::<Rational>::from_integers(&[[1, 1, 1], [1, 1, 1], [1, 1, 1]]);
    assert_eq!(schur_complement(&ones, &[0], &[1, 2]), Matrix::zeros(1, 1));
    assert_eq!(pseudo_inverse(&ones.block(0..2, 0..2)), Matrix::from_fn(2, 2, |_, _| ratio(1, 4)));
}
