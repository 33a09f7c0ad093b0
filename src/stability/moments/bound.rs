//! A bound of a moment that holds at every time, proved by gains that need not be those of the filter.

use crate::matrix::Matrix;
use crate::scalar::{Rational, Scalar};
use crate::stability::ModeProcess;

/// Proof that `E‖P(k)‖ˢ ≤ E(tr P(k))ˢ ≤ bound` for all k ≥ 0.
///
/// One gain K(i) for each mode bounds the filter from above (WG-52): P(k+1) ≤ A(i)P(k)A(i)ᵀ + N(i) with A(i) = F(i)(I − K(i)H(i)) and
/// N(i) = F(i)K(i)R(i)K(i)ᵀF(i)ᵀ + Q(i). If the moments of order 2s of x(k+1) = A(i)x(k) contract, those of order s of this bound converge.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MomentBound {
    /// s.
    pub order: usize,
    /// K, d×m, one for each mode.
    pub gains: Vec<Matrix<Rational>>,
    /// For s = 1, one for each mode: X(j) > 0 with X(j) − ∑ T(i, j) A(i)X(i)A(i)ᵀ = I over reachable modes i; zero for modes never
    /// reached. That A(i) contract is proved by these (LDLᵀ), for s > 1 by the characteristic polynomial of
    /// [`ModeProcess::moment_operator`].
    pub lyapunov: Vec<Matrix<Rational>>,
    /// What E(tr P(k))ˢ never exceeds.
    pub bound: Rational,
}

impl ModeProcess<Rational> {
    /// The bound of the moment of order s that these gains prove, for the start P(0) ≥ 0; nothing if they prove none.
    ///
    /// The upper triangle u of the bound of P follows u ← B(i)u + c(i), so the monomials of degree up to s in u follow a linear
    /// recursion, mode by mode: m ← Lm + b with ρ(L) < 1. Its fixed point bounds all m if it bounds the first ones; else
    /// (I − L)⁻¹(b + m₀) does. The order is that of the cone of symmetric tensors of semidefinite matrices, which L preserves and on which
    /// the trace is monotone.
    ///
    /// Shapes: one gain d×m for each mode, start d×d. One linear system of order n·C(d(d+1)/2 + s, s) for n reachable modes.
    ///
    /// # Panics
    ///
    /// If the shapes do not fit, or s is zero.
    pub fn moment_bound_under(
        &self,
        gains: &[Matrix<Rational>],
        order: usize,
        start: &Matrix<Rational>,
    ) -> Option<MomentBound> {
        assert!(order > 0, "the moment of order zero is one");
        let reachable = self.reachable();
        let closed: Vec<Matrix<Rational>> =
            self.modes().iter().zip(gains).map(|(mode, gain)| mode.closed_loop(gain)).collect();
        let lyapunov = if order == 1 {
            self.lyapunov_certificate(&reachable, &closed)?
        } else {
            let operator = self.moment_operator(&reachable, &closed, 2 * order);
            operator.spectral_radius_lt(&Scalar::one()).then(Vec::new)?
        };
        let bound = self.stationary_trace(&reachable, gains, order, start);
        Some(MomentBound { order, gains: gains.to_vec(), lyapunov, bound })
    }

    /// X(j) > 0 with X(j) − ∑ T(i, j) A(i)X(i)A(i)ᵀ = I: there are some exactly if the second moments contract.
    fn lyapunov_certificate(&self, modes: &[usize], closed: &[Matrix<Rational>]) -> Option<Vec<Matrix<Rational>>> {
        let d = self.states();
        let blocks: Vec<_> = modes.iter().map(|&mode| triangle_map(&closed[mode])).collect();
        let operator = self.coupled(modes, &blocks);
        let unit = triangle(&Matrix::identity(d));
        let right = modes.iter().map(|_| unit.clone()).reduce(|above, below| above.above(&below))?;
        let solution = (Matrix::identity(operator.rows()) - operator).solve(&right).ok()?;
        let mut certificate = vec![Matrix::zeros(d, d); self.modes().len()];
        for (place, &mode) in modes.iter().enumerate() {
            let x = folded(d, &solution, place);
            if !x.ldl().is_ok_and(|ldl| ldl.is_positive_definite()) {
                return None;
            }
            certificate[mode] = x;
        }
        Some(certificate)
    }

    fn stationary_trace(
        &self,
        modes: &[usize],
        gains: &[Matrix<Rational>],
        order: usize,
        start: &Matrix<Rational>,
    ) -> Rational {
        let d = self.states();
        let powers: Vec<Matrix<Rational>> = modes.iter().map(|&i| self.affine_power(i, &gains[i], order)).collect();
        // The last monomial is 1: its moment is the probability of the mode.
        let rest = powers[0].rows() - 1;
        let linear: Vec<_> = powers.iter().map(|power| power.block(0..rest, 0..rest)).collect();
        let weights = self.largest_probabilities();
        let first = triangle(start).above(&Matrix::identity(1)).symmetric_power(order);
        let stacked = |of: &dyn Fn(usize, usize) -> Rational| {
            Matrix::from_fn(modes.len() * rest, 1, |row, _| of(row / rest, row % rest))
        };
        let new = stacked(&|to, row| {
            let part = |from: usize| {
                let share = self.transition()[(modes[from], modes[to])].times(&weights[modes[from]]);
                share.times(&powers[from][(row, rest)])
            };
            (0..modes.len()).map(part).fold(Rational::zero(), |sum, term| sum.plus(&term))
        });
        let old = stacked(&|to, row| self.initial()[modes[to]].times(&first[(row, 0)]));
        let system = Matrix::identity(modes.len() * rest) - self.coupled(modes, &linear);
        let solved = |right: &Matrix<Rational>| match system.solve(right) {
            Ok(solution) => solution,
            Err(error) => unreachable!("lower moments contract where higher ones do: {error}"),
        };
        let mut moments = solved(&new);
        let dominates = if d == 1 {
            moments.entries().iter().zip(old.entries()).all(|(after, before)| after >= before)
        } else {
            order == 1
                && (0..modes.len()).all(|place| folded(d, &old, place).loewner_le(&folded(d, &moments, place)).is_ok())
        };
        if !dominates {
            moments = solved(&(new + old));
        }
        let trace = triangle(&Matrix::identity(d)).transpose().beside(&Matrix::zeros(1, 1)).symmetric_power(order);
        let term = |row: usize| trace[(0, row % rest)].times(&moments[(row, 0)]);
        (0..moments.rows()).map(term).fold(Rational::zero(), |sum, term| sum.plus(&term))
    }

    /// What u ← B u + c of a mode under a gain does to the monomials of degree up to s, written as those of degree s in (u, 1).
    fn affine_power(&self, mode: usize, gain: &Matrix<Rational>, order: usize) -> Matrix<Rational> {
        let mode = &self.modes()[mode];
        let map = triangle_map(&mode.closed_loop(gain)).beside(&triangle(&mode.closed_loop_noise(gain)));
        let constant = Matrix::zeros(1, map.columns() - 1).beside(&Matrix::identity(1));
        map.above(&constant).symmetric_power(order)
    }

    /// What the probability of each mode never exceeds: itself if the initial law is stationary, else 1.
    fn largest_probabilities(&self) -> Vec<Rational> {
        let law = Matrix::column(self.initial().to_vec()).transpose();
        let stationary = &law * self.transition() == law;
        self.initial().iter().map(|own| if stationary { own.clone() } else { Scalar::one() }).collect()
    }
}

/// The entries on and above the diagonal, row by row, as a column.
fn triangle(matrix: &Matrix<Rational>) -> Matrix<Rational> {
    let d = matrix.rows();
    Matrix::column((0..d).flat_map(|i| (i..d).map(move |j| (i, j))).map(|place| matrix[place].clone()).collect())
}

/// The symmetric matrix of the triangle that is the given part of a column.
fn folded(d: usize, column: &Matrix<Rational>, part: usize) -> Matrix<Rational> {
    let size = d * (d + 1) / 2;
    Matrix::from_fn(d, d, |i, j| {
        let (i, j) = (i.min(j), i.max(j));
        column[(part * size + i * d - i * (i + 1) / 2 + j, 0)].clone()
    })
}

/// X ↦ AXAᵀ on triangles.
fn triangle_map(a: &Matrix<Rational>) -> Matrix<Rational> {
    let d = a.rows();
    let size = d * (d + 1) / 2;
    let unit = |k: usize| Matrix::from_fn(size, 1, |row, _| if row == k { Scalar::one() } else { Scalar::zero() });
    let image = |k: usize| triangle(&a.congruence(&folded(d, &unit(k), 0)));
    let columns = (0..size).map(image).reduce(|left, right| left.beside(&right));
    columns.unwrap_or_else(|| Matrix::zeros(0, 0))
}
