//! How accurate the enclosures of a step are.

use super::CertifiedStep;
use crate::matrix::Matrix;
use crate::scalar::{Interval, Toward};
use crate::trace::{Quantity, Values};

/// More bits than any enclosure has.
const ALL: i64 = i64::MAX;

/// A variance that may be zero, and is below that of the state before the reading by a factor of two to this power, counts as
/// zero: data that are doubles leave no variance so small, but for zero.
const VANISHING: i64 = 1 << 11;

impl CertifiedStep {
    /// The least number a such that all entries are known to within 2⁻ᵃ of their units: √(pᵢᵢ pⱼⱼ) for covariances, the larger
    /// of |xᵢ| and √pᵢᵢ for means. Nothing where all are known exactly. Where a variance vanishes, the state's before the reading
    /// is the unit.
    pub fn accuracy(&self) -> Option<u64> {
        let pairs = [
            (Quantity::FilteredMean, Quantity::FilteredCovariance),
            (Quantity::PredictedMean, Quantity::PredictedCovariance),
            (Quantity::Innovation, Quantity::InnovationCovariance),
        ];
        let of = |(mean, covariance)| {
            let vanishing = if covariance == Quantity::FilteredCovariance { self.vanishing() } else { Vec::new() };
            of_moments(&self.values, (mean, covariance), &vanishing)
        };
        let least = pairs.into_iter().map(of).min().unwrap_or(ALL);
        (least < ALL).then(|| u64::try_from(least).unwrap_or(0))
    }

    /// For each state whose variance after the reading may be zero and vanishes beside the one before: that one's deviation, as
    /// twice its logarithm.
    pub(super) fn vanishing(&self) -> Vec<Option<i64>> {
        let [Some(before), Some(after)] =
            [Quantity::PredictedCovariance, Quantity::FilteredCovariance].map(|quantity| self.values.get(&quantity))
        else {
            return Vec::new();
        };
        let of = |i: usize| {
            let (unit, variance) = (twice_deviation(&before[(i, i)])?, &after[(i, i)]);
            let small = variance.upper().magnitude().is_none_or(|size| size < unit - VANISHING);
            let may_be_zero = variance.lower().is_negative() || variance.lower().is_zero();
            (may_be_zero && small).then_some(unit)
        };
        (0..after.rows()).map(of).collect()
    }
}

fn of_moments(values: &Values<Interval>, (mean, covariance): (Quantity, Quantity), vanishing: &[Option<i64>]) -> i64 {
    let (Some(mean), Some(covariance)) = (values.get(&mean), values.get(&covariance)) else { return ALL };
    let own = |i: usize| twice_deviation(&covariance[(i, i)]);
    let deviations: Vec<Option<i64>> =
        (0..covariance.rows()).map(|i| vanishing.get(i).copied().flatten().or_else(|| own(i))).collect();
    let of_mean = (0..mean.rows()).map(|i| {
        let own = least_magnitude(&mean[(i, 0)]).map(|size| 2 * size);
        known(&mean[(i, 0)], own.max(deviations[i]))
    });
    of_mean.chain(of_covariance(covariance, &deviations)).min().unwrap_or(ALL)
}

fn of_covariance<'a>(
    covariance: &'a Matrix<Interval>,
    deviations: &'a [Option<i64>],
) -> impl Iterator<Item = i64> + 'a {
    let n = covariance.rows();
    (0..n).flat_map(move |i| (0..=i).map(move |j| (i, j))).map(|(i, j)| {
        // Twice the magnitude of √(pᵢᵢ pⱼⱼ).
        let unit = deviations[i].zip(deviations[j]).map(|(a, b)| a + b);
        known(&covariance[(i, j)], unit)
    })
}

/// Twice the binary logarithm of the deviation that a variance has at least, or a little less.
fn twice_deviation(variance: &Interval) -> Option<i64> {
    (!variance.lower().is_negative()).then(|| variance.lower().magnitude()).flatten().map(|size| size - 1)
}

/// The binary logarithm of what a number has at least in magnitude, or a little less.
fn least_magnitude(value: &Interval) -> Option<i64> {
    let (lower, upper) = (value.lower(), value.upper());
    let nearest = if lower.is_negative() { upper.negated() } else { lower.clone() };
    if nearest.is_negative() { None } else { nearest.magnitude().map(|size| size - 1) }
}

/// The bits to which a number is known in a unit, of which twice the logarithm is given; none where the unit is not known.
fn known(value: &Interval, twice_unit: Option<i64>) -> i64 {
    let width = value.upper().plus(&value.lower().negated(), 8, Toward::Above);
    match (width.magnitude(), twice_unit) {
        (None, _) => ALL,
        (Some(_), None) => 0,
        (Some(width), Some(unit)) => unit.div_euclid(2) - width,
    }
}
