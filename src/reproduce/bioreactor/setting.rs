//! The simulated reactor with all that a run needs, and its coefficients along readings.

use super::{BioreactorError, Concentration, Exponent, Reactor, Unphysical};
use crate::matrix::Matrix;
use crate::scalar::{Rational, ratio};

/// A substrate and a reading from before the first step.
#[derive(Clone, Debug, PartialEq)]
pub struct Earlier<T> {
    /// x_S, on which a growth rate depends, mg/l.
    pub substrate: T,
    /// y, on which a dilution rate depends, mg/l.
    pub reading: T,
}

/// Everything that the true system is made of, except its noise.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting<T> {
    /// The tank.
    pub reactor: Reactor<T>,
    /// D, by rows.
    pub noise_factor: [[T; 2]; 2],
    /// The paper's x(1): biomass and substrate, mg/l.
    pub first: [T; 2],
    /// The paper's times 1 − d, …, 0. Their number is the delay d: growth and dilution rate of a step depend on the
    /// substrate and the reading d steps before.
    pub earlier: Vec<Earlier<T>>,
}

/// The two rates that a transition depends on.
#[derive(Clone, Debug, PartialEq)]
pub struct Coefficients<T> {
    /// μ, 1/h.
    pub growth: T,
    /// u, 1/h.
    pub dilution: T,
}

impl Setting<Rational> {
    /// The paper's reactor with the given delay, in the delayed laws
    ///
    /// HV-mu2: `μ(k) = α x_S(k−2)/(γ + x_S(k−2)^β)`
    ///
    /// HV-u2: `u(k) = 0.05/(y(k−2) + 1)`
    ///
    /// for d = 2, and HV-mu, HV-u for d = 1. The paper gives no x_S(0), y(0), x_S(−1), y(−1); here all of them are
    /// 30 mg/l, the value of x_S(1), unless replaced.
    pub fn printed(exponent: Exponent, delay: usize) -> Self {
        let tenths = |entry: i64| ratio(entry, 10);
        let earlier = Earlier { substrate: ratio(30, 1), reading: ratio(30, 1) };
        Self {
            reactor: Reactor::printed(exponent),
            noise_factor: [[tenths(3), tenths(1)], [tenths(1), tenths(1)]],
            first: [ratio(25, 1), ratio(30, 1)],
            earlier: vec![earlier; delay],
        }
    }
}

impl<T: Concentration> Setting<T> {
    /// d.
    pub fn delay(&self) -> usize {
        self.earlier.len()
    }

    /// D Dᵀ, 2×2.
    pub fn noise_covariance(&self) -> Matrix<T> {
        let d = &self.noise_factor;
        Matrix::from_fn(2, 2, |i, j| d[i][0].clone() * d[j][0].clone() + d[i][1].clone() * d[j][1].clone())
    }

    /// The same with every number the nearest double.
    pub fn doubles(&self) -> Setting<f64> {
        let earlier =
            |earlier: &Earlier<T>| Earlier { substrate: earlier.substrate.double(), reading: earlier.reading.double() };
        Setting {
            reactor: self.reactor.doubles(),
            noise_factor: self.noise_factor.each_ref().map(|row| row.each_ref().map(T::double)),
            first: self.first.each_ref().map(T::double),
            earlier: self.earlier.iter().map(earlier).collect(),
        }
    }

    /// The rates of transition k, where `read(j)` is y_j; it is asked for j = k − d only. The substrate of an observed
    /// step is its reading (HV-8c).
    ///
    /// # Errors
    ///
    /// [`Unphysical`] where a law has no value; nothing if the reading is missing.
    pub fn coefficients(
        &self,
        k: usize,
        read: impl FnOnce(usize) -> Option<T>,
    ) -> Result<Option<Coefficients<T>>, Unphysical> {
        let seen = match k.checked_sub(self.delay()) {
            None => Some(self.earlier[k].clone()),
            Some(j) => read(j).map(|y| Earlier { substrate: y.clone(), reading: y }),
        };
        let Some(Earlier { substrate, reading }) = seen else { return Ok(None) };
        let dilution = self.reactor.dilution(&reading)?;
        Ok(Some(Coefficients { growth: self.reactor.growth_rate(&substrate)?, dilution }))
    }

    /// The states x_0, …, x_n under noise w_0, …, w_{n−1}, each ~ N(0, I) of dimension two.
    ///
    /// HV-8c: `y(k) = x_S(k)`
    ///
    /// # Errors
    ///
    /// [`BioreactorError::Unphysical`] with the transition that cannot be done.
    pub fn simulated(&self, noise: &[[T; 2]]) -> Result<Vec<[T; 2]>, BioreactorError> {
        let mut states = vec![self.first.clone()];
        for (k, [first, second]) in noise.iter().enumerate() {
            let rates = self.coefficients(k, |j| states.get(j).map(|[_, substrate]| substrate.clone()));
            let rates = rates.map_err(|source| BioreactorError::Unphysical { step: k, source })?;
            let (Some(Coefficients { growth, dilution }), Some(state)) = (rates, states.last()) else { break };
            let share = |[one, other]: &[T; 2]| one.clone() * first.clone() + other.clone() * second.clone();
            let disturbance = self.noise_factor.each_ref().map(share);
            let next = self.reactor.next(state, &growth, &dilution, &disturbance);
            states.push(next);
        }
        Ok(states)
    }
}
