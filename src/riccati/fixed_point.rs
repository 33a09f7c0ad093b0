//! The fixed point of φ between two bounds.

use num_traits::Signed;

use super::rounding::{Direction, Unit};
use super::{FixedPointError, RiccatiMap};
use crate::matrix::Matrix;
use crate::scalar::{Rational, Scalar};

/// Two matrices with `lower ≤ S∞ ≤ upper` in the Loewner order.
///
/// Every S between them, S∞ among them, is closer to each than the bounds are to one another: 0 ≤ Z ≤ E implies
/// ‖Z‖ ≤ ‖E‖.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FixedPointEnclosure {
    /// Positive definite, at most S∞, and at most φⁿ(V).
    pub lower: Matrix<Rational>,
    /// At least S∞, and at least φⁿ(AWAᵀ + V).
    pub upper: Matrix<Rational>,
    /// n, the number of steps.
    pub steps: usize,
}

/// Every entry of Δ∞ differs from that of `centre` by at most that of `radius`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GainEnclosure {
    /// The gain at the upper bound of S∞.
    pub centre: Matrix<Rational>,
    /// What each entry may be off by.
    pub radius: Matrix<Rational>,
}

impl FixedPointEnclosure {
    /// ‖upper − lower‖², in the norm of AK-N.G.
    pub fn squared_gap(&self) -> Rational {
        (&self.upper - &self.lower).squared_norm()
    }
}

impl RiccatiMap<Rational> {
    /// The one fixed point S∞ of φ, between two matrices whose difference has a norm of at most `gap`.
    ///
    /// AK-T2.3: `V > 0, W ≥ 0  ⇒  S(k) = φ(S(k−1)), k ≥ 2; φ has one fixed point S∞ > 0; φⁿ(S) → S∞ uniformly in S > 0`
    ///
    /// The bounds are those of the paper's proof, which hold for every start S and so for S∞:
    ///
    /// AK-4.2-sandwich: `φⁿ(V) ≤ φⁿ⁺¹(S) ≤ φⁿ(AWAᵀ + V) for all S > 0, n ≥ 1`
    ///
    /// After each step both are rounded outwards to multiples of a power of two far below the gap. That keeps them
    /// bounds: if 0 ≤ L ≤ S∞ then φ(L) ≤ φ(S∞) = S∞ by monotony, so anything below φ(L) is below S∞ (and below φⁿ(V) if L was
    /// below φⁿ⁻¹(V)); likewise above. Where rounding would leave a lower bound that is not positive definite, it stays as it
    /// is: φ(L) ≥ V > 0. So entries stay short in general, and there are at most `most_steps` steps. A gap of zero allows no
    /// rounding, and is reached only where φⁿ is constant; a negative gap counts as zero.
    ///
    /// # Errors
    ///
    /// [`FixedPointError::StateNoiseSingular`] unless V > 0; [`FixedPointError::TooFewSteps`] with the enclosure reached.
    ///
    /// # Examples
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, riccati::RiccatiMap, scalar::{ratio, Rational}};
    ///
    /// let scalar = |value| Matrix::<Rational>::diagonal(&[value]);
    /// // S² − S − 1 = 0: the golden ratio.
    /// let map = RiccatiMap::new(scalar(ratio(1, 1)), scalar(ratio(1, 1)), scalar(ratio(1, 1)))?;
    /// let golden = map.fixed_point(&ratio(1, 1_000_000), 100)?;
    /// let polynomial = |s: &Rational| s * s - s - ratio(1, 1);
    /// assert!(polynomial(&golden.lower[(0, 0)]) < ratio(0, 1));
    /// assert!(polynomial(&golden.upper[(0, 0)]) > ratio(0, 1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn fixed_point(&self, gap: &Rational, most_steps: usize) -> Result<FixedPointEnclosure, FixedPointError> {
        let null = self.state_noise().kernel();
        if null.columns() > 0 {
            return Err(FixedPointError::StateNoiseSingular { direction: null.select_columns(&[0]) });
        }
        let gap = if gap.is_negative() { Rational::zero() } else { gap.clone() };
        let unit = Unit::for_gap(&gap, self.states());
        let mut reached =
            FixedPointEnclosure { lower: self.state_noise().clone(), upper: self.upper_bound(), steps: 0 };
        while reached.squared_gap() > gap.times(&gap) {
            if reached.steps == most_steps {
                return Err(FixedPointError::TooFewSteps { reached });
            }
            let lower = self.image(&reached.lower);
            let rounded = unit.outward(&lower, Direction::Down);
            // A semidefinite bound would do for φ, but L + W might be singular, and no pseudo-inverse bounds (S∞ + W)⁻¹.
            let is_definite = rounded.ldl().is_ok_and(|ldl| ldl.is_positive_definite());
            reached = FixedPointEnclosure {
                lower: if is_definite { rounded } else { lower },
                upper: unit.outward(&self.image(&reached.upper), Direction::Up),
                steps: reached.steps + 1,
            };
        }
        Ok(reached)
    }

    /// Bounds of P∞ = S∞:W, the limit of the covariance after an observation: the parallel sum is monotone.
    ///
    /// AK-C2.1: `V > 0  ⇒  S(k) → S∞, Δ(k) → Δ∞ = S∞(S∞ + W)⁻¹, P(k) → P∞ = S∞ − S∞(S∞ + W)⁻¹S∞`
    ///
    /// # Panics
    ///
    /// If the enclosure is that of a map of another order.
    pub fn filtered_limit(&self, s: &FixedPointEnclosure) -> (Matrix<Rational>, Matrix<Rational>) {
        (self.filtered_covariance(&s.lower), self.filtered_covariance(&s.upper))
    }

    /// Bounds of Δ∞, the limit of the gain, entry by entry.
    ///
    /// `I − Δ∞ = W(S∞ + W)⁻¹`, and with the bounds L ≤ S∞ ≤ U and Z = (S∞ + W)⁻¹ − (U + W)⁻¹ there is
    /// `0 ≤ Z ≤ E = (L + W)⁻¹ − (U + W)⁻¹`. So `|aᵀZb| ≤ √(aᵀEa·bᵀEb) ≤ ½(aᵀEa + bᵀEb)`, with a row of W and a unit vector.
    /// This needs L + W > 0, which every enclosure of [`RiccatiMap::fixed_point`] has, as L > 0.
    ///
    /// # Panics
    ///
    /// If the enclosure is that of a map of another order, or if its lower bound and W have a sum that is not positive definite.
    pub fn gain_limit(&self, s: &FixedPointEnclosure) -> GainEnclosure {
        let least = &s.lower + self.observation_noise();
        assert!(least.ldl().is_ok_and(|ldl| ldl.is_positive_definite()), "L + W is not positive definite: {least}");
        let spread = self.information(&s.lower) - self.information(&s.upper);
        let rows = self.observation_noise().congruence(&spread);
        let half = Rational::new_raw(1.into(), 2.into());
        let radius =
            Matrix::from_fn(self.states(), self.states(), |i, j| half.times(&rows[(i, i)].plus(&spread[(j, j)])));
        GainEnclosure { centre: self.gain(&s.upper), radius }
    }
}
