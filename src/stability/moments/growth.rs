//! Moments that grow without bound, proved by what is never observed.

use crate::matrix::Matrix;
use crate::scalar::{Rational, Scalar, ratio};
use crate::stability::ModeProcess;

/// With more reachable modes only those that observe nothing at all are looked at, not every set of modes.
const MOST_MODES_FOR_SUBSETS: usize = 8;
/// Halvings of the bracket in which a spectral radius above one is looked for.
const HALVINGS: usize = 30;

/// Proof that `sup_k E‖P(k)‖ˢ = ∞`, whatever P(0) ≥ 0 is.
///
/// On paths within `modes`, the directions `subspace` are never observed (H(i)V = 0) and never left (F(i)V = VA(i)). So P(k) ≥
/// V Z(k) Vᵀ with Z(k+1) = A(i)Z(k)A(i)ᵀ + εI there and Z = 0 after any other mode, where ε > 0 as Q(i) > 0. The moments of Z go from
/// step to step by an operator at least L, [`ModeProcess::moment_operator`] of the A(i) of degree 2s, which preserves a cone; the mean
/// of a functional Y with LᵀY = ρ(L)Y is multiplied by ρ(L) and added to. It grows without bound if ρ(L) > 1, and
/// if ρ(L) = 1 and the modes come back for ever, for then what is added has an infinite sum.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MomentGrowth {
    /// s.
    pub order: usize,
    /// Modes that are reached and communicate, with Q(i) > 0 for each.
    pub modes: Vec<usize>,
    /// V, d×v: a basis of the largest such subspace.
    pub subspace: Matrix<Rational>,
    /// What ρ(L) is not below: at least 1, and above 1 unless the modes come back for ever.
    pub radius: Rational,
    /// Whether the modes come back for ever ([`ModeProcess::recurrent`]).
    pub recurrent: bool,
}

impl ModeProcess<Rational> {
    /// Proof that the moment of order s of P(k) grows without bound, if there is one of this kind.
    ///
    /// All sets of modes that communicate are tried if there are at most eight reachable modes with Q > 0; else the classes of those
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
        assert!(order > 0, "the moment of order zero is one");
        let reachable = self.reachable();
        let mut tried: Vec<(Vec<usize>, Matrix<Rational>)> = Vec::new();
        for modes in self.candidate_sets(&reachable) {
            let subspace = self.unobserved(&modes);
            let covered = |(others, other): &(Vec<usize>, Matrix<Rational>)| {
                *other == subspace && modes.iter().all(|mode| others.contains(mode))
            };
            if subspace.columns() == 0 || tried.iter().any(covered) {
                continue;
            }
            if let Some(growth) = self.growth_within(&modes, &subspace, order) {
                return Some(growth);
            }
            tried.push((modes, subspace));
        }
        None
    }

    /// Sets of modes that communicate and excite every direction, large ones first.
    fn candidate_sets(&self, reachable: &[usize]) -> Vec<Vec<usize>> {
        let excited = |mode: &usize| {
            let ldl = self.modes()[*mode].process_noise().ldl();
            ldl.is_ok_and(|ldl| ldl.is_positive_definite())
        };
        let excited: Vec<usize> = reachable.iter().copied().filter(excited).collect();
        let mut sets: Vec<Vec<usize>> = if excited.len() <= MOST_MODES_FOR_SUBSETS {
            let chosen = |set: usize| excited.iter().enumerate().filter(move |(i, _)| set >> i & 1 == 1);
            (1..1_usize << excited.len()).map(|set| chosen(set).map(|(_, &mode)| mode).collect()).collect()
        } else {
            let blind = |mode: &usize| self.modes()[*mode].observation().is_zero();
            self.classes(&excited.iter().copied().filter(blind).collect::<Vec<_>>())
        };
        sets.retain(|modes| self.communicate(modes));
        sets.sort_by_key(|modes| std::cmp::Reverse(modes.len()));
        sets
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

    fn growth_within(&self, modes: &[usize], subspace: &Matrix<Rational>, order: usize) -> Option<MomentGrowth> {
        let projection = (subspace.transpose() * subspace).solve(&subspace.transpose());
        let Ok(projection) = projection else { unreachable!("a basis") };
        // A(i) with F(i)V = VA(i).
        let restricted: Vec<_> = self.modes().iter().map(|mode| &projection * mode.transition() * subspace).collect();
        let operator = self.moment_operator(modes, &restricted, 2 * order);
        let recurrent = self.recurrent(modes);
        let radius = radius_at_least(&operator)?;
        let one = ratio(1, 1);
        (recurrent || radius > one).then(|| MomentGrowth {
            order,
            modes: modes.to_vec(),
            subspace: subspace.clone(),
            radius,
            recurrent,
        })
    }
}

/// A number that the spectral radius is not below, close to it: nothing if the radius is below one.
fn radius_at_least(operator: &Matrix<Rational>) -> Option<Rational> {
    let one = ratio(1, 1);
    if operator.spectral_radius_lt(&one) {
        return None;
    }
    let (mut lower, mut upper) = (one.clone(), ratio(2, 1));
    while !operator.spectral_radius_lt(&upper) {
        (lower, upper) = (upper.clone(), upper.plus(&upper));
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
