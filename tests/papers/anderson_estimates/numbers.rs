//! Random rationals, and small helpers on matrices of them.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};

pub type Q = Matrix<Rational>;

/// SplitMix64: points at which polynomial identities are tried.
pub struct Draws(u64);

impl Draws {
    pub fn seeded(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// One of −`bound`, …, `bound`.
    pub fn integer(&mut self, bound: i64) -> i64 {
        i64::try_from(self.next() % (2 * bound.unsigned_abs() + 1)).unwrap_or(0) - bound
    }

    /// A fraction of small integers.
    pub fn number(&mut self) -> Rational {
        let numerator = self.integer(6);
        ratio(numerator, 2 + self.integer(1))
    }

    pub fn matrix(&mut self, rows: usize, columns: usize) -> Q {
        Matrix::from_fn(rows, columns, |_, _| self.number())
    }

    /// A positive semidefinite matrix of at most this rank.
    pub fn semidefinite(&mut self, p: usize, rank: usize) -> Q {
        let root = self.matrix(p, rank);
        &root * root.transpose()
    }

    pub fn definite(&mut self, p: usize) -> Q {
        self.semidefinite(p, p) + Matrix::identity(p).scaled(&ratio(1, 3))
    }

    /// A matrix with ‖A‖ < 1, hence ρ(A) < 1: at most 9/10 in the sum of the moduli.
    pub fn contraction(&mut self, p: usize) -> Q {
        let matrix = self.matrix(p, p);
        let sum: Rational = matrix.entries().iter().map(modulus).sum();
        if sum == ratio(0, 1) { matrix } else { matrix.scaled(&(ratio(9, 10) / sum)) }
    }

    /// Readings y(1), …, y(n), columns of length p.
    pub fn readings(&mut self, p: usize, n: usize) -> Vec<Q> {
        (0..n).map(|_| self.matrix(p, 1)).collect()
    }
}

pub fn modulus(value: &Rational) -> Rational {
    if *value < ratio(0, 1) { -value.clone() } else { value.clone() }
}

pub fn integers<const C: usize>(rows: &[[i64; C]]) -> Q {
    Matrix::from_integers(rows)
}

pub fn number(value: Rational) -> Q {
    Matrix::column(vec![value])
}

pub fn power(matrix: &Q, exponent: usize) -> Q {
    (0..exponent).fold(Matrix::identity(matrix.rows()), |product, _| product * matrix)
}

pub fn inverse(matrix: &Q) -> Q {
    matrix.inverse().unwrap_or_else(|error| panic!("{error}"))
}

pub fn pseudo_inverse(matrix: &Q) -> Q {
    matrix.pseudo_inverse().unwrap_or_else(|error| panic!("{error}"))
}

pub fn trace(matrix: &Q) -> Rational {
    (0..matrix.rows()).map(|i| matrix[(i, i)].clone()).sum()
}

/// ‖G‖² = tr(GGᵀ).
pub fn squared_norm(matrix: &Q) -> Rational {
    matrix.entries().iter().map(|entry| entry * entry).sum()
}

/// The sum of matrices of one shape.
pub fn total(rows: usize, columns: usize, terms: impl IntoIterator<Item = Q>) -> Q {
    terms.into_iter().fold(Matrix::zeros(rows, columns), |sum, term| sum + term)
}

pub fn count(n: usize) -> Rational {
    ratio(i64::try_from(n).unwrap_or(i64::MAX), 1)
}

/// X = A X Aᵀ + V, solved as p² linear equations.
pub fn stein(a: &Q, v: &Q) -> Q {
    let p = a.rows();
    let place = |i: usize, j: usize| i * p + j;
    let equations = Matrix::from_fn(p * p, p * p, |row, column| {
        let (i, j, k, l) = (row / p, row % p, column / p, column % p);
        let unit = if row == column { ratio(1, 1) } else { ratio(0, 1) };
        unit - &a[(i, k)] * &a[(j, l)]
    });
    let solved = equations.solve(&Matrix::column(v.entries().to_vec())).unwrap_or_else(|error| panic!("{error}"));
    Matrix::from_fn(p, p, |i, j| solved[(place(i, j), 0)].clone())
}

/// A(S:W)Aᵀ + V with S:W = S(S + W)⁺W.
pub fn riccati(a: &Q, v: &Q, w: &Q, s: &Q) -> Q {
    a.congruence(&(s * pseudo_inverse(&(s + w)) * w)) + v
}

/// Rationals below and above √x, a part in a million of max(1, x) apart.
pub fn root_bounds(x: &Rational) -> (Rational, Rational) {
    let scale = ratio(1_000_000, 1);
    let scaled = (x * &scale * &scale).floor().to_integer().sqrt();
    let below = Rational::from(scaled.clone()) / &scale;
    (below, Rational::from(scaled + 1) / scale)
}
