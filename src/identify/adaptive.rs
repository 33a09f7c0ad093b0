//! The filter run on estimates.

use super::{EstimateError, Estimates, NoiseCovariances, Series, SingularTransition, estimates};
use crate::matrix::{Matrix, PseudoInverseError};
use crate::model::{Reading, Repair};
use crate::scalar::{Field, OrderedField};

/// x̂(k|k) and P̂(k).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Belief<S> {
    /// x̂(k|k), p×1.
    pub mean: Matrix<S>,
    /// P̂(k), p×p.
    pub covariance: Matrix<S>,
}

/// What stands for A, V and W at a step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EstimatedModel<S> {
    /// Â(k), p×p.
    pub transition: Matrix<S>,
    /// V̂(k) and Ŵ(k).
    pub noise: NoiseCovariances<S>,
}

/// One step of the adaptive filter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AdaptiveRecord<S> {
    /// k, counted from 1.
    pub step: usize,
    /// Â(k), V̂(k), Ŵ(k) as they were used.
    pub model: EstimatedModel<S>,
    /// Whether another matrix stands for V̂(k).
    pub process_repaired: bool,
    /// Whether another matrix stands for Ŵ(k).
    pub observation_repaired: bool,
    /// Ŝ(k), p×p.
    pub predicted_covariance: Matrix<S>,
    /// Δ̂(k), p×p.
    pub gain: Matrix<S>,
    /// x̂(k|k) and P̂(k).
    pub belief: Belief<S>,
}

/// Why a step of the adaptive filter could not be done.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Obstacle<S: std::fmt::Debug + std::fmt::Display> {
    /// Â(k) is singular, so there are no V̂(k) and Ŵ(k), and nothing is to stand in their place.
    #[error(transparent)]
    Singular(#[from] SingularTransition<S>),
    /// Ŝ(k) + Ŵ(k) has no pseudo-inverse: over finite fields only.
    #[error(transparent)]
    PseudoInverse(#[from] PseudoInverseError),
}

/// Why the adaptive filter stopped.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the adaptive filter stops at y({step}): {source}")]
pub struct AdaptiveError<S: std::fmt::Debug + std::fmt::Display + 'static> {
    /// k, counted from 1.
    pub step: usize,
    /// What is wrong there.
    pub source: Obstacle<S>,
    /// The steps before.
    pub computed: Vec<AdaptiveRecord<S>>,
}

impl<S: Field> Belief<S> {
    /// The step (2.3)–(2.4) with any matrices for A, V and W.
    ///
    /// AK-2.3a: `Ŝ(k) = Â(k)P̂(k−1)Â(k)ᵀ + V̂(k), k ≥ 1`
    ///
    /// AK-2.3b: `Δ̂(k) = Ŝ(k)(Ŝ(k) + Ŵ(k))⁺`
    ///
    /// AK-2.3c: `P̂(k) = (I − Δ̂(k))Ŝ(k)`
    ///
    /// AK-2.4: `x̂(k|k) = (I − Δ̂(k))Â(k)x̂(k−1|k−1) + Δ̂(k)y(k), k ≥ 1`
    ///
    /// Shapes: `y` p×1. Returned are Ŝ(k), Δ̂(k) and the belief after y(k).
    ///
    /// # Errors
    ///
    /// [`PseudoInverseError`] over a finite field; never over the rationals.
    ///
    /// # Panics
    ///
    /// If the shapes do not fit.
    pub fn advanced(
        &self,
        model: &EstimatedModel<S>,
        y: &Matrix<S>,
    ) -> Result<(Matrix<S>, Matrix<S>, Self), PseudoInverseError> {
        let EstimatedModel { transition: a, noise: NoiseCovariances { process: v, observation: w } } = model;
        let s = a.congruence(&self.covariance) + v;
        let gain = &s * (&s + w).pseudo_inverse()?;
        let rest = Matrix::identity(s.rows()) - &gain;
        let belief = Self { mean: &rest * (a * &self.mean) + &gain * y, covariance: rest * &s };
        Ok((s, gain, belief))
    }
}

/// The filter on the estimates from the data up to each step: from k = 3 on, under [`Repair::Keep`] from k = p + 2 on.
///
/// AK-2.3-start: `P̂(0) is any positive semidefinite matrix`
///
/// There are no estimates before k = 3, so `start` is x̂(2|2) and P̂(2). Â(k) has a rank of at most k − 2, so V̂(k) and
/// Ŵ(k) cannot be there before k = p + 2: under [`Repair::Keep`], `start` is x̂(p+1|p+1) and P̂(p+1). V̂(k) and Ŵ(k) may be
/// no covariances, or, where Â(k) is singular, not be there: `repair` says what is done then, for each of the two on its
/// own.
///
/// Shapes: `start` p×1 and p×p. The covariance is not checked: indefinite in, indefinite out.
///
/// # Errors
///
/// [`AdaptiveError`] with the step: under [`Repair::Keep`] where Â(k) is singular.
///
/// # Panics
///
/// If the shapes do not fit.
///
/// # Examples
///
/// ```
/// use exact_kalman::identify::{Belief, Series, adaptive_filter};
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::model::{Reading, Repair};
/// use exact_kalman::scalar::ratio;
///
/// let series = Series::new([8, 4, 2, 1].map(|y| vec![ratio(y, 1)]).to_vec())?;
/// let start = Belief { mean: Matrix::column(vec![ratio(4, 1)]), covariance: Matrix::identity(1) };
/// let records = adaptive_filter(&series, Reading::Printed, &start, Repair::Zero)?;
/// // Without noise Â = 1/2, V̂ = Ŵ = 0.
/// assert_eq!(records[1].belief.mean[(0, 0)], ratio(1, 1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn adaptive_filter<S: OrderedField + std::fmt::Display>(
    series: &Series<S>,
    reading: Reading,
    start: &Belief<S>,
    repair: Repair,
) -> Result<Vec<AdaptiveRecord<S>>, AdaptiveError<S>> {
    let all = match estimates(series, reading) {
        Ok(all) => all,
        Err(EstimateError { count, source }) => {
            return Err(AdaptiveError { step: count, source: source.into(), computed: Vec::new() });
        }
    };
    let p = series.dimension();
    let mut repairs = Repairs { repair, zero: Matrix::zeros(p, p), process: None, observation: None };
    let (mut belief, mut records) = (start.clone(), Vec::with_capacity(all.len()));
    // The rank of Â(k) is at most k − 2: before p + 2 there is no V̂(k) to keep.
    let first = if repair == Repair::Keep { p + 2 } else { 3 };
    for estimates in all.into_iter().skip(first.saturating_sub(3)) {
        let step = estimates.count;
        let y = &series.readings()[step - 1];
        let advanced = repairs.model(estimates).and_then(|(model, process_repaired, observation_repaired)| {
            let (predicted_covariance, gain, belief) = belief.advanced(&model, y)?;
            Ok(AdaptiveRecord {
                step,
                model,
                process_repaired,
                observation_repaired,
                predicted_covariance,
                gain,
                belief,
            })
        });
        match advanced {
            Ok(record) => {
                belief = record.belief.clone();
                records.push(record);
            }
            Err(source) => return Err(AdaptiveError { step, source, computed: records }),
        }
    }
    Ok(records)
}

/// The policy, and the last good V̂ and Ŵ.
struct Repairs<S> {
    repair: Repair,
    zero: Matrix<S>,
    process: Option<Matrix<S>>,
    observation: Option<Matrix<S>>,
}

impl<S: OrderedField + std::fmt::Display> Repairs<S> {
    fn model(&mut self, estimates: Estimates<S>) -> Result<(EstimatedModel<S>, bool, bool), Obstacle<S>> {
        let (process, observation) = match (estimates.noise(), self.repair) {
            (Ok(noise), _) => (Some(noise.process), Some(noise.observation)),
            (Err(singular), Repair::Keep) => return Err(singular.into()),
            (Err(_), Repair::Zero | Repair::LastSemidefinite) => (None, None),
        };
        let (process, process_repaired) = repaired(self.repair, &self.zero, &mut self.process, process);
        let (observation, observation_repaired) = repaired(self.repair, &self.zero, &mut self.observation, observation);
        let noise = NoiseCovariances { process, observation };
        Ok((EstimatedModel { transition: estimates.transition, noise }, process_repaired, observation_repaired))
    }
}

/// The matrix that is used, and whether it is another one than the estimate.
fn repaired<S: OrderedField>(
    repair: Repair,
    zero: &Matrix<S>,
    last: &mut Option<Matrix<S>>,
    estimate: Option<Matrix<S>>,
) -> (Matrix<S>, bool) {
    match estimate {
        Some(estimate) if repair == Repair::Keep => (estimate, false),
        Some(estimate) if estimate.ldl().is_ok() => {
            *last = Some(estimate.clone());
            (estimate, false)
        }
        _ if repair == Repair::LastSemidefinite => (last.clone().unwrap_or_else(|| zero.clone()), true),
        _ => (zero.clone(), true),
    }
}
