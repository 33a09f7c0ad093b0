//! What a linear map does to monomials.

use std::collections::BTreeMap;

use super::Matrix;
use crate::scalar::Scalar;

impl<S: Scalar> Matrix<S> {
    /// The matrix that takes all monomials of degree n in x to those in A x: the symmetric power of A.
    ///
    /// `(A x)^[n] = A^[n] x^[n]`, where `x^[n]` lists the monomials `x₁^α₁ ⋯ x_d^α_d`, Σα = n, from `x₁ⁿ` down to `x_dⁿ` in lexical
    /// order. So `(AB)^[n] = A^[n] B^[n]`, the symmetric power of a column is the list of its monomials, and that of a row holds the
    /// coefficients of a power of its linear form. The eigenvalues of `A^[n]` are the products of n eigenvalues of A.
    ///
    /// Shapes: A d×e; the power has C(d+n−1, n) rows and C(e+n−1, n) columns.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::Rational};
    ///
    /// // (x + 2y)², (x + 2y)·3y, (3y)² by x², xy, y².
    /// let a = Matrix::<Rational>::from_integers(&[[1, 2], [0, 3]]);
    /// assert_eq!(a.symmetric_power(2), Matrix::from_integers(&[[1, 4, 4], [0, 3, 6], [0, 0, 9]]));
    /// ```
    pub fn symmetric_power(&self, degree: usize) -> Self {
        let (above, beside) = (monomials(self.rows(), degree), monomials(self.columns(), degree));
        let place: BTreeMap<&[usize], usize> = beside.iter().enumerate().map(|(i, m)| (m.as_slice(), i)).collect();
        let mut power = Self::zeros(above.len(), beside.len());
        for (row, exponents) in above.iter().enumerate() {
            let factors = exponents.iter().enumerate().flat_map(|(i, &exponent)| std::iter::repeat_n(i, exponent));
            let one = BTreeMap::from([(vec![0; self.columns()], S::one())]);
            let product = factors.fold(one, |product, i| times_form(&product, self.row(i)));
            for (monomial, coefficient) in product {
                power[(row, place[monomial.as_slice()])] = coefficient;
            }
        }
        power
    }
}

/// The exponents of all monomials of a degree, in descending lexical order.
fn monomials(variables: usize, degree: usize) -> Vec<Vec<usize>> {
    if variables == 0 {
        return if degree == 0 { vec![vec![]] } else { vec![] };
    }
    let with_first = |first: usize| {
        let rest = monomials(variables - 1, degree - first);
        rest.into_iter().map(move |rest| std::iter::once(first).chain(rest).collect())
    };
    (0..=degree).rev().flat_map(with_first).collect()
}

/// The product of a polynomial, given by its coefficients, with a linear form.
fn times_form<S: Scalar>(polynomial: &BTreeMap<Vec<usize>, S>, form: &[S]) -> BTreeMap<Vec<usize>, S> {
    let mut product: BTreeMap<Vec<usize>, S> = BTreeMap::new();
    for (monomial, coefficient) in polynomial {
        for (variable, factor) in form.iter().enumerate() {
            let mut raised = monomial.clone();
            raised[variable] += 1;
            let term = coefficient.times(factor);
            product.entry(raised).and_modify(|sum| *sum = sum.plus(&term)).or_insert(term);
        }
    }
    product
}
