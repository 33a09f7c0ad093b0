//! Random matrices for property tests; a failure shrinks to small integers.

use exact_kalman::matrix::Matrix;
use exact_kalman::riccati::RiccatiMap;
use exact_kalman::scalar::{Rational, ratio};
use proptest::collection::vec;
use proptest::prelude::*;

pub type Q = Matrix<Rational>;

pub fn integers<const C: usize>(rows: &[[i64; C]]) -> Q {
    Matrix::from_integers(rows)
}

pub fn scalar(value: Rational) -> Q {
    Matrix::column(vec![value])
}

pub fn number(matrix: &Q) -> Rational {
    assert_eq!((matrix.rows(), matrix.columns()), (1, 1));
    matrix[(0, 0)].clone()
}

/// The map, of matrices that are fit for one.
pub fn map(a: &Q, v: &Q, w: &Q) -> RiccatiMap<Rational> {
    RiccatiMap::new(a.clone(), v.clone(), w.clone()).unwrap_or_else(|error| panic!("a valid map: {error}"))
}

pub fn inverse(matrix: &Q) -> Q {
    matrix.inverse().unwrap_or_else(|error| panic!("{matrix}: {error}"))
}

pub fn parallel_sum(f: &Q, g: &Q) -> Q {
    f.parallel_sum(g).unwrap_or_else(|error| panic!("{f} and {g}: {error}"))
}

pub fn is_semidefinite(matrix: &Q) -> bool {
    matrix.ldl().is_ok()
}

pub fn is_definite(matrix: &Q) -> bool {
    matrix.ldl().is_ok_and(|ldl| ldl.is_positive_definite())
}

/// a ≤ b
pub fn le(a: &Q, b: &Q) -> bool {
    is_semidefinite(&(b - a))
}

pub fn power(matrix: &Q, exponent: usize) -> Q {
    (0..exponent).fold(Matrix::identity(matrix.rows()), |power, _| power * matrix)
}

/// Entries are fractions with numerators up to `bound` and denominators up to 3.
pub fn matrices(rows: usize, columns: usize, bound: i64) -> impl Strategy<Value = Q> {
    vec((-bound..=bound, 1i64..=3), rows * columns).prop_map(move |entries| {
        Matrix::from_fn(rows, columns, |i, j| {
            let (numerator, denominator) = entries[i * columns + j];
            ratio(numerator, denominator)
        })
    })
}

/// Positive semidefinite of any rank.
pub fn semidefinite(n: usize) -> impl Strategy<Value = Q> {
    (0..=n).prop_flat_map(move |rank| matrices(n, rank, 3)).prop_map(|factor| &factor * factor.transpose())
}

/// Positive definite, at times nearly singular.
pub fn definite(n: usize) -> impl Strategy<Value = Q> {
    (semidefinite(n), 1i64..=8).prop_map(move |(p, floor)| p + Matrix::identity(n).scaled(&ratio(1, floor * floor)))
}

/// A map with V > 0 and its fixed point, known by construction: V = T − A(T:W)Aᵀ, where that is positive definite.
#[derive(Clone, Debug)]
pub struct Constructed {
    pub a: Q,
    pub v: Q,
    pub w: Q,
    pub t: Q,
}

/// T:W by elimination, without the crate's parallel sum or pseudo-inverse; with it the fixed point is known without φ.
pub fn constructed(n: usize) -> impl Strategy<Value = Constructed> {
    (matrices(n, n, 4), semidefinite(n), definite(n)).prop_filter_map("V > 0", |(a, w, t)| {
        let v = &t - a.congruence(&shorted(&t, &w));
        is_definite(&v).then_some(Constructed { a, v, w, t })
    })
}

/// F:G by eliminating the first half of [[F + G, F], [F, F]]: what is left below is the parallel sum.
///
/// `xᵀ(F:G)x` is the least value of `yᵀFy + (x − y)ᵀG(x − y)`, that is of `zᵀ(F + G)z + 2zᵀFx + xᵀFx` over z = y − x, and the
/// least value over a part of the variables is the Schur complement. Singular blocks are eliminated pivot by pivot.
pub fn shorted(f: &Q, g: &Q) -> Q {
    let n = f.rows();
    let bordered = (f + g).beside(f).above(&f.beside(f));
    let ldl = bordered.ldl().unwrap_or_else(|error| panic!("[[F + G, F], [F, F]] is semidefinite: {error}"));
    ldl.lower.block(n..2 * n, n..2 * n).congruence(&Matrix::diagonal(&ldl.pivots[n..]))
}
