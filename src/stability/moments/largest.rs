//! Up to which order the moments of one state stay bounded, when observations are lost independently.

use std::cmp::Ordering;

use crate::scalar::{Rational, Scalar, ratio};

/// The length of the powers that are compared.
const MOST_BITS: u64 = 1 << 22;

/// The order s at which a f²ˢ = 1: moments of p(k) below it are bounded, it and those above are not.
///
/// `s = log(1/a)/(2 log f)` for 0 < a < 1 and f > 1, in the family of WG-49 with q > 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LargestMoment {
    loss: Rational,
    growth: Rational,
}

impl LargestMoment {
    /// That of the probability a that an observation is lost, and the factor f: nothing unless 0 < a < 1 < |f|.
    ///
    /// For a = 0 or |f| ≤ 1 (with a < 1) all moments are bounded; for a = 1 < |f| none is.
    ///
    /// # Examples
    ///
    /// ```
    /// use std::cmp::Ordering;
    /// use exact_kalman::{scalar::ratio, stability::LargestMoment};
    ///
    /// let link = LargestMoment::new(&ratio(1, 4), &ratio(3, 2)).expect("unstable, and not always lost");
    /// assert_eq!(link.compared_with(3, 2), Some(Ordering::Greater));
    /// // log 4/(2 log(3/2)) = 1.7095…
    /// assert_eq!(link.decimals(4), Some((ratio(17_095, 10_000), ratio(17_096, 10_000))));
    /// ```
    pub fn new(loss: &Rational, growth: &Rational) -> Option<Self> {
        let one = Rational::one();
        let growth = if *growth < Rational::zero() { growth.negated() } else { growth.clone() };
        (*loss > Rational::zero() && *loss < one && growth > one).then(|| Self { loss: loss.clone(), growth })
    }

    /// The order compared with n/m: it is greater exactly if `aᵐf²ⁿ < 1`, and then the moment of order n/m is bounded.
    ///
    /// Two powers are computed exactly; nothing if they would have more than 2²² bits.
    pub fn compared_with(&self, n: u32, m: u32) -> Option<Ordering> {
        let bits = |value: &Rational| value.numer().bits().max(value.denom().bits());
        let length =
            u64::from(m).saturating_mul(bits(&self.loss)) + u64::from(n).saturating_mul(2 * bits(&self.growth));
        if length > MOST_BITS {
            return None;
        }
        let over = self.loss.numer().pow(m) * self.growth.numer().pow(n).pow(2);
        let under = self.loss.denom().pow(m) * self.growth.denom().pow(n).pow(2);
        Some(under.cmp(&over))
    }

    /// The two neighbouring numbers with so many decimals, at most six, with lower ≤ s < upper.
    ///
    /// Nothing if the powers that prove it would be too long.
    pub fn decimals(&self, places: u32) -> Option<(Rational, Rational)> {
        let scale = 10_u32.pow(places.min(6));
        let reaches = |n: u32| Some(self.compared_with(n, scale)? != Ordering::Less);
        let (mut lower, mut upper) = (0, scale);
        while reaches(upper)? {
            (lower, upper) = (upper, upper.checked_mul(2)?);
        }
        while upper - lower > 1 {
            let middle = lower + (upper - lower) / 2;
            if reaches(middle)? { lower = middle } else { upper = middle }
        }
        Some((ratio(lower.into(), scale.into()), ratio(upper.into(), scale.into())))
    }
}
