//! Sums, differences, products and multiples.

use std::ops::{Add, Mul, Neg, Sub};

use super::{Matrix, Shape};
use crate::scalar::Scalar;

impl<S: Scalar> Matrix<S> {
    /// The multiple by a scalar.
    pub fn scaled(&self, factor: &S) -> Self {
        self.map(|entry| entry.times(factor))
    }

    /// `self · middle · selfᵀ`, the image of a covariance under a linear map (CKS-L2i).
    pub fn congruence(&self, middle: &Self) -> Self {
        self * middle * self.transpose()
    }

    fn combined(&self, other: &Self, verb: &str, combine: impl Fn(&S, &S) -> S) -> Self {
        assert!(self.shape == other.shape, "cannot {verb} a {} and a {} matrix", self.shape, other.shape);
        let entries = self.entries.iter().zip(&other.entries).map(|(a, b)| combine(a, b)).collect();
        Self { shape: self.shape, entries }
    }

    fn product(&self, other: &Self) -> Self {
        assert!(self.columns() == other.rows(), "cannot multiply a {} by a {} matrix", self.shape, other.shape);
        let mut entries = Vec::with_capacity(self.rows() * other.columns());
        for i in 0..self.rows() {
            for j in 0..other.columns() {
                let pairs = self.row(i).iter().enumerate().map(|(k, a)| a.times(&other[(k, j)]));
                entries.push(pairs.reduce(|sum, term| sum.plus(&term)).unwrap_or_else(S::zero));
            }
        }
        Self { shape: Shape { rows: self.rows(), columns: other.columns() }, entries }
    }
}

/// Writes one operator for all four combinations of owned and borrowed operands.
macro_rules! operator {
    ($trait:ident, $method:ident, |$a:ident, $b:ident| $value:expr) => {
        impl<S: Scalar> $trait<&Matrix<S>> for &Matrix<S> {
            type Output = Matrix<S>;
            fn $method(self, other: &Matrix<S>) -> Matrix<S> {
                let ($a, $b) = (self, other);
                $value
            }
        }
        impl<S: Scalar> $trait<Matrix<S>> for &Matrix<S> {
            type Output = Matrix<S>;
            fn $method(self, other: Matrix<S>) -> Matrix<S> {
                $trait::$method(self, &other)
            }
        }
        impl<S: Scalar> $trait<&Matrix<S>> for Matrix<S> {
            type Output = Matrix<S>;
            fn $method(self, other: &Matrix<S>) -> Matrix<S> {
                $trait::$method(&self, other)
            }
        }
        impl<S: Scalar> $trait<Matrix<S>> for Matrix<S> {
            type Output = Matrix<S>;
            fn $method(self, other: Matrix<S>) -> Matrix<S> {
                $trait::$method(&self, &other)
            }
        }
    };
}

operator!(Add, add, |a, b| a.combined(b, "add", S::plus));
operator!(Sub, sub, |a, b| a.combined(b, "subtract", S::minus));
operator!(Mul, mul, |a, b| a.product(b));

impl<S: Scalar> Neg for &Matrix<S> {
    type Output = Matrix<S>;

    fn neg(self) -> Matrix<S> {
        self.map(S::negated)
    }
}

impl<S: Scalar> Neg for Matrix<S> {
    type Output = Matrix<S>;

    fn neg(self) -> Matrix<S> {
        -&self
    }
}
