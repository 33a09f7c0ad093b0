//! Full-rank factorisation and the Moore–Penrose pseudo-inverse.

use super::{Echelon, Matrix, SolveError, Undecided};
use crate::scalar::Scalar;

/// `P = U V` with U of full column rank and V of full row rank, both of the rank of P.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FullRank<S> {
    /// The left factor, rows of P × rank.
    pub left: Matrix<S>,
    /// The right factor, rank × columns of P.
    pub right: Matrix<S>,
}

/// Why there is no pseudo-inverse to hand out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PseudoInverseError {
    /// A Gram matrix of a full-rank factor is singular. Over an ordered field this cannot happen; over a
    /// prime field it means that none exists: rank P = rank PPᵀ = rank PᵀP fails.
    #[error("no pseudo-inverse exists: a Gram matrix of rank {rank} where the matrix has rank {order}")]
    DoesNotExist {
        /// The rank of the Gram matrix.
        rank: usize,
        /// The rank of the matrix.
        order: usize,
    },
    /// The rank cannot be decided.
    #[error(transparent)]
    Undecided(#[from] Undecided),
}

impl From<SolveError> for PseudoInverseError {
    fn from(error: SolveError) -> Self {
        match error {
            SolveError::Singular { rank, order } => Self::DoesNotExist { rank, order },
            SolveError::Undecided(undecided) => Self::Undecided(undecided),
        }
    }
}

impl<S: Scalar> Matrix<S> {
    /// A full-rank factorisation: U holds the pivot columns, V the nonzero rows of the reduced echelon form.
    ///
    /// Shapes: `self` m×n of rank r, U m×r, V r×n. Rank 0 gives empty factors.
    ///
    /// # Errors
    ///
    /// [`Undecided`] if the rank cannot be decided; never on a field.
    pub fn full_rank_factorisation(&self) -> Result<FullRank<S>, Undecided> {
        let echelon = Echelon::of(self, self.columns())?;
        Ok(FullRank { left: self.select_columns(echelon.pivots()), right: echelon.reduced()? })
    }

    /// The Moore–Penrose pseudo-inverse, by full-rank factorisation.
    ///
    /// CKS-L3-pinv: `PP⁺P = P, P⁺ = UPᵀ = PᵀV for some U, V`
    ///
    /// HV-L3: `P⁺ = Vᵀ(VVᵀ)⁻¹(UᵀU)⁻¹Uᵀ where P = UV has full rank; 0⁺ = 0`
    ///
    /// Shapes: `self` m×n, result n×m.
    ///
    /// # Errors
    ///
    /// [`PseudoInverseError::DoesNotExist`] over a field in which nonzero vectors may be orthogonal to
    /// themselves, [`PseudoInverseError::Undecided`] if the rank cannot be decided; never over the rationals.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}};
    ///
    /// let p = Matrix::<Rational>::from_integers(&[[1, 1], [1, 1]]);
    /// assert_eq!(p.pseudo_inverse()?, p.scaled(&ratio(1, 4)));
    /// # Ok::<(), exact_kalman::matrix::PseudoInverseError>(())
    /// ```
    pub fn pseudo_inverse(&self) -> Result<Self, PseudoInverseError> {
        let FullRank { left: u, right: v } = self.full_rank_factorisation()?;
        let (ut, vt) = (u.transpose(), v.transpose());
        let inner = (&v * &vt).solve(&(&ut * &u).solve(&ut)?)?;
        Ok(vt * inner)
    }

    /// The product of the nonzero eigenvalues of a positive semidefinite matrix: its determinant if it is
    /// regular, one for the zero matrix.
    ///
    /// With `P = UV` of full rank it is `det(VU)`, since UV and VU share their nonzero eigenvalues.
    ///
    /// # Errors
    ///
    /// [`Undecided`] if the rank cannot be decided; never on a field.
    ///
    /// # Panics
    ///
    /// If the matrix is not square.
    pub fn pseudo_determinant(&self) -> Result<S, Undecided> {
        assert!(self.is_square(), "a {} matrix has no determinant", self.shape());
        let FullRank { left, right } = self.full_rank_factorisation()?;
        (right * left).determinant()
    }
}
