//! Sums of Gaussian laws with masses, and what they integrate: polynomials, exponentials, half-spaces.

use num_traits::{Signed, Zero};

use super::exponential_sum::{narrowed, size};
use super::{Enclosed, Evidence, ExponentialSum, Posterior, Unresolved};
use crate::gaussian::{Gaussian, Polynomial};
use crate::matrix::Matrix;
use crate::scalar::{Interval, OrderedField, Rational, ratio};

/// A finite measure: Gaussian laws, each with a mass `weight · determinant^(−½) · exp(exponent)` that is exact in its parts.
///
/// 𝒯φ and 𝒰φ are the integrals of φ under such measures ([`super::JointLaw`], [`super::Functional`]).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Measure<S> {
    /// Masses and laws.
    pub parts: Vec<(Evidence<S>, Gaussian<S>)>,
}

/// The x with `normalᵀx ≤ offset`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HalfSpace<S> {
    /// n×1; where it is 0, the half-space is everything or nothing.
    pub normal: Matrix<S>,
    /// The offset.
    pub offset: S,
}

impl Measure<Rational> {
    /// Its mass.
    pub fn total(&self) -> ExponentialSum {
        ExponentialSum::new(self.parts.iter().map(|(mass, _)| (mass.clone(), ratio(1, 1))))
    }

    /// The integral of a polynomial.
    ///
    /// # Panics
    ///
    /// If it has not one variable for each component of the state.
    pub fn polynomial(&self, polynomial: &Polynomial<Rational>) -> ExponentialSum {
        ExponentialSum::new(self.parts.iter().map(|(mass, law)| match law.expectation(polynomial) {
            Ok(value) => (mass.clone(), value),
            Err(error) => unreachable!("a covariance is positive semidefinite, but {error}"),
        }))
    }

    /// The integral of exp(θᵀx), θ being n×1: each law N(m, C) adds its mass times exp(θᵀm + ½ θᵀCθ).
    ///
    /// # Panics
    ///
    /// If θ has another shape.
    pub fn exponential(&self, theta: &Matrix<Rational>) -> ExponentialSum {
        ExponentialSum::new(self.parts.iter().map(|(mass, law)| {
            let parts = law.characteristic_exponent(theta);
            let exponent = &mass.exponent + parts.linear + parts.quadratic * ratio(1, 2);
            (Evidence { exponent, ..mass.clone() }, ratio(1, 1))
        }))
    }

    /// The mass of a half-space, with a relative width of at most 2^−bits.
    ///
    /// # Errors
    ///
    /// [`Unresolved`] where it has no exponent.
    ///
    /// # Panics
    ///
    /// If the half-space has another dimension.
    pub fn half_space(&self, half_space: &HalfSpace<Rational>, bits: u64) -> Result<Interval, Unresolved> {
        narrowed(bits, |work| self.below(half_space, &Rational::zero(), work))
    }

    /// The mass of a half-space over exp(base).
    fn below(&self, half_space: &HalfSpace<Rational>, base: &Rational, work: u64) -> Option<Interval> {
        let HalfSpace { normal, offset } = half_space;
        self.parts.iter().try_fold(Interval::zero(), |sum, (mass, law)| {
            let along = law.characteristic_exponent(normal);
            let (away, variance) = (offset - along.linear, along.quadratic);
            if variance.is_zero() {
                // An atom on this line.
                return if away.is_negative() { Some(sum) } else { Some(sum.plus(&size(mass, base, work)?, work)) };
            }
            let square = &away * &away / variance;
            let probability = Interval::normal_distribution_of_root(away.is_negative(), &square, work).ok()?;
            Some(sum.plus(&probability.times(&size(mass, base, work)?, work), work))
        })
    }
}

impl<S: OrderedField> Posterior<S> {
    /// The conditional law before it is divided by its mass: φ ↦ 𝒰φ.
    pub fn measure(&self) -> Measure<S> {
        Measure { parts: self.components.iter().map(|part| (part.evidence.clone(), part.state.clone())).collect() }
    }
}

impl Posterior<Rational> {
    /// E[φ(X°) | readings] for a polynomial φ: a fraction, which is decided, or irrational and with a relative width of at most
    /// 2^−bits.
    ///
    /// # Errors
    ///
    /// [`Unresolved`] where terms cancel too far.
    ///
    /// # Panics
    ///
    /// If it has not one variable for each component of the state.
    ///
    /// # Examples
    ///
    /// A coin that is 0 or 1, read once as 1 through noise of variance 2: all its moments are the probability of 1, 0.56217….
    ///
    /// ```
    /// use exact_kalman::gaussian::Polynomial;
    /// use exact_kalman::matrix::Matrix;
    /// use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
    /// use exact_kalman::nongaussian::{Enclosed, HalfSpace, InitialLaw, statistics};
    /// use exact_kalman::scalar::{Rational, ratio};
    ///
    /// let one = Matrix::<Rational>::identity(1);
    /// let zero = Matrix::zeros(1, 1);
    /// let system = System {
    ///     timing: Timing::Departing,
    ///     initial: Initial::new(Before::Observation, zero.clone(), zero.clone()),
    ///     transition: one.clone().into(),
    ///     observation: one.clone().into(),
    ///     noise: Noise::Covariances { process: zero.clone().into(), cross: None, observation: one.scaled(&ratio(2, 1)).into() },
    ///     input: None,
    ///     observation_input: None,
    /// };
    /// let path = system.realised(&[Observation::complete([ratio(1, 1)])])?;
    /// let coin = InitialLaw::atoms([(ratio(1, 2), zero), (ratio(1, 2), one.clone())])?;
    /// let posterior = statistics(&path)?[1].posterior(&coin);
    ///
    /// let Enclosed::Between(cube) = posterior.expectation(&Polynomial::term(ratio(1, 1), vec![3]), 30)? else { unreachable!() };
    /// assert!(cube.lower().value() > Some(ratio(56_217, 100_000)) && cube.upper().value() < Some(ratio(56_218, 100_000)));
    /// // E exp(X) = 1 + (e − 1)·0.56217… = 1.96596…
    /// let Enclosed::Between(growth) = posterior.moment_generating(&one, 30)? else { unreachable!() };
    /// assert!(growth.lower().value() > Some(ratio(196_596, 100_000)) && growth.upper().value() < Some(ratio(196_598, 100_000)));
    /// let below = posterior.probability(&HalfSpace { normal: one, offset: ratio(1, 2) }, 30)?;
    /// assert!(below.lower().value() > Some(ratio(43_782, 100_000)) && below.upper().value() < Some(ratio(43_783, 100_000)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn expectation(&self, polynomial: &Polynomial<Rational>, bits: u64) -> Result<Enclosed, Unresolved> {
        let measure = self.measure();
        measure.polynomial(polynomial).over(&measure.total(), bits)
    }

    /// E[exp(θᵀX°) | readings] for θ of shape n×1, the conditional moment generating function: as [`Posterior::expectation`].
    ///
    /// # Errors
    ///
    /// [`Unresolved`] where an exponent is beyond 2⁶¹.
    ///
    /// # Panics
    ///
    /// If θ has another shape.
    pub fn moment_generating(&self, theta: &Matrix<Rational>, bits: u64) -> Result<Enclosed, Unresolved> {
        let measure = self.measure();
        measure.exponential(theta).over(&measure.total(), bits)
    }

    /// The probability of a half-space given the readings, with a relative width of at most 2^−bits.
    ///
    /// # Errors
    ///
    /// [`Unresolved`] where it is too small to have an exponent.
    ///
    /// # Panics
    ///
    /// If the half-space has another dimension.
    pub fn probability(&self, half_space: &HalfSpace<Rational>, bits: u64) -> Result<Interval, Unresolved> {
        let (measure, total) = (self.measure(), self.measure().total());
        let base = total.largest();
        let whole = |work| {
            let sizes = total.terms().iter().map(|term| size(term, &base, work));
            sizes.into_iter().try_fold(Interval::zero(), |sum, size| Some(sum.plus(&size?, work)))
        };
        narrowed(bits, |work| measure.below(half_space, &base, work)?.over(&whole(work)?, work).ok())
    }
}
