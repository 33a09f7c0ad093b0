//! Products of random matrices that depend on the mode: moments, and exponential bounds with their constants.

use crate::matrix::Matrix;
use crate::scalar::OrderedField;
use crate::stability::ModeProcess;

impl<S: OrderedField> ModeProcess<S> {
    /// The operator that takes the moments of degree n of x(k), mode by mode, to those of x(k+1) = A(σ(k)) x(k).
    ///
    /// The moments of a mode j are `E x(k)^[n] 1{σ(k) = j}` for the monomials of [`Matrix::symmetric_power`]; block (j, i) of
    /// the operator is `T(i, j) A(i)^[n]`. Only paths within the given modes count.
    ///
    /// Shapes: one matrix for each mode of the process, all d×d; of order |modes|·C(d+n−1, n).
    ///
    /// # Panics
    ///
    /// If there is a mode without a matrix.
    pub fn moment_operator(&self, modes: &[usize], matrices: &[Matrix<S>], degree: usize) -> Matrix<S> {
        let powers: Vec<Matrix<S>> = modes.iter().map(|&mode| matrices[mode].symmetric_power(degree)).collect();
        self.coupled(modes, &powers)
    }

    /// Block (j, i) is `T(i, j) B(i)`, for one square B for each of the given modes.
    pub(in crate::stability) fn coupled(&self, modes: &[usize], blocks: &[Matrix<S>]) -> Matrix<S> {
        let size = blocks.first().map_or(0, Matrix::rows);
        Matrix::from_fn(modes.len() * size, modes.len() * size, |row, column| {
            let (to, from) = (row / size, column / size);
            self.transition()[(modes[from], modes[to])].times(&blocks[from][(row % size, column % size)])
        })
    }

    /// A constant M with `E‖A(σ(i+n))⋯A(σ(i+1))‖²ˢ ≤ M λⁿ` for all i and n ≥ 0 and every law of the first mode.
    ///
    /// WG-51: `‖∏[j=i+1..k] A(j)‖_r ≤ M λ^(k−i) for all k ≥ i ≥ 0`
    ///
    /// Here r = 2s, and M and λ are the r-th powers of those; stability in the sense of WG-D2.1 is that there is an M for some λ < 1.
    /// There is one for each λ > ρ(L) and for no λ < ρ(L), with the operator L of [`ModeProcess::moment_operator`] of degree 2s.
    /// For λ > ρ(L) put X = (λI − L)⁻¹v: Lⁿv ≤ λⁿ⁺¹X in the order of the cone of moments, which L preserves. With v the moments of
    /// the unit vectors this gives M, since `‖A‖²ˢ ≤ (∑ aᵢⱼ²)ˢ ≤ d^(2s−2) ∑ aᵢⱼ²ˢ`. Nothing if ρ(L) ≥ λ.
    ///
    /// Shapes: as for [`ModeProcess::moment_operator`], with a matrix for each reachable mode.
    ///
    /// # Panics
    ///
    /// If there is a mode without a matrix, or s is zero.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}, stability::{Mode, ModeProcess}};
    ///
    /// let scalar = |value| Matrix::<Rational>::diagonal(&[value]);
    /// let mode = || Mode::new(scalar(ratio(1, 1)), scalar(ratio(1, 1)), scalar(ratio(1, 1)), scalar(ratio(1, 1)));
    /// let coin = ModeProcess::independent(vec![mode()?, mode()?], vec![ratio(1, 2), ratio(1, 2)])?;
    /// // The mean square of a factor is (1/4 + 1)/2 = 5/8.
    /// let factors = [scalar(ratio(1, 2)), scalar(ratio(1, 1))];
    /// assert!(coin.product_bound(&factors, 1, &ratio(5, 8)).is_none());
    /// assert!(coin.product_bound(&factors, 1, &ratio(6, 8)).is_some());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn product_bound(&self, matrices: &[Matrix<S>], half_order: usize, rate: &S) -> Option<S> {
        assert!(half_order > 0, "no moment of order zero");
        let modes = self.reachable();
        let operator = self.moment_operator(&modes, matrices, 2 * half_order);
        if !operator.spectral_radius_lt(rate) {
            return None;
        }
        let (states, count) = (self.states(), modes.len());
        let size = operator.rows() / count;
        // The monomials of the unit vectors: one of them, xᵢ²ˢ, is 1.
        let unit = |i: usize| Matrix::<S>::identity(states).block(0..states, i..i + 1).symmetric_power(2 * half_order);
        let units = (0..states).map(unit).reduce(|sum, unit| sum + unit)?;
        // Column u: the moments of all unit vectors in mode u.
        let starts = Matrix::from_fn(operator.rows(), count, |row, mode| {
            if row / size == mode { units[(row % size, 0)].clone() } else { S::zero() }
        });
        let system = Matrix::identity(operator.rows()).scaled(rate) - operator;
        let Ok(solution) = system.solve(&starts) else { unreachable!("the spectral radius is below the rate") };
        let of_start = |mode: usize| {
            let entry = |row: usize| units[(row % size, 0)].times(&solution[(row, mode)]);
            (0..solution.rows()).map(entry).fold(S::zero(), |sum, term| sum.plus(&term))
        };
        let largest = (0..count).map(of_start).max()?;
        let squared_states = S::from_integer(i64::try_from(states * states).unwrap_or(i64::MAX));
        let factor = (1..half_order).fold(rate.clone(), |power, _| power.times(&squared_states));
        Some(largest.times(&factor))
    }
}
