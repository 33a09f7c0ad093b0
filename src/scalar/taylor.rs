//! Taylor polynomials with enclosed coefficients, for rigorous quadrature.

use super::{Interval, Overflow, Rational, Undefined};
use num_bigint::BigInt;

/// The first Taylor coefficients of a function at every point of an interval (or at one point): f, f′, f″/2, ….
///
/// An operation on two of them encloses the coefficients of its result. Over a whole cell, the last coefficient bounds
/// the remainder.
#[derive(Clone, Debug)]
pub struct Taylor {
    coefficients: Vec<Interval>,
    bits: u64,
}

impl Taylor {
    /// The expansion of order `order` that begins with these coefficients; the others are zero.
    pub fn new(first: impl IntoIterator<Item = Interval>, order: usize, bits: u64) -> Self {
        let coefficients = first.into_iter().chain(std::iter::repeat_with(Interval::zero)).take(order + 1).collect();
        Self { coefficients, bits }
    }

    /// The coefficients, from order 0 on.
    pub fn coefficients(&self) -> &[Interval] {
        &self.coefficients
    }

    /// The sum.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let pairs = self.coefficients.iter().zip(&other.coefficients);
        Self { coefficients: pairs.map(|(a, b)| a.plus(b, self.bits)).collect(), bits: self.bits }
    }

    /// The product, of the lower order of both.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let count = self.coefficients.len().min(other.coefficients.len());
        let coefficient = |n: usize| self.convolution(other, 0..=n, n);
        Self { coefficients: (0..count).map(coefficient).collect(), bits: self.bits }
    }

    /// The quotient.
    ///
    /// # Errors
    ///
    /// [`Undefined`] if the divisor may be zero somewhere.
    pub fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
        let first = divisor.coefficients.first().ok_or(Undefined::DivisionByZero)?;
        let mut quotient = Self { coefficients: Vec::new(), bits: self.bits };
        // f = q d: q_n = (f_n − Σ_{k≥1} d_k q_{n−k})/d_0
        for (n, coefficient) in self.coefficients.iter().enumerate().take(divisor.coefficients.len()) {
            let known = divisor.convolution(&quotient, 1..=n, n);
            quotient.coefficients.push(coefficient.minus(&known, self.bits).over(first, self.bits)?);
        }
        Ok(quotient)
    }

    /// The exponential.
    ///
    /// # Errors
    ///
    /// [`Overflow`] where it has no exponent, or the ends of the argument are too long to be written out.
    pub fn exponential(&self) -> Result<Self, Overflow> {
        let Some((first, rest)) = self.coefficients.split_first() else { return Ok(self.clone()) };
        let end = |end: Option<Rational>| Interval::exponential(&end.ok_or(Overflow)?, self.bits);
        let mut result = Self {
            coefficients: vec![end(first.lower().value())?.joined(&end(first.upper().value())?)],
            bits: self.bits,
        };
        // f′ = g′f: n f_n = Σ_{k≥1} k g_k f_{n−k}
        let derivative = Self {
            coefficients: std::iter::once(Interval::zero())
                .chain((1..).zip(rest).map(|(k, g)| g.times(&self.integer(k), self.bits)))
                .collect(),
            bits: self.bits,
        };
        for n in 1..self.coefficients.len() {
            let sum = derivative.convolution(&result, 1..=n, n);
            let divisor = self.integer(n);
            let coefficient = sum.over(&divisor, self.bits).unwrap_or_else(|_| unreachable!("{n} is not zero"));
            result.coefficients.push(coefficient);
        }
        Ok(result)
    }

    /// Σ a_k b_{n−k} over some k.
    fn convolution(&self, other: &Self, k: std::ops::RangeInclusive<usize>, n: usize) -> Interval {
        let terms = k.filter_map(|k| Some((self.coefficients.get(k)?, other.coefficients.get(n - k)?)));
        terms.fold(Interval::zero(), |sum, (a, b)| {
            if is_zero(a) || is_zero(b) { sum } else { sum.plus(&a.times(b, self.bits), self.bits) }
        })
    }

    fn integer(&self, value: usize) -> Interval {
        Interval::of(&Rational::from(BigInt::from(value)), self.bits)
    }
}

fn is_zero(interval: &Interval) -> bool {
    interval.lower().is_zero() && interval.upper().is_zero()
}
