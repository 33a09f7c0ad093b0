//! Conditioning under a covariance `κ·diffuse + finite + O(1/κ)`, by elimination of series in 1/κ.
//!
//! Both matrices belong to a covariance that is positive semidefinite for every κ ≥ 0. The two leading orders are then
//! closed: eliminating an observed entry divides by its variance `κ p₁ + p₀`, and
//!
//! * where p₁ ≠ 0, `(κa + b)(κa + b)ᵀ / (κp₁ + p₀) = κ aaᵀ/p₁ + (abᵀ + baᵀ)/p₁ − aaᵀ p₀/p₁² + O(1/κ)`;
//! * where p₁ = 0, the covariances with that entry have no κ term either (Cauchy–Schwarz, for every κ), so the
//!   quotient is `bbᵀ/p₀ + O(1/κ)`;
//! * where both vanish, the entry has variance exactly zero for every κ: what is left of a variance after conditioning is
//!   the least that linear combinations of the conditioning entries leave of it, so it is nonnegative and does not
//!   decrease with the prior covariance, hence not with κ; its limit being zero, it is zero throughout.
//!
//! The limit of the gain needs only the leading terms.

use super::diffuse::part;
use crate::gaussian::{ConditionError, Inconsistent};
use crate::matrix::{Matrix, PseudoInverseError, Undecided};
use crate::scalar::{Scalar, ZeroTest};
use crate::trace::Moments;

/// The covariance `κ·diffuse + finite` of (y, target), the entries of y first.
pub(super) struct Joint<S> {
    /// The number of entries of y.
    pub(super) observed: usize,
    pub(super) diffuse: Matrix<S>,
    pub(super) finite: Matrix<S>,
}

/// What conditioning yields.
pub(super) struct Conditioned<S> {
    /// The law of the target given y.
    pub(super) law: Moments<S>,
    /// The limit of the gain.
    pub(super) gain: Matrix<S>,
    /// The rank of the covariance of y.
    pub(super) rank: usize,
}

/// The order in κ of a pivot.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Order {
    Diffuse,
    Finite,
}

impl<S: Scalar> Joint<S> {
    /// The law of the target given y, and the limit of the gain.
    pub(super) fn conditioned(
        mut self,
        mean: &Matrix<S>,
        innovation: &Matrix<S>,
    ) -> Result<Conditioned<S>, ConditionError<S>> {
        let (m, size) = (self.observed, self.finite.rows());
        // Row i says which combination of the entries of y has been added to component i.
        let mut combination = Matrix::identity(m).above(&Matrix::zeros(size - m, m));
        let mut rest: Vec<usize> = (0..m).collect();
        while let Some((row, order)) = self.next_pivot(&rest)? {
            rest.retain(|&i| i != row);
            self.eliminate(row, order, &mut combination).map_err(|()| undecided(row))?;
        }
        if let Some(proof) = contradiction(&rest, &combination, innovation) {
            return Err(ConditionError::Inconsistent(proof));
        }
        let gain = -combination.block(m..size, 0..m);
        let law = Moments {
            mean: mean + &gain * innovation,
            covariance: self.finite.block(m..size, m..size),
            diffuse: part(Some(self.diffuse.block(m..size, m..size))),
        };
        Ok(Conditioned { law, gain, rank: m - rest.len() })
    }

    /// An entry whose variance grows with κ if there is one, else one whose variance is not zero.
    fn next_pivot(&self, rest: &[usize]) -> Result<Option<(usize, Order)>, ConditionError<S>> {
        for (matrix, order) in [(&self.diffuse, Order::Diffuse), (&self.finite, Order::Finite)] {
            for &i in rest {
                match matrix[(i, i)].zero_test() {
                    ZeroTest::Zero => {}
                    ZeroTest::Nonzero => return Ok(Some((i, order))),
                    ZeroTest::Undecided => return Err(undecided(i)),
                }
            }
        }
        Ok(None)
    }

    fn eliminate(&mut self, row: usize, order: Order, combination: &mut Matrix<S>) -> Result<(), ()> {
        let size = self.finite.rows();
        let column = |matrix: &Matrix<S>| matrix.block(0..size, row..row + 1);
        let divided = |matrix: &Matrix<S>, by: &S| matrix.try_map(|entry| entry.over(by).map_err(drop));
        let (a, b) = (column(&self.diffuse), column(&self.finite));
        let p0 = self.finite[(row, row)].clone();
        let mut multipliers = match order {
            Order::Finite => {
                let multipliers = divided(&b, &p0)?;
                self.finite = &self.finite - &multipliers * b.transpose();
                multipliers
            }
            Order::Diffuse => {
                let multipliers = divided(&a, &self.diffuse[(row, row)])?;
                let mixed = &multipliers * b.transpose();
                let quadratic = (&multipliers * multipliers.transpose()).scaled(&p0);
                self.finite = &self.finite - &mixed - mixed.transpose() + quadratic;
                self.diffuse = &self.diffuse - &multipliers * a.transpose();
                multipliers
            }
        };
        // The pivot itself stays as it is, for the record of its combination.
        multipliers[(row, 0)] = S::zero();
        *combination = &*combination - &multipliers * combination.block(row..row + 1, 0..self.observed);
        Ok(())
    }
}

/// A combination of the entries of y that has variance zero and whose innovation is certainly not zero.
fn contradiction<S: Scalar>(
    rest: &[usize],
    combination: &Matrix<S>,
    innovation: &Matrix<S>,
) -> Option<Inconsistent<S>> {
    rest.iter().find_map(|&i| {
        let direction = combination.block(i..i + 1, 0..combination.columns());
        let value = (&direction * innovation)[(0, 0)].clone();
        let certain = value.zero_test() == ZeroTest::Nonzero;
        certain.then(|| Inconsistent { direction: direction.transpose(), value }.simplified())
    })
}

fn undecided<S>(column: usize) -> ConditionError<S> {
    ConditionError::PseudoInverse(PseudoInverseError::Undecided(Undecided { column }))
}
