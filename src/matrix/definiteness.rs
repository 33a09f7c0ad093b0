//! LDLᵀ, positive semidefiniteness with a witness, and the Loewner order.

use super::Matrix;
use crate::scalar::OrderedField;

/// A vector v with vᵀPv < 0: proof that P is not positive semidefinite, for anyone to recompute.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Indefinite<S> {
    /// The vector v, one column.
    pub witness: Matrix<S>,
    /// The value vᵀPv, below zero.
    pub value: S,
}

/// Why a matrix has no factorisation P = LDLᵀ with D ≥ 0.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LdlError<S> {
    /// The entries at (row, column) and (column, row) differ.
    #[error("the matrix is not symmetric: entries ({row}, {column}) and ({column}, {row}) differ")]
    Asymmetric {
        /// The row, counted from 0.
        row: usize,
        /// The column, counted from 0.
        column: usize,
    },
    /// The matrix is symmetric and takes a negative value.
    #[error("the matrix is not positive semidefinite")]
    Indefinite(Indefinite<S>),
}

/// `P = L D Lᵀ` with L unit lower triangular and D diagonal, D ≥ 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ldl<S> {
    /// The unit lower triangular factor; below a zero pivot its entries are zero.
    pub lower: Matrix<S>,
    /// The pivots, each nonnegative.
    pub pivots: Vec<S>,
}

impl<S: OrderedField> Ldl<S> {
    /// The number of positive pivots, which is the rank of P.
    pub fn rank(&self) -> usize {
        self.pivots.iter().filter(|pivot| !pivot.is_zero()).count()
    }

    /// Whether every pivot is positive.
    pub fn is_positive_definite(&self) -> bool {
        self.rank() == self.pivots.len()
    }

    /// The vector v with vᵢ as given for i ≥ `from` whose part above makes `P v` vanish on the pivots
    /// before `from`: then vᵀPv is the value of the Schur complement at the given part.
    fn lifted(&self, from: usize, given: &[(usize, S)]) -> Matrix<S> {
        let mut v = Matrix::zeros(self.lower.rows(), 1);
        for (place, value) in given {
            v[(*place, 0)] = value.clone();
        }
        for i in (0..from).rev() {
            let terms = (i + 1..self.lower.rows()).map(|j| self.lower[(j, i)].times(&v[(j, 0)]));
            v[(i, 0)] = terms.fold(S::zero(), |sum, term| sum.minus(&term));
        }
        v
    }
}

impl<S: OrderedField> Matrix<S> {
    /// The factorisation P = LDLᵀ of a positive semidefinite matrix, singular ones included.
    ///
    /// # Errors
    ///
    /// [`LdlError::Asymmetric`] with the first place that differs from its mirror image,
    /// [`LdlError::Indefinite`] with a vector v such that vᵀPv < 0.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::{LdlError, Matrix}, scalar::Rational};
    ///
    /// let p = Matrix::<Rational>::from_integers(&[[80, 500], [500, 80]]);
    /// let Err(LdlError::Indefinite(proof)) = p.ldl() else { panic!("det P = -243600") };
    /// assert_eq!(proof.witness.transpose().congruence(&p)[(0, 0)], proof.value);
    /// assert!(proof.value < Rational::from_integer(0.into()));
    /// ```
    pub fn ldl(&self) -> Result<Ldl<S>, LdlError<S>> {
        if let Some((row, column)) = self.asymmetry() {
            return Err(LdlError::Asymmetric { row, column });
        }
        let n = self.rows();
        let zero = S::zero();
        let mut schur = self.clone();
        let mut ldl = Ldl { lower: Matrix::identity(n), pivots: Vec::with_capacity(n) };
        for k in 0..n {
            let pivot = schur[(k, k)].clone();
            if pivot < zero {
                return Err(self.indefinite(ldl.lifted(k, &[(k, S::one())])));
            }
            if pivot.is_zero() {
                if let Some(j) = (k + 1..n).find(|&j| !schur[(j, k)].is_zero()) {
                    return Err(self.indefinite(ldl.lifted(k, &null_pivot_witness(&schur, k, j))));
                }
            } else {
                eliminate(&mut schur, &mut ldl.lower, k, &pivot);
            }
            ldl.pivots.push(pivot);
        }
        Ok(ldl)
    }

    fn indefinite(&self, witness: Matrix<S>) -> LdlError<S> {
        let value = witness.transpose().congruence(self)[(0, 0)].clone();
        LdlError::Indefinite(Indefinite { witness, value })
    }

    /// The Loewner order: whether `other − self` is positive semidefinite.
    ///
    /// AK-Order: `F ≥ G  ⇔  F − G is positive semidefinite, for symmetric F and G`
    ///
    /// # Errors
    ///
    /// As for [`Matrix::ldl`] of the difference: a witness v has vᵀ(other − self)v < 0.
    ///
    /// # Panics
    ///
    /// If the shapes differ.
    pub fn loewner_le(&self, other: &Self) -> Result<(), LdlError<S>> {
        (other - self).ldl().map(drop)
    }
}

/// Subtracts the rank-one part of pivot k from the rows below it and records the multipliers.
fn eliminate<S: OrderedField>(schur: &mut Matrix<S>, lower: &mut Matrix<S>, k: usize, pivot: &S) {
    for i in k + 1..schur.rows() {
        let Ok(multiplier) = schur[(i, k)].over(pivot) else { unreachable!("the pivot is positive") };
        for j in k + 1..=i {
            let rest = schur[(i, j)].minus(&multiplier.times(&schur[(j, k)]));
            schur[(i, j)] = rest.clone();
            schur[(j, i)] = rest;
        }
        lower[(i, k)] = multiplier;
    }
}

/// A zero pivot beside an entry s ≠ 0: on the block [[0, s], [s, t]] the vector (−(t+1)/(2s), 1) has the
/// value −1.
fn null_pivot_witness<S: OrderedField>(schur: &Matrix<S>, k: usize, j: usize) -> [(usize, S); 2] {
    let twice = schur[(j, k)].plus(&schur[(j, k)]);
    let Ok(part) = schur[(j, j)].plus(&S::one()).over(&twice) else { unreachable!("s is not zero") };
    [(k, part.negated()), (j, S::one())]
}
