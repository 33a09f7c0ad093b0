//! How often an observation must arrive for the mean of P(k) to stay bounded.

use crate::matrix::Matrix;
use crate::scalar::{Rational, Scalar, ratio};
use crate::stability::{Mode, ModeProcess, MomentBound, MomentGrowth};

/// The probability of arrival above which the mean stays bounded: λ_c between two numbers with certificates.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CriticalArrival {
    /// A probability at which the mean is proved to be unbounded, so λ_c is not below it; nothing if none was found, even at 0.
    pub unbounded: Option<(Rational, MomentGrowth)>,
    /// A probability at which the mean is proved to be bounded, so λ_c is not above it; nothing if none was found, even at 1.
    pub bounded: Option<(Rational, MomentBound)>,
}

impl CriticalArrival {
    /// The length of what was not decided; nothing if one side is missing.
    pub fn gap(&self) -> Option<Rational> {
        let ((lower, _), (upper, _)) = self.unbounded.as_ref().zip(self.bounded.as_ref())?;
        Some(upper.minus(lower))
    }
}

impl ModeProcess<Rational> {
    /// The process in which each observation of a mode arrives with the same probability, independently: mode 0 has lost it, mode 1 not.
    ///
    /// WG-49: `Pr{h(k) = 0} = a > 0,  Pr{h(k) = 1} = 1 − a`
    ///
    /// Nothing unless the probability is between 0 and 1.
    pub fn intermittent(mode: &Mode<Rational>, arrival: &Rational) -> Option<Self> {
        let blind = Matrix::zeros(mode.observation().rows(), mode.states());
        let lost =
            Mode::new(mode.transition().clone(), blind, mode.process_noise().clone(), mode.observation_noise().clone());
        let Ok(lost) = lost else { unreachable!("only the observation is another") };
        Self::independent(vec![lost, mode.clone()], vec![Rational::one().minus(arrival), arrival.clone()]).ok()
    }
}

impl Mode<Rational> {
    /// The critical probability λ_c of arrival for this F, H, Q and R (Sinopoli and others 2004), from P(0) = 0.
    ///
    /// More arrivals never do harm, so the mean is bounded above one λ_c and unbounded below it. Two bisections down to `width`: for the
    /// largest λ at which [`ModeProcess::moment_growth`] proves the mean unbounded (with Q > 0 it is 1 − 1/ρ(F)², or 1 if an unstable
    /// direction is never observed), and for the least λ at which [`ModeProcess::moment_bound`] proves it bounded. With H invertible they
    /// meet; in general λ_c may lie anywhere between, and no method is known that decides it.
    ///
    /// Nothing is returned unless the width is positive. Each trial costs what [`ModeProcess::moment`] of order one does,
    /// but without its limit on d, and there are two for each halving.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}, stability::Mode};
    ///
    /// let scalar = |value| Matrix::<Rational>::diagonal(&[value]);
    /// let mode = Mode::new(scalar(ratio(2, 1)), scalar(ratio(1, 1)), scalar(ratio(1, 1)), scalar(ratio(1, 1)))?;
    /// // 1 − 1/f² = 3/4
    /// let found = mode.critical_arrival(&ratio(1, 100)).expect("a positive width");
    /// let ((lower, _), (upper, _)) = (found.unbounded.expect("F is unstable"), found.bounded.expect("H is invertible"));
    /// assert!(lower <= ratio(3, 4) && ratio(3, 4) <= upper && upper - lower < ratio(1, 50));
    /// # Ok::<(), exact_kalman::stability::ModeError<Rational>>(())
    /// ```
    pub fn critical_arrival(&self, width: &Rational) -> Option<CriticalArrival> {
        if *width <= Rational::zero() {
            return None;
        }
        let at = |arrival: &Rational| {
            ModeProcess::intermittent(self, arrival).unwrap_or_else(|| unreachable!("{arrival} is between 0 and 1"))
        };
        let start = Matrix::zeros(self.states(), self.states());
        let growth = |arrival: &Rational| at(arrival).moment_growth(1);
        let bound = |arrival: &Rational| at(arrival).moment_bound(1, &start);
        let (none, all) = (Rational::zero(), Rational::one());
        let unbounded = extreme(&growth, &none, &all, width);
        let bounded = extreme(&bound, &all, &none, width);
        Some(CriticalArrival { unbounded, bounded })
    }

    /// The critical probability of arrival of one state that is observed: max(0, 1 − 1/f²), exactly; nothing for more states, or H = 0.
    ///
    /// With q > 0 the mean is bounded exactly above it, and at it too if |f| < 1: by WG-50 `a f² E p + q ≤ E p⁺ ≤ a f² E p + const` with a =
    /// 1 − λ.
    pub fn scalar_critical_arrival(&self) -> Option<Rational> {
        if self.states() != 1 || self.observation().is_zero() {
            return None;
        }
        let f = &self.transition()[(0, 0)];
        let threshold = Rational::one().over(&f.times(f)).map(|inverse| Rational::one().minus(&inverse));
        Some(threshold.unwrap_or_else(|_| Rational::zero()).max(Rational::zero()))
    }
}

/// The number farthest from `good` towards `other`, to within the width, at which there is a certificate, as there is at `good`; nothing if
/// there is none even there.
fn extreme<C>(
    certificate: &impl Fn(&Rational) -> Option<C>,
    good: &Rational,
    other: &Rational,
    width: &Rational,
) -> Option<(Rational, C)> {
    let mut found = (good.clone(), certificate(good)?);
    if let Some(all) = certificate(other) {
        return Some((other.clone(), all));
    }
    let mut without = other.clone();
    loop {
        let distance = without.minus(&found.0);
        if distance <= *width && distance.negated() <= *width {
            return Some(found);
        }
        let middle = without.plus(&found.0).times(&ratio(1, 2));
        match certificate(&middle) {
            Some(there) => found = (middle, there),
            None => without = middle,
        }
    }
}
