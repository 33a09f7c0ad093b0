//! Polynomials in several variables, by their terms.

use std::collections::BTreeMap;

use crate::scalar::Field;

/// A polynomial in x_0, …, x_{n−1}, as a sum of terms c·x_0^{e_0}⋯x_{n−1}^{e_{n−1}}.
///
/// # Examples
///
/// ```
/// use exact_kalman::{gaussian::Polynomial, scalar::{ratio, Rational}};
///
/// // (x + 2y)² = x² + 4xy + 4y²
/// let [x, y] = [0, 1].map(|i| Polynomial::<Rational>::variable(2, i));
/// let sum = x.plus(&y.scaled(&ratio(2, 1)));
/// let square = sum.times(&sum);
/// assert_eq!(square.terms().count(), 3);
/// assert_eq!(square.derivative(0), sum.scaled(&ratio(2, 1)));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Polynomial<S> {
    variables: usize,
    /// Coefficients by exponents; none is zero.
    terms: BTreeMap<Vec<u32>, S>,
}

impl<S: Field> Polynomial<S> {
    /// The zero polynomial in the given number of variables.
    pub fn zero(variables: usize) -> Self {
        Self { variables, terms: BTreeMap::new() }
    }

    /// The polynomial of one term; there is one exponent for each variable.
    pub fn term(coefficient: S, exponents: Vec<u32>) -> Self {
        let mut polynomial = Self::zero(exponents.len());
        polynomial.add(coefficient, exponents);
        polynomial
    }

    /// The constant.
    pub fn constant(variables: usize, value: S) -> Self {
        Self::term(value, vec![0; variables])
    }

    /// The variable x_i.
    ///
    /// # Panics
    ///
    /// If there is no such variable.
    pub fn variable(variables: usize, i: usize) -> Self {
        let mut exponents = vec![0; variables];
        exponents[i] = 1;
        Self::term(S::one(), exponents)
    }

    /// The number of variables.
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// Exponents and coefficients of all terms; no coefficient is zero.
    pub fn terms(&self) -> impl Iterator<Item = (&[u32], &S)> {
        self.terms.iter().map(|(exponents, coefficient)| (exponents.as_slice(), coefficient))
    }

    /// The multiple by a scalar.
    pub fn scaled(&self, factor: &S) -> Self {
        let mut multiple = Self::zero(self.variables);
        for (exponents, coefficient) in &self.terms {
            multiple.add(coefficient.times(factor), exponents.clone());
        }
        multiple
    }

    /// The sum.
    ///
    /// # Panics
    ///
    /// If the numbers of variables differ.
    pub fn plus(&self, other: &Self) -> Self {
        self.assert_compatible(other);
        let mut sum = self.clone();
        for (exponents, coefficient) in &other.terms {
            sum.add(coefficient.clone(), exponents.clone());
        }
        sum
    }

    /// The product.
    ///
    /// # Panics
    ///
    /// If the numbers of variables differ, or an exponent exceeds [`u32::MAX`].
    pub fn times(&self, other: &Self) -> Self {
        self.assert_compatible(other);
        let mut product = Self::zero(self.variables);
        for (left, a) in &self.terms {
            for (right, b) in &other.terms {
                let sum = |(e, f): (&u32, &u32)| {
                    e.checked_add(*f).unwrap_or_else(|| panic!("an exponent beyond {}", u32::MAX))
                };
                let exponents = left.iter().zip(right).map(sum).collect();
                product.add(a.times(b), exponents);
            }
        }
        product
    }

    /// The derivative by x_i.
    ///
    /// # Panics
    ///
    /// If there is no such variable.
    pub fn derivative(&self, i: usize) -> Self {
        let mut derivative = Self::zero(self.variables);
        for (exponents, coefficient) in self.terms.iter().filter(|(exponents, _)| exponents[i] > 0) {
            let mut lowered = exponents.clone();
            lowered[i] -= 1;
            derivative.add(coefficient.times(&S::from_integer(i64::from(exponents[i]))), lowered);
        }
        derivative
    }

    fn add(&mut self, coefficient: S, exponents: Vec<u32>) {
        let sum = match self.terms.remove(&exponents) {
            Some(present) => present.plus(&coefficient),
            None => coefficient,
        };
        if !sum.is_zero() {
            self.terms.insert(exponents, sum);
        }
    }

    fn assert_compatible(&self, other: &Self) {
        assert!(self.variables == other.variables, "{} and {} variables", self.variables, other.variables);
    }
}
