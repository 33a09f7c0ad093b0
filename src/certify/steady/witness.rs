//! What proves a steady state, for somebody else to check.

use num_bigint::BigInt;

use super::Dyadics;
use super::proof::Proof;
use crate::matrix::Matrix;
use crate::scalar::Dyadic;

/// S̃, E, K̃, T, X, r² and β of the proof; matrices are integers times a power of two.
#[derive(Clone, Debug)]
pub struct SteadyWitness {
    /// S̃, n×n, symmetric.
    pub solution: (Matrix<BigInt>, i64),
    /// E, n×n, symmetric.
    pub gap: (Matrix<BigInt>, i64),
    /// K̃, n×m, for the sensors that are kept.
    pub gain: (Matrix<BigInt>, i64),
    /// T, m×m, for the same.
    pub whitening: (Matrix<BigInt>, i64),
    /// X, n×n, symmetric.
    pub shape: (Matrix<BigInt>, i64),
    /// r²
    pub rate_squared: Dyadic,
    /// k, with β = 2⁻ᵏ; nothing where the gain is exact and E = 0.
    pub balance: Option<i64>,
}

impl SteadyWitness {
    pub(super) fn of(proof: &Proof) -> Self {
        let parts = |matrix: &Dyadics| (matrix.mantissas.clone(), matrix.exponent);
        Self {
            solution: parts(&proof.reading.point),
            gap: parts(&proof.gap),
            gain: parts(&proof.image.gain),
            whitening: parts(&proof.reading.whitening),
            shape: parts(&proof.shape),
            rate_squared: proof.rate_squared.clone(),
            balance: proof.balance,
        }
    }
}
