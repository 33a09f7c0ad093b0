//! Short vectors that prove a matrix not positive semidefinite.

use super::Decimal;
use crate::matrix::{Indefinite, Matrix};
use crate::scalar::Rational;

/// A vector with few digits and vᵀPv < 0, recomputed exactly; the given one if rounding loses the proof.
///
/// # Examples
///
/// ```
/// use exact_kalman::matrix::{LdlError, Matrix};
/// use exact_kalman::protocol::short_witness;
/// use exact_kalman::scalar::{ratio, Rational};
///
/// let p = Matrix::<Rational>::from_integers(&[[80, 500], [500, 80]]);
/// let Err(LdlError::Indefinite(proof)) = p.ldl() else { panic!("det P < 0") };
/// let short = short_witness(&p, &proof);
/// assert_eq!(short.witness, Matrix::column(vec![ratio(-6, 1), ratio(1, 1)]));
/// assert_eq!(short.value, ratio(-3040, 1));
/// ```
pub fn short_witness(matrix: &Matrix<Rational>, proof: &Indefinite<Rational>) -> Indefinite<Rational> {
    let zero = Rational::from_integer(0.into());
    for digits in 1..=17 {
        let witness = proof.witness.map(|entry| Decimal::rounded(entry, digits).value());
        let value = witness.transpose().congruence(matrix)[(0, 0)].clone();
        if value < zero {
            return Indefinite { witness, value };
        }
    }
    proof.clone()
}

/// The proof in words: the vector exactly, the value to three digits.
pub(super) fn described(matrix: &Matrix<Rational>, proof: &Indefinite<Rational>) -> String {
    let short = short_witness(matrix, proof);
    let entries: Vec<String> = short.witness.entries().iter().map(exact_text).collect();
    format!("v = [{}] has vᵀPv = {} < 0", entries.join(", "), Decimal::rounded(&short.value, 3))
}

/// A decimal if a short one is exact, else the fraction.
fn exact_text(value: &Rational) -> String {
    let decimal = Decimal::rounded(value, 17);
    if decimal.value() == *value { decimal.to_string() } else { value.to_string() }
}
