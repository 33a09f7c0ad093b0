//! The plant: what is known of the tank, and one step of it.

use super::{Concentration, Exponent, Unphysical};
use crate::matrix::Matrix;
use crate::scalar::{Rational, ratio};

/// The known constants of the tank.
#[derive(Clone, Debug, PartialEq)]
pub struct Reactor<T> {
    /// S₀, the substrate in the feed, mg/l.
    pub feed: T,
    /// τ, biomass made per substrate consumed.
    pub yield_coefficient: T,
    /// T, the sampling period, h.
    pub period: T,
    /// α of the growth law.
    pub growth_factor: T,
    /// γ of the growth law, in the unit of x_S^β.
    pub growth_offset: T,
    /// β of the growth law.
    pub exponent: Exponent,
    /// The factor 0.05 of the control law: the dilution rate in 1/h where x_S is 0 mg/l.
    pub control_factor: T,
}

impl Reactor<Rational> {
    /// The reactor that the paper simulates, for one of its exponents.
    ///
    /// HV-Sim: `S₀ = 50, τ = 1, T = 1, α = 1/2, γ = 125, x(1) = [25; 30], D = [[3/10, 1/10], [1/10, 1/10]], n = 150`
    ///
    /// # Examples
    ///
    /// At 30 mg/l the growth rate is larger the smaller β is:
    ///
    /// ```
    /// use exact_kalman::reproduce::bioreactor::{Exponent, Reactor};
    /// use exact_kalman::scalar::ratio;
    ///
    /// let rate = |beta| Reactor::printed(Exponent::Natural(beta)).growth_rate(&ratio(30, 1));
    /// assert_eq!([rate(2)?, rate(1)?, rate(0)?], [ratio(3, 205), ratio(3, 31), ratio(5, 42)]);
    /// # Ok::<(), exact_kalman::reproduce::bioreactor::Unphysical>(())
    /// ```
    pub fn printed(exponent: Exponent) -> Self {
        Self {
            feed: ratio(50, 1),
            yield_coefficient: ratio(1, 1),
            period: ratio(1, 1),
            growth_factor: ratio(1, 2),
            growth_offset: ratio(125, 1),
            exponent,
            control_factor: ratio(1, 20),
        }
    }
}

impl<T: Concentration> Reactor<T> {
    /// The same constants, each the nearest double.
    pub fn doubles(&self) -> Reactor<f64> {
        Reactor {
            feed: self.feed.double(),
            yield_coefficient: self.yield_coefficient.double(),
            period: self.period.double(),
            growth_factor: self.growth_factor.double(),
            growth_offset: self.growth_offset.double(),
            exponent: self.exponent,
            control_factor: self.control_factor.double(),
        }
    }

    /// The dilution rate that the control law answers to a reading, in 1/h.
    ///
    /// HV-u: `u(k) = 0.05/(y(k−1) + 1)`
    ///
    /// # Errors
    ///
    /// [`Unphysical::NoControl`] at y = −1.
    pub fn dilution(&self, reading: &T) -> Result<T, Unphysical> {
        let divisor = reading.clone() + T::one();
        if divisor.is_zero() { Err(Unphysical::NoControl) } else { Ok(self.control_factor.clone() / divisor) }
    }

    /// The state [x_B, x_S] after one period, given growth rate μ, dilution rate u and noise ξ.
    ///
    /// HV-8a: `x_B(k+1) = (1 + T(μ(k) − u(k)))x_B(k) + ξ_B(k)`
    ///
    /// HV-8b: `x_S(k+1) = x_S(k) − Tμ(k)x_B(k)/τ + Tu(k)(S₀ − x_S(k)) + ξ_S(k)`
    pub fn next(&self, state: &[T; 2], growth: &T, dilution: &T, noise: &[T; 2]) -> [T; 2] {
        let [biomass, substrate] = state.clone();
        let [on_biomass, on_substrate] = noise.clone();
        let period = || self.period.clone();
        let eaten = period() * growth.clone() * biomass.clone() / self.yield_coefficient.clone();
        let fed = period() * dilution.clone() * (self.feed.clone() - substrate.clone());
        let factor = T::one() + period() * (growth.clone() - dilution.clone());
        [factor * biomass + on_biomass, substrate - eaten + fed + on_substrate]
    }

    /// A(k), 2×2, of the same step as a linear one.
    ///
    /// HV-9a: `x(k+1) = [[1 + T(μ(k) − u(k)), 0], [−Tμ(k)/τ, 1 − Tu(k)]] x(k) + [0; TS₀] u(k) + D(k)w(k)`
    pub fn transition(&self, growth: &T, dilution: &T) -> Matrix<T> {
        let growth_per_period = self.period.clone() * growth.clone();
        let dilution_per_period = self.period.clone() * dilution.clone();
        let entries = [
            [T::one() + growth_per_period.clone() - dilution_per_period.clone(), T::zero()],
            [T::zero() - growth_per_period / self.yield_coefficient.clone(), T::one() - dilution_per_period],
        ];
        Matrix::from_fn(2, 2, |i, j| entries[i][j].clone())
    }

    /// The input [0; TS₀] u(k) of HV-9a, 2×1.
    pub fn input(&self, dilution: &T) -> Matrix<T> {
        Matrix::column(vec![T::zero(), self.period.clone() * self.feed.clone() * dilution.clone()])
    }
}
