//! How far the Gramians of all windows are from singular.

use crate::matrix::Matrix;
use crate::scalar::OrderedField;
use crate::stability::{ModeProcess, TooManySubspaces, UnobservablePath, Window};

/// How often two Gramians may be compared, for each that may be kept.
const COMPARISONS: usize = 10;

/// Why there is no δ.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MarginError<S> {
    /// Along a path of positive probability G is singular: A1 fails with this h.
    #[error("the Gramian of the modes {:?} is singular", .0.modes)]
    Unobservable(UnobservablePath<S>),
    /// There are more different Gramians than allowed, or comparing them takes too long.
    #[error("too many different Gramians for a limit of {limit}")]
    TooManyGramians {
        /// How many were allowed.
        limit: usize,
    },
    /// The search for a singular one was given up.
    #[error(transparent)]
    TooManySubspaces(#[from] TooManySubspaces),
}

impl<S: OrderedField> ModeProcess<S> {
    /// δ > 0 with `G(k+h,k) − δI > 0` along every path of positive probability: A1 holds with this δ for every ε.
    ///
    /// WG-A1: `for every ε > 0 there is δ > 0 with Pr{λ_min(G(k+h,k)) > δ | 𝒢(k−1)} > 1 − ε for all k`
    ///
    /// Half the smallest 1/tr G⁻¹, so within 2d of the largest possible: `1/tr G⁻¹ ≤ λ_min(G) ≤ d/tr G⁻¹`. The Gramian of
    /// the path i, j, … is `HᵀH + FᵀG′F`, G′ being that of j, …, and grows with G′: so of the Gramians that begin
    /// at one mode only those matter that are above no other. `most` is the number of Gramians
    /// that may be kept at a time, and a tenth of the number of times that two may be compared.
    ///
    /// # Errors
    ///
    /// [`MarginError`]: with the path whose Gramian is singular, or because a limit is reached.
    pub fn gramian_margin(&self, window: Window, length: usize, most: usize) -> Result<S, MarginError<S>> {
        let verdict = self.observability(window, length, most)?;
        if let Some(failure) = verdict.failures.into_iter().next() {
            return Err(MarginError::Unobservable(failure));
        }
        let d = self.states();
        let reachable = self.reachable();
        let mut gramians = vec![vec![Matrix::zeros(d, d)]; self.modes().len()];
        let too_many = || MarginError::TooManyGramians { limit: most };
        let mut comparisons = most.saturating_mul(COMPARISONS);
        let mut before = |gramians: &Vec<Vec<Matrix<S>>>, mode: usize, seen: &dyn Fn(Matrix<S>) -> Matrix<S>| {
            let back = self.modes()[mode].transition().transpose();
            let after = self.successors(mode).flat_map(|next| &gramians[next]);
            smallest(after.map(|gramian| seen(back.congruence(gramian))), &mut comparisons).ok_or_else(too_many)
        };
        for _ in 0..length {
            let mut longer = vec![Vec::new(); self.modes().len()];
            for &mode in &reachable {
                let observation = self.modes()[mode].observation();
                let information = observation.transpose() * observation;
                longer[mode] = before(&gramians, mode, &|carried| carried + &information)?;
            }
            gramians = longer;
            if gramians.iter().map(Vec::len).sum::<usize>() > most {
                return Err(too_many());
            }
        }
        if window == Window::Printed {
            gramians =
                reachable.iter().map(|&mode| before(&gramians, mode, &|carried| carried)).collect::<Result<_, _>>()?;
        }
        let margins = gramians.iter().flatten().map(half_margin);
        Ok(margins.min().unwrap_or_else(S::one))
    }
}

/// 1/(2 tr G⁻¹).
fn half_margin<S: OrderedField>(gramian: &Matrix<S>) -> S {
    let twice = S::one().plus(&S::one());
    let Ok(inverse) = gramian.inverse() else { unreachable!("no path is unobservable") };
    S::one().over(&twice.times(&inverse.trace())).unwrap_or_else(|_| S::one())
}

/// The members that are above no other, each once; nothing if that takes more comparisons than are left.
fn smallest<S: OrderedField>(
    family: impl Iterator<Item = Matrix<S>>,
    comparisons: &mut usize,
) -> Option<Vec<Matrix<S>>> {
    let mut kept: Vec<Matrix<S>> = Vec::new();
    for matrix in family {
        *comparisons = comparisons.checked_sub(2 * kept.len())?;
        if !kept.iter().any(|smaller| smaller.loewner_le(&matrix).is_ok()) {
            kept.retain(|larger| matrix.loewner_le(larger).is_err());
            kept.push(matrix);
        }
    }
    Some(kept)
}
