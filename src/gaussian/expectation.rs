//! Expectations of polynomials of a Gaussian vector.

use super::{Gaussian, Polynomial};
use crate::matrix::LdlError;
use crate::scalar::OrderedField;

impl<S: OrderedField> Gaussian<S> {
    /// E g(X) for a polynomial g, exactly.
    ///
    /// With P = LDLᵀ the vector is X = μ + Lu for independent uⱼ of mean 0 and variance dⱼ, so that E uⱼ²ᵏ = (2k − 1)!!·dⱼᵏ;
    /// g(μ + Lu) is multiplied out in u. No moment is taken from another, so identities between moments, such as
    /// that of Stein (AK-Stein-Gauss), can be checked by it. The covariance may be singular.
    ///
    /// # Errors
    ///
    /// [`LdlError::Indefinite`] if the covariance is not positive semidefinite: no vector has it.
    ///
    /// # Panics
    ///
    /// If g does not have one variable for each component.
    ///
    /// # Examples
    ///
    /// The fourth moment of a variable of variance 2 is 3·2²:
    ///
    /// ```
    /// use exact_kalman::{gaussian::{Gaussian, Polynomial}, matrix::Matrix, scalar::{ratio, Rational}};
    ///
    /// let x = Gaussian::<Rational>::new(Matrix::zeros(1, 1), Matrix::from_integers(&[[2]]))?;
    /// assert_eq!(x.expectation(&Polynomial::term(ratio(1, 1), vec![4]))?, ratio(12, 1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn expectation(&self, polynomial: &Polynomial<S>) -> Result<S, LdlError<S>> {
        let n = self.dimension();
        assert!(polynomial.variables() == n, "{} variables for {n} components", polynomial.variables());
        let ldl = self.covariance.ldl()?;
        let coordinate = |i: usize| {
            let start = Polynomial::constant(n, self.mean[(i, 0)].clone());
            (0..=i).fold(start, |sum, j| sum.plus(&Polynomial::variable(n, j).scaled(&ldl.lower[(i, j)])))
        };
        let coordinates: Vec<_> = (0..n).map(coordinate).collect();
        let mut expectation = S::zero();
        for (exponents, coefficient) in polynomial.terms() {
            let factors = exponents.iter().zip(&coordinates).flat_map(|(&exponent, x)| (0..exponent).map(move |_| x));
            let product = factors.fold(Polynomial::constant(n, coefficient.clone()), |product, x| product.times(x));
            for (exponents, coefficient) in product.terms() {
                let moments = exponents.iter().zip(&ldl.pivots).map(|(&exponent, pivot)| moment(exponent, pivot));
                expectation = expectation.plus(&moments.fold(coefficient.clone(), |product, m| product.times(&m)));
            }
        }
        Ok(expectation)
    }
}

/// E uᵉ for u ~ N(0, d).
fn moment<S: OrderedField>(exponent: u32, variance: &S) -> S {
    if exponent % 2 == 1 {
        return S::zero();
    }
    let odd = (1..exponent).step_by(2).map(|odd| S::from_integer(i64::from(odd)).times(variance));
    odd.fold(S::one(), |product, factor| product.times(&factor))
}
