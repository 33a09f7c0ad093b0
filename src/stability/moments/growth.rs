//! Moments that grow without bound, proved by what is never observed.

use crate::matrix::Matrix;
use crate::scalar::{Rational, Scalar, ratio};
use crate::stability::ModeProcess;

/// With more reachable modes only those that observe nothing at all are looked at, not every set of modes.
const MOST_MODES_FOR_SUBSETS: usize = 8;
/// So many ranges of P(k) are kept for each mode.
const MOST_RANGES: usize = 32;
/// Halvings of the bracket in which a spectral radius above one is looked for.
const HALVINGS: usize = 30;

/// Proof that `sup_k E‖P(k)‖ˢ = ∞`.
///
/// On paths within `modes`, the directions `subspace` are never observed (H(i)V = 0) and never left (F(i)V = VA(i)). So P(k) ≥
/// V Z(k) Vᵀ with Z(k+1) = A(i)Z(k)A(i)ᵀ on such paths. The moments of Z go from step to step by L,
/// [`ModeProcess::moment_operator`] of the A(i) of degree 2s, which preserves a cone; the mean of a functional Y with LᵀY = ρ(L)Y is
/// multiplied by ρ(L). If ρ(L) > 1, it grows without bound as soon as at some time, with positive probability, Z ≥ εI with
/// ε > 0 and one of the modes is next. If ρ(L) = 1, it does if the modes come back for ever and all their Q(i) > 0, so that
/// Z(k+1) = A(i)Z(k)A(i)ᵀ + εI: then what is added has an infinite sum.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MomentGrowth {
    /// s.
    pub order: usize,
    /// Modes that are reached and communicate.
    pub modes: Vec<usize>,
    /// V, d×v: a basis of the largest such subspace.
    pub subspace: Matrix<Rational>,
    /// What ρ(L) is not below: at least 1, and above 1 unless the modes come back for ever and Q(i) > 0 in each.
    pub radius: Rational,
    /// Whether the modes come back for ever ([`ModeProcess::recurrent`]).
    pub recurrent: bool,
}

impl ModeProcess<Rational> {
    /// Proof that the moment of order s of P(k) grows without bound whatever P(0) ≥ 0 is, if there is one of this kind.
    ///
    /// All sets of modes that communicate are tried if there are at most eight reachable modes; else the classes of those
    /// with H = 0. Exact and complete for one state where every Q > 0, but for one case: modes that are left for good with a spectral
    /// radius of one, or above it by less than 2⁻³⁰. With n modes and v unobserved directions: characteristic polynomials of order
    /// n·C(v+2s−1, 2s), for at most 2ⁿ sets.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}, stability::{Mode, ModeProcess}};
    ///
    /// let scalar = |value| Matrix::<Rational>::diagonal(&[value]);
    /// let mode = |h| Mode::new(scalar(ratio(3, 2)), scalar(ratio(h, 1)), scalar(ratio(1, 1)), scalar(ratio(1, 1)));
    /// let link = ModeProcess::independent(vec![mode(0)?, mode(1)?], vec![ratio(1, 4), ratio(3, 4)])?;
    /// // (1/4)(3/2)² < 1 < (1/4)(3/2)⁴
    /// assert!(link.moment_growth(1).is_none());
    /// assert!(link.moment_growth(2).is_some());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Panics
    ///
    /// If s is zero.
    pub fn moment_growth(&self, order: usize) -> Option<MomentGrowth> {
        self.moment_growth_from(order, &Matrix::zeros(self.states(), self.states()))
    }

    /// The same, for this start P(0) ≥ 0 and all that are larger.
    ///
    /// # Panics
    ///
    /// If s is zero, or the start is not d×d.
    pub fn moment_growth_from(&self, order: usize, start: &Matrix<Rational>) -> Option<MomentGrowth> {
        assert!(order > 0, "the moment of order zero is one");
        let reachable = self.reachable();
        let ranges = self.ranges(start);
        let mut slow: Vec<(Vec<usize>, Matrix<Rational>)> = Vec::new();
        for modes in self.candidate_sets(&reachable) {
            let subspace = self.unobserved(&modes);
            let covered = |(others, other): &(Vec<usize>, Matrix<Rational>)| {
                *other == subspace && modes.iter().all(|mode| others.contains(mode))
            };
            if subspace.columns() == 0 || slow.iter().any(covered) {
                continue;
            }
            let Some(radius) = self.radius_within(&modes, &subspace, order) else {
                slow.push((modes, subspace));
                continue;
            };
            let recurrent = self.recurrent(&modes);
            let begins = |mode: &usize| ranges[*mode].iter().any(|range| contains(range, &subspace));
            let grows = if radius > ratio(1, 1) {
                modes.iter().any(begins)
            } else {
                recurrent && modes.iter().all(|&mode| self.is_excited(mode))
            };
            if grows {
                return Some(MomentGrowth { order, modes, subspace, radius, recurrent });
            }
        }
        None
    }

    /// Sets of modes that communicate, large ones first.
    fn candidate_sets(&self, reachable: &[usize]) -> Vec<Vec<usize>> {
        let mut sets: Vec<Vec<usize>> = if reachable.len() <= MOST_MODES_FOR_SUBSETS {
            let chosen = |set: usize| reachable.iter().enumerate().filter(move |(i, _)| set >> i & 1 == 1);
            (1..1_usize << reachable.len()).map(|set| chosen(set).map(|(_, &mode)| mode).collect()).collect()
        } else {
            let blind = |mode: &usize| self.modes()[*mode].observation().is_zero();
            self.classes(&reachable.iter().copied().filter(blind).collect::<Vec<_>>())
        };
        sets.retain(|modes| self.communicate(modes));
        sets.sort_by_key(|modes| std::cmp::Reverse(modes.len()));
        sets
    }

    /// Q(i) > 0.
    fn is_excited(&self, mode: usize) -> bool {
        let ldl = self.modes()[mode].process_noise().ldl();
        ldl.is_ok_and(|ldl| ldl.is_positive_definite())
    }

    /// For each mode, subspaces (as columns) on which P(k) > 0 at some time with positive probability when the mode is next.
    ///
    /// Where R(i) > 0 or H(i) = 0, no direction is observed without error: the range of P(k+1) is F(i) times that of P(k) and the range
    /// of Q(i). Elsewhere only the latter is counted on.
    fn ranges(&self, start: &Matrix<Rational>) -> Vec<Vec<Matrix<Rational>>> {
        let mut found: Vec<Vec<Matrix<Rational>>> = vec![Vec::new(); self.modes().len()];
        let first = (0..found.len()).filter(|&mode| self.initial()[mode] > ratio(0, 1));
        let mut pending: Vec<(usize, Matrix<Rational>)> = first.map(|mode| (mode, start.clone())).collect();
        while let Some((next, range)) = pending.pop() {
            if found[next].len() >= MOST_RANGES || found[next].iter().any(|known| contains(known, &range)) {
                continue;
            }
            let mode = &self.modes()[next];
            let noisy = mode.observation_noise().ldl().is_ok_and(|ldl| ldl.is_positive_definite());
            let after = if noisy || mode.observation().is_zero() {
                spanning(&(mode.transition() * &range).beside(mode.process_noise()))
            } else {
                spanning(mode.process_noise())
            };
            pending.extend(self.successors(next).map(|to| (to, after.clone())));
            found[next].push(range);
        }
        found
    }

    /// A basis of the largest subspace that no H of these modes sees and no F of them leaves; 0 columns if there is none.
    fn unobserved(&self, modes: &[usize]) -> Matrix<Rational> {
        let of = |mode: usize| &self.modes()[mode];
        let Some(mut seen) = modes.iter().map(|&i| of(i).observation().clone()).reduce(|all, more| all.above(&more))
        else {
            return Matrix::zeros(self.states(), 0);
        };
        let mut rank = seen.rank();
        loop {
            let next =
                modes.iter().map(|&i| &seen * of(i).transition()).fold(seen.clone(), |all, more| all.above(&more));
            let next_rank = next.rank();
            if next_rank == rank {
                return seen.kernel();
            }
            (seen, rank) = (next, next_rank);
        }
    }

    /// What the spectral radius of L within these modes is not below; nothing if it is below one.
    fn radius_within(&self, modes: &[usize], subspace: &Matrix<Rational>, order: usize) -> Option<Rational> {
        let projection = (subspace.transpose() * subspace).solve(&subspace.transpose());
        let Ok(projection) = projection else { unreachable!("a basis") };
        // A(i) with F(i)V = VA(i).
        let restricted: Vec<_> = self.modes().iter().map(|mode| &projection * mode.transition() * subspace).collect();
        radius_at_least(&self.moment_operator(modes, &restricted, 2 * order))
    }
}

/// Whether the columns of the second are combinations of those of the first.
fn contains(range: &Matrix<Rational>, subspace: &Matrix<Rational>) -> bool {
    range.beside(subspace).rank() == range.rank()
}

/// Columns with the same span, no more than needed.
fn spanning(columns: &Matrix<Rational>) -> Matrix<Rational> {
    let Ok(factors) = columns.full_rank_factorisation() else { unreachable!("a field decides zero") };
    factors.left
}

/// A number that the spectral radius is not below, close to it: nothing if the radius is below one.
fn radius_at_least(operator: &Matrix<Rational>) -> Option<Rational> {
    let one = ratio(1, 1);
    if operator.spectral_radius_lt(&one) {
        return None;
    }
    let (mut lower, mut upper) = (one.clone(), ratio(2, 1));
    while !operator.spectral_radius_lt(&upper) {
        (lower, upper) = (upper.clone(), upper.times(&upper));
    }
    // Eight bits are enough to read; a radius just above one may take more until it is told from one.
    for halving in 0..HALVINGS {
        if halving >= 8 && lower > one {
            break;
        }
        let middle = lower.plus(&upper).times(&ratio(1, 2));
        if operator.spectral_radius_lt(&middle) { upper = middle } else { lower = middle }
    }
    Some(lower)
}
