//! Whether all eigenvalues lie in a disc, decided without computing one.

use std::cmp::Ordering;

use super::Matrix;
use crate::scalar::OrderedField;

impl<S: OrderedField> Matrix<S> {
    /// Whether ρ(A) < r: whether every eigenvalue, complex ones included, has modulus below r.
    ///
    /// With r = 1 this is the stability that AK-A.rho assumes. Exact, by the test of Schur, Cohn and Jury on the
    /// characteristic polynomial: eigenvalues on the circle itself are told from those just inside. Nothing is below a
    /// bound that is not positive.
    ///
    /// AK-A.rho: `ρ(A) < 1`
    ///
    /// # Panics
    ///
    /// If the matrix is not square.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{Rational, ratio}};
    ///
    /// // Eigenvalues 3 ± 4i, of modulus 5.
    /// let a = Matrix::<Rational>::from_integers(&[[3, 4], [-4, 3]]);
    /// assert!(a.spectral_radius_lt(&ratio(51, 10)));
    /// assert!(!a.spectral_radius_lt(&ratio(5, 1)));
    /// ```
    pub fn spectral_radius_lt(&self, bound: &S) -> bool {
        if *bound <= S::zero() {
            return false;
        }
        // The roots of p(r·z) are the eigenvalues divided by r.
        let mut power = S::one();
        let mut scaled = Vec::with_capacity(self.rows() + 1);
        for coefficient in self.characteristic_polynomial() {
            scaled.push(coefficient.times(&power));
            power = power.times(bound);
        }
        has_roots_in_unit_disc(scaled)
    }
}

/// Whether every root of Σ aᵢzⁱ, aₙ ≠ 0, has modulus below 1.
///
/// Let p* be p with its coefficients reversed. The product of the roots is ±a₀/aₙ, so |a₀| < |aₙ| is necessary. Given
/// that, z·q(z) = aₙp(z) − a₀p*(z) has as many roots in the disc as p (Rouché; |p| = |p*| on the circle), and shares
/// the roots on the circle, so p may be replaced by q, of degree n − 1.
fn has_roots_in_unit_disc<S: OrderedField>(mut p: Vec<S>) -> bool {
    while let [constant, .., leading] = p.as_slice() {
        let difference = leading.times(leading).minus(&constant.times(constant));
        if difference.cmp(&S::zero()) != Ordering::Greater {
            return false;
        }
        let degree = p.len() - 1;
        let reduced = (0..degree).map(|i| leading.times(&p[i + 1]).minus(&constant.times(&p[degree - 1 - i])));
        // Divided by the new leading coefficient, or numbers would double their length at every degree.
        let monic = reduced.map(|coefficient| coefficient.over(&difference)).collect::<Result<_, _>>();
        let Ok(monic) = monic else { unreachable!("the difference is positive") };
        p = monic;
    }
    true
}
