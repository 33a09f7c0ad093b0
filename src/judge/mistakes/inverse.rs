//! Inverses of innovation covariances that may be singular.

use super::real::Real;
use crate::matrix::Matrix;
use crate::scalar::Scalar as _;

/// A pivot below 2⁻³⁰⁰ of the largest variance that the sensor's innovation had counts as zero: it is what 512 bits
/// leave of one.
const NEGLIGIBLE: i64 = 300;

/// The largest variance of each sensor's innovation so far, as a power of two.
pub(super) struct Ranks(Vec<i64>);

/// A symmetric matrix G with SGS = S: what it does to anything in the range of S is the same as what S⁺ does.
pub(super) struct Inverse {
    matrix: Matrix<Real>,
    /// Which diagonal entries of S count as zero.
    least: Vec<i64>,
}

impl Ranks {
    pub(super) fn new(sensors: usize) -> Self {
        Self(vec![i64::MIN / 2; sensors])
    }

    /// A generalised inverse, by elimination of one pivot after the other.
    pub(super) fn inverse(&mut self, covariance: &Matrix<Real>, observed: &[usize]) -> Inverse {
        let m = observed.len();
        for (place, &sensor) in observed.iter().enumerate() {
            self.0[sensor] = self.0[sensor].max(covariance[(place, place)].magnitude());
        }
        let least: Vec<i64> = observed.iter().map(|&sensor| self.0[sensor] - NEGLIGIBLE).collect();
        let matrix = inverted(covariance, &least);
        debug_assert_eq!(matrix.rows(), m);
        Inverse { matrix, least }
    }
}

impl Inverse {
    pub(super) fn matrix(&self) -> &Matrix<Real> {
        &self.matrix
    }

    /// The inverse of the diagonal alone.
    pub(super) fn of_diagonal(&self, covariance: &Matrix<Real>) -> Matrix<Real> {
        let m = covariance.rows();
        let diagonal = Matrix::from_fn(m, m, |i, j| if i == j { covariance[(i, i)].clone() } else { Real::zero() });
        inverted(&diagonal, &self.least)
    }

    /// The inverse of the block of those entries whose variance is not smaller, zero elsewhere.
    pub(super) fn of_those_above(&self, covariance: &Matrix<Real>, least: &Real) -> Matrix<Real> {
        let kept: Vec<bool> = (0..covariance.rows())
            .map(|i| covariance[(i, i)].minus(least).value() >= crate::scalar::ratio(0, 1))
            .collect();
        let m = covariance.rows();
        let block =
            Matrix::from_fn(m, m, |i, j| if kept[i] && kept[j] { covariance[(i, j)].clone() } else { Real::zero() });
        inverted(&block, &self.least)
    }
}

/// Gauss and Jordan on the pivots that are not negligible; the rows and columns of the others are zero.
fn inverted(matrix: &Matrix<Real>, least: &[i64]) -> Matrix<Real> {
    let m = matrix.rows();
    let mut rest = matrix.clone();
    let mut is_pivot = vec![false; m];
    for k in 0..m {
        let pivot = rest[(k, k)].clone();
        let Ok(factor) = Real::one().over(&pivot) else { continue };
        if pivot.magnitude() < least[k] {
            continue;
        }
        is_pivot[k] = true;
        let (row, column): (Vec<_>, Vec<_>) = (0..m).map(|j| (rest[(k, j)].clone(), rest[(j, k)].clone())).unzip();
        // The sweep operator: swept pivots hold the negative of the inverse.
        rest = Matrix::from_fn(m, m, |i, j| match (i == k, j == k) {
            (true, true) => factor.negated(),
            (true, false) => row[j].times(&factor),
            (false, true) => column[i].times(&factor),
            (false, false) => rest[(i, j)].minus(&column[i].times(&row[j]).times(&factor)),
        });
    }
    Matrix::from_fn(m, m, |i, j| if is_pivot[i] && is_pivot[j] { rest[(i, j)].negated() } else { Real::zero() })
}
