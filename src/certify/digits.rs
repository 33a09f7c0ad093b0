//! Decimal digits that an enclosure proves.

use std::fmt;

use super::CertifiedStep;
use super::standing::Standing;
use crate::matrix::Matrix;
use crate::protocol::Decimal;
use crate::scalar::{Dyadic, Interval, Rational, Toward};
use crate::trace::Moments;

/// Bits beyond those of the digits that are wanted, to which a number is known where more bits will hardly tell it from zero
/// or from a tie.
const BEYOND: u64 = 64;

/// Bits beyond those with which enclosures begin.
const MARGIN: u64 = 128;

/// What is known of the decimal digits of a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Digits {
    /// The number, correctly rounded, halves away from zero.
    Proved(Decimal),
    /// It is zero or a tie of two decimals, or too near to one of them: it is no farther than the bound from this number.
    Within {
        /// This number; zero if the number may be zero.
        middle: Decimal,
        /// How far it may be away.
        bound: Decimal,
    },
}

impl Digits {
    /// What an enclosure says of a number.
    pub fn of(interval: &Interval, digits: u32) -> Self {
        if let Some(decimal) = proved(interval, digits) {
            return Self::Proved(decimal);
        }
        let (lower, upper) = (interval.lower(), interval.upper());
        let may_be_zero = !upper.is_negative() && (lower.is_negative() || lower.is_zero());
        let half = Dyadic::new(1.into(), -1);
        let middle = if may_be_zero {
            Dyadic::zero()
        } else {
            lower.plus(upper, wide(digits), Toward::Below).times(&half, wide(digits), Toward::Below)
        };
        // One digit more shows the tie.
        let middle = middle.value().map_or_else(
            || Decimal::rounded(&Rational::default(), 1),
            |middle| Decimal::rounded(&middle, digits.saturating_add(1)),
        );
        let distance = [lower, upper].map(|end| {
            let value = end.value().unwrap_or_default();
            num_traits::Signed::abs(&(value - middle.value()))
        });
        let [one, other] = distance;
        Self::Within { middle, bound: above(&one.max(other)) }
    }
}

impl fmt::Display for Digits {
    /// `0.25`, or `0±3e-40`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Proved(decimal) => decimal.fmt(f),
            Self::Within { middle, bound } => write!(f, "{middle}±{bound}"),
        }
    }
}

/// Two digits that are not below the number.
fn above(value: &Rational) -> Decimal {
    let near = Decimal::rounded(value, 2);
    if near.value() >= *value {
        return near;
    }
    // A unit of the second digit is at most a tenth of the number, and at least a hundredth.
    Decimal::rounded(&(value + value / Rational::from_integer(10.into())), 2)
}

/// More bits than so many digits have.
fn wide(digits: u32) -> u64 {
    4 * u64::from(digits) + MARGIN
}

fn proved(interval: &Interval, digits: u32) -> Option<Decimal> {
    if interval.lower() == interval.upper() {
        return interval.lower().value().map(|value| Decimal::rounded(&value, digits));
    }
    Decimal::of_interval(interval, digits)
}

impl CertifiedStep {
    /// How far the entries of a step are from so many digits.
    pub(super) fn standing(&self, digits: u32) -> Standing {
        // log₂ 10 < 10/3 + 1/60
        let needed = u64::from(digits) * 10 / 3 + u64::from(digits) / 60 + BEYOND;
        let entries = self.entries();
        if entries.into_iter().all(|entry| proved(entry, digits).is_some()) {
            return Standing::Proved;
        }
        if self.accuracy().is_none_or(|bits| bits >= needed) { Standing::Tied } else { Standing::Short }
    }

    /// All that is enclosed, by number.
    fn entries(&self) -> Vec<&Interval> {
        let derived = &self.derived;
        let matrices = [&derived.predicted_observation, &derived.cross_covariance].into_iter().flatten();
        let ahead = derived.ahead.iter().flat_map(|Moments { mean, covariance, .. }| [mean, covariance]);
        let parts = derived.likelihood.iter().flat_map(|parts| [&parts.quadratic, &parts.pseudo_determinant]);
        self.values.values().chain(matrices).chain(ahead).flat_map(Matrix::entries).chain(parts).collect()
    }
}

/// The bits with which enclosures begin from which so many digits are wanted.
pub(super) fn bits_for(digits: u32) -> u64 {
    wide(digits).max(192)
}
