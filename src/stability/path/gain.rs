//! How large the gain of the filter can be.

use crate::matrix::{LdlError, Matrix};
use crate::scalar::OrderedField;
use crate::stability::Mode;

/// Numbers c with ‖L‖² ≤ c‖P‖, L the gain at P; and the bound of FL.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GainBounds<S> {
    /// tr{HPHᵀS⁻²}, S = HPHᵀ + R.
    pub innovation: S,
    /// tr S⁻¹.
    pub precision: S,
    /// tr R⁻¹.
    pub noise_precision: S,
    /// m/a.
    pub floor: S,
    /// 1/(4a): sharp, since S⁻¹HPHᵀS⁻¹ ≤ S⁻¹ − aS⁻² ≤ I/(4a).
    pub sharp: S,
    /// 1/a: ‖FL‖² ≤ ‖P₊‖/a for the next covariance P₊, since aFLLᵀFᵀ ≤ FLRLᵀFᵀ ≤ Q̄ ≤ P₊.
    pub transported: S,
}

/// Why there are no such bounds.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GainError<S> {
    /// a is not positive.
    #[error("the floor of the observation noise is not positive")]
    Floor,
    /// R ≥ aI is false.
    #[error("the observation noise falls below its floor: {0}")]
    BelowFloor(LdlError<S>),
}

impl<S: OrderedField> Mode<S> {
    /// Bounds of the gain at the covariance P, d×d, with R ≥ aI, a = `floor`.
    ///
    /// WG-gain: `‖L(k)‖² = λ_max{P(k)Hᵀ(k)S⁻²(k)H(k)P(k)} ≤ ‖P(k)‖ tr{H(k)P(k)Hᵀ(k)S⁻²(k)} ≤ ‖P(k)‖ tr S⁻¹(k) ≤ ‖P(k)‖ tr R⁻¹(k) ≤ ‖P(k)‖ m/a,  S(k) = H(k)P(k)Hᵀ(k) + R(k)`
    ///
    /// # Errors
    ///
    /// [`GainError`] if a ≤ 0, or with a direction in which R is below aI.
    ///
    /// # Panics
    ///
    /// If P is not d×d.
    ///
    /// # Examples
    ///
    /// Equality for d = m = 1 and h²p = r = a: L = 1/4, ‖P‖ = 1/4, and 1/16 = (1/4)/(4·1).
    ///
    /// ```
    /// use exact_kalman::{matrix::Matrix, scalar::{ratio, Rational}, stability::Mode};
    ///
    /// let scalar = |value| Matrix::<Rational>::diagonal(&[value]);
    /// let [one, two] = [1, 2].map(|value| scalar(ratio(value, 1)));
    /// let mode = Mode::new(one.clone(), two, one.clone(), one)?;
    /// let covariance = scalar(ratio(1, 4));
    /// assert_eq!(mode.step(&covariance).gain.squared_norm(), ratio(1, 16));
    /// assert_eq!(mode.gain_bounds(&covariance, &ratio(1, 1))?.sharp * &covariance[(0, 0)], ratio(1, 16));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn gain_bounds(&self, covariance: &Matrix<S>, floor: &S) -> Result<GainBounds<S>, GainError<S>> {
        if *floor <= S::zero() {
            return Err(GainError::Floor);
        }
        let (h, r) = (self.observation(), self.observation_noise());
        let m = h.rows();
        Matrix::identity(m).scaled(floor).loewner_le(r).map_err(GainError::BelowFloor)?;
        let seen = h.congruence(covariance);
        let inverse = |matrix: &Matrix<S>| matrix.inverse().unwrap_or_else(|error| unreachable!("R > 0: {error}"));
        let precision = inverse(&(&seen + r));
        let over = |count: i64, divisor: &S| {
            S::from_integer(count).over(divisor).unwrap_or_else(|error| unreachable!("a > 0: {error}"))
        };
        let sensors = (0..m).fold(S::zero(), |sum, _| sum.plus(&over(1, floor)));
        Ok(GainBounds {
            innovation: (&seen * &precision * &precision).trace(),
            precision: precision.trace(),
            noise_precision: inverse(r).trace(),
            floor: sensors,
            sharp: over(1, &floor.times(&S::from_integer(4))),
            transported: over(1, floor),
        })
    }
}
