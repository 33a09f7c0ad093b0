//! Polynomials in one letter over a field.

use crate::matrix::Matrix;
use crate::scalar::Field;

/// Σ aᵢzⁱ, from the constant term to the leading one, which is not zero; nothing for the polynomial zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Polynomial<F>(Vec<F>);

impl<F: Field> Polynomial<F> {
    /// The polynomial with these coefficients.
    pub(super) fn new(mut coefficients: Vec<F>) -> Self {
        while coefficients.last().is_some_and(Field::is_zero) {
            coefficients.pop();
        }
        Self(coefficients)
    }

    /// From the constant term upwards.
    pub(super) fn coefficients(&self) -> &[F] {
        &self.0
    }

    /// The degree; zero for the polynomial zero too.
    pub(super) fn degree(&self) -> usize {
        self.0.len().saturating_sub(1)
    }

    /// Whether it is zero.
    pub(super) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// Its value (Horner).
    pub(super) fn at(&self, z: &F) -> F {
        self.0.iter().rev().fold(F::zero(), |value, coefficient| value.times(z).plus(coefficient))
    }

    /// Its value at a square matrix.
    pub(super) fn at_matrix(&self, z: &Matrix<F>) -> Matrix<F> {
        let n = z.rows();
        let constant = |coefficient: &F| Matrix::identity(n).scaled(coefficient);
        self.0.iter().rev().fold(Matrix::zeros(n, n), |value, coefficient| value * z + constant(coefficient))
    }

    /// `zᵈ p(1/z)`, d the degree: the roots other than zero are inverted.
    pub(super) fn reciprocal(&self) -> Self {
        Self::new(self.0.iter().rev().cloned().collect())
    }

    /// The derivative.
    pub(super) fn derivative(&self) -> Self {
        let mut factor = F::zero();
        let terms = self.0.iter().skip(1).map(|coefficient| {
            factor = factor.plus(&F::one());
            coefficient.times(&factor)
        });
        Self::new(terms.collect())
    }

    /// Divided by the leading coefficient.
    pub(super) fn monic(&self) -> Self {
        let Some(leading) = self.0.last() else { return self.clone() };
        Self(self.0.iter().map(|coefficient| quotient(coefficient, leading)).collect())
    }

    /// Quotient and remainder; the divisor is not zero.
    pub(super) fn divided(&self, divisor: &Self) -> (Self, Self) {
        let Some(leading) = divisor.0.last() else { return (Self(Vec::new()), self.clone()) };
        let mut rest = self.0.clone();
        let mut quotients = Vec::new();
        while rest.len() >= divisor.0.len() {
            let Some(highest) = rest.pop() else { break };
            let factor = quotient(&highest, leading);
            let shift = rest.len() + 1 - divisor.0.len();
            for (i, coefficient) in divisor.0[..divisor.degree()].iter().enumerate() {
                rest[shift + i] = rest[shift + i].minus(&factor.times(coefficient));
            }
            quotients.push(factor);
        }
        quotients.reverse();
        (Self::new(quotients), Self::new(rest))
    }

    /// The greatest common divisor, monic.
    pub(super) fn common_divisor(&self, other: &Self) -> Self {
        let (mut a, mut b) = (self.clone(), other.clone());
        while !b.is_zero() {
            let rest = a.divided(&b).1.monic();
            (a, b) = (b, rest);
        }
        a.monic()
    }

    /// The product of its different irreducible factors, in characteristic zero or above the degree.
    pub(super) fn square_free(&self) -> Self {
        self.divided(&self.common_divisor(&self.derivative())).0.monic()
    }
}

/// The quotient by a number that is not zero.
fn quotient<F: Field>(dividend: &F, divisor: &F) -> F {
    let Ok(quotient) = dividend.over(divisor) else { unreachable!("the divisor is not zero") };
    quotient
}
