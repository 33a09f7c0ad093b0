//! Wrong answers that are made of the right one.

use num_bigint::BigInt;

use super::inverse::Ranks;
use super::real::{Real, rationals, reals};
use crate::judge::Reference;
use crate::matrix::Matrix;
use crate::protocol::Decimal;
use crate::scalar::{Rational, Scalar as _, exact_value, nearest_single};
use crate::trace::{Quantity, Values};

/// Something done with the right answer before it is handed out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rearrangement {
    /// The law before the reading, as that after it.
    PredictedForFiltered,
    /// The law after the reading, as that before it.
    FilteredForPredicted,
    /// Each of the two laws for the other.
    Exchanged,
    /// The law before the next reading, as that after this one.
    NextPredictionForFiltered,
    /// The law before the next reading, as that before this one.
    NextPredictionForPredicted,
    /// Each step holds what belongs to the one before.
    Late,
    /// Each step holds what belongs to the next one.
    Early,
    /// Roots of the entries of covariances.
    Roots,
    /// L of P = LLᵀ, or its transpose.
    Factor { upper: bool },
    /// P⁻¹
    Inverse,
    /// Only the diagonals of covariances.
    Diagonals,
    /// −ν
    InnovationNegated,
    /// y − Gv − Cx⁺
    Residual,
    /// S − R
    InnovationCovarianceWithoutNoise,
    /// Rounded to so many significant digits.
    Significant(u32),
    /// Rounded to so many decimals.
    Decimals(u32),
    /// Rounded to single precision.
    Single,
}

use Quantity::{
    FilteredCovariance, FilteredMean, Innovation, InnovationCovariance, PredictedCovariance, PredictedMean,
};

const FILTERED: [Quantity; 2] = [FilteredMean, FilteredCovariance];
const PREDICTED: [Quantity; 2] = [PredictedMean, PredictedCovariance];

impl Rearrangement {
    /// Whether its numbers are known to the last digit: they are rounded ones, and were right before.
    pub(super) fn is_rounding(self) -> bool {
        matches!(self, Self::Significant(_) | Self::Decimals(_) | Self::Single)
    }

    /// What is answered at a step; what nothing is known of is absent.
    pub(super) fn of(self, reference: &Reference, step: usize) -> Option<Values<Rational>> {
        let here = reference.values.get(step)?;
        let next = reference.values.get(step + 1);
        Some(match self {
            Self::PredictedForFiltered => with(here, FILTERED, Some(here), PREDICTED),
            Self::FilteredForPredicted => with(here, PREDICTED, Some(here), FILTERED),
            Self::Exchanged => {
                let half = with(here, FILTERED, Some(here), PREDICTED);
                with(&half, PREDICTED, Some(here), FILTERED)
            }
            Self::NextPredictionForFiltered => with(here, FILTERED, next, PREDICTED),
            Self::NextPredictionForPredicted => with(here, PREDICTED, next, PREDICTED),
            Self::Late => {
                step.checked_sub(1).and_then(|before| reference.values.get(before)).cloned().unwrap_or_default()
            }
            Self::Early => next.cloned().unwrap_or_default(),
            Self::Roots => covariances(here, |p| Some(p.map(super::problem::root))),
            Self::Factor { upper } => covariances(here, |p| {
                let lower = factor(p);
                Some(if upper { lower.transpose() } else { lower })
            }),
            Self::Inverse => covariances(here, inverse),
            Self::Diagonals => covariances(here, |p| {
                let n = p.rows();
                Some(Matrix::from_fn(n, n, |i, j| if i == j { p[(i, i)].clone() } else { Rational::zero() }))
            }),
            Self::InnovationNegated => on(here, Innovation, |innovation| -innovation),
            Self::Residual => {
                let mean = here.get(&FilteredMean)?;
                let data = reference.path.steps().get(step)?;
                let rows = data.reading.present();
                let offset = data.observation_input.select_rows(&rows);
                on(here, Innovation, |_| data.reading.values() - (data.observation.select_rows(&rows) * mean + &offset))
            }
            Self::InnovationCovarianceWithoutNoise => {
                let data = reference.path.steps().get(step)?;
                let rows = data.reading.present();
                on(here, InnovationCovariance, |s| s - data.observation_noise.select(&rows, &rows))
            }
            Self::Significant(digits) => all(here, |value| Decimal::rounded(value, digits).value()),
            Self::Decimals(digits) => all(here, |value| rounded_to_decimals(value, digits)),
            Self::Single => {
                all(here, |value| exact_value(f64::from(nearest_single(value))).unwrap_or_else(Rational::zero))
            }
        })
    }
}

/// The values, some of them replaced; one that would be replaced by nothing is absent.
fn with(
    values: &Values<Rational>,
    names: [Quantity; 2],
    from: Option<&Values<Rational>>,
    sources: [Quantity; 2],
) -> Values<Rational> {
    let mut changed = values.clone();
    for (name, source) in names.into_iter().zip(sources) {
        match from.and_then(|from| from.get(&source)) {
            Some(value) => changed.insert(name, value.clone()),
            None => changed.remove(&name),
        };
    }
    changed
}

fn on(
    values: &Values<Rational>,
    quantity: Quantity,
    change: impl FnOnce(&Matrix<Rational>) -> Matrix<Rational>,
) -> Values<Rational> {
    let mut changed = values.clone();
    if let Some(value) = changed.get_mut(&quantity) {
        *value = change(value);
    }
    changed
}

fn covariances(
    values: &Values<Rational>,
    change: impl Fn(&Matrix<Rational>) -> Option<Matrix<Rational>>,
) -> Values<Rational> {
    let changed = values.iter().filter_map(|(&quantity, value)| {
        let value = if quantity.is_covariance() { change(value)? } else { value.clone() };
        Some((quantity, value))
    });
    changed.collect()
}

fn all(values: &Values<Rational>, change: impl Fn(&Rational) -> Rational) -> Values<Rational> {
    values.iter().map(|(&quantity, value)| (quantity, value.map(&change))).collect()
}

/// The lower triangular factor of a covariance; its columns are zero where nothing is left.
fn factor(covariance: &Matrix<Rational>) -> Matrix<Rational> {
    let n = covariance.rows();
    let mut rest = reals(covariance);
    let mut lower = Matrix::<Real>::zeros(n, n);
    for k in 0..n {
        let Some(root) = rest[(k, k)].root() else { continue };
        if root.over(&root).is_err() {
            continue;
        }
        for i in k..n {
            lower[(i, k)] = rest[(i, k)].over(&root).unwrap_or_else(|_| Real::zero());
        }
        rest = Matrix::from_fn(n, n, |i, j| rest[(i, j)].minus(&lower[(i, k)].times(&lower[(j, k)])));
    }
    rationals(&lower)
}

/// The inverse of a covariance, if it is regular.
fn inverse(covariance: &Matrix<Rational>) -> Option<Matrix<Rational>> {
    let n = covariance.rows();
    let all: Vec<usize> = (0..n).collect();
    let inverse = rationals(Ranks::new(n).inverse(&reals(covariance), &all).matrix());
    (0..n).all(|i| inverse[(i, i)] != Rational::zero()).then_some(inverse)
}

fn rounded_to_decimals(value: &Rational, digits: u32) -> Rational {
    let scale = Rational::from(BigInt::from(10).pow(digits));
    // Ties go away from zero; they are not met by values that matter here.
    Rational::from((value * &scale).round().to_integer()) / scale
}
