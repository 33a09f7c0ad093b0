//! The growth rate as a function of the substrate.

use std::fmt;

use num_traits::{FromPrimitive, Num};

use super::{Reactor, Unphysical};
use crate::scalar::{Rational, exact_value, nearest_double};

/// The exponent β of the growth law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exponent {
    /// A natural number: the law is rational, and over the rationals exact.
    Natural(u32),
    /// Any real number: the law is evaluated in doubles. Over the rationals *the rounded double is the datum*: what follows
    /// from it is exact, the law itself is not.
    Real(f64),
}

impl fmt::Display for Exponent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Natural(n) => fmt::Display::fmt(n, f),
            Self::Real(beta) => fmt::Display::fmt(beta, f),
        }
    }
}

/// Numbers that a concentration may be: doubles, or exact rationals.
pub trait Concentration: Num + FromPrimitive + PartialOrd + Clone + fmt::Debug + Send + Sync + 'static {
    /// The nearest double.
    fn double(&self) -> f64;

    /// The growth rate and its derivative at a substrate that is not negative, for an exponent that is no natural number.
    ///
    /// # Errors
    ///
    /// As [`Reactor::growth_rate`].
    fn real_growth(reactor: &Reactor<Self>, beta: f64, substrate: &Self) -> Result<[Self; 2], Unphysical>;
}

impl Concentration for f64 {
    fn double(&self) -> f64 {
        *self
    }

    fn real_growth(reactor: &Reactor<f64>, beta: f64, substrate: &f64) -> Result<[f64; 2], Unphysical> {
        // Not `powf`, which may differ between machines.
        reactor.growth_from_power(substrate, &libm::pow(*substrate, beta), &beta)
    }
}

impl Concentration for Rational {
    fn double(&self) -> f64 {
        nearest_double(self)
    }

    fn real_growth(reactor: &Reactor<Self>, beta: f64, substrate: &Self) -> Result<[Self; 2], Unphysical> {
        let [rate, slope] = f64::real_growth(&reactor.doubles(), beta, &substrate.double())?;
        let exact = |value: f64| exact_value(value).ok_or(Unphysical::NoGrowthRate { substrate: substrate.double() });
        Ok([exact(rate)?, exact(slope)?])
    }
}

impl<T: Concentration> Reactor<T> {
    /// The growth rate at a substrate, in 1/h.
    ///
    /// HV-mu: `μ(k) = α x_S(k−1)/(γ + x_S(k−1)^β)`
    ///
    /// # Errors
    ///
    /// [`Unphysical`] for a negative substrate, where γ + x^β = 0, and where rate or derivative is not finite.
    pub fn growth_rate(&self, substrate: &T) -> Result<T, Unphysical> {
        let [rate, _] = self.growth(substrate)?;
        Ok(rate)
    }

    /// The derivative of the growth rate by the substrate, `α(γ + (1 − β)x^β)/(γ + x^β)²`.
    ///
    /// # Errors
    ///
    /// As [`Reactor::growth_rate`].
    pub fn growth_slope(&self, substrate: &T) -> Result<T, Unphysical> {
        let [_, slope] = self.growth(substrate)?;
        Ok(slope)
    }

    fn growth(&self, substrate: &T) -> Result<[T; 2], Unphysical> {
        if *substrate < T::zero() {
            return Err(Unphysical::NegativeSubstrate { value: substrate.double() });
        }
        match self.exponent {
            Exponent::Natural(n) => {
                let power = num_traits::pow(substrate.clone(), usize::try_from(n).unwrap_or(usize::MAX));
                let beta = T::from_u32(n).ok_or(Unphysical::NoGrowthRate { substrate: substrate.double() })?;
                self.growth_from_power(substrate, &power, &beta)
            }
            Exponent::Real(beta) => T::real_growth(self, beta, substrate),
        }
    }

    /// The law and its derivative, from x and x^β: `(x^β)′ x = β x^β`.
    fn growth_from_power(&self, substrate: &T, power: &T, beta: &T) -> Result<[T; 2], Unphysical> {
        let (alpha, gamma) = (&self.growth_factor, &self.growth_offset);
        let divisor = gamma.clone() + power.clone();
        if divisor.is_zero() {
            return Err(Unphysical::NoGrowthRate { substrate: substrate.double() });
        }
        let rate = alpha.clone() * substrate.clone() / divisor.clone();
        let is_finite = |value: &T| (value.clone() - value.clone()).is_zero();
        let slope = if is_finite(power) {
            // Neither the square of the divisor nor βx^β need be finite.
            let shares =
                gamma.clone() / divisor.clone() + (T::one() - beta.clone()) * (power.clone() / divisor.clone());
            alpha.clone() / divisor * shares
        } else {
            T::zero()
        };
        if !is_finite(&rate) || !is_finite(&slope) {
            return Err(Unphysical::NoGrowthRate { substrate: substrate.double() });
        }
        Ok([rate, slope])
    }
}
