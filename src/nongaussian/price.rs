//! The price of linearity: how much worse the best affine estimate is than the best one.

use super::quadrature::{Along, integral};
use super::{Enclosed, InitialLaw, Statistics};
use crate::matrix::Matrix;
use crate::scalar::{OrderedField, Rational, ratio};

/// Why the price is not computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PriceError {
    /// The integral is over more than one dimension.
    #[error("the readings see {rank} directions of the initial state; the integral is computed for one")]
    Dimension {
        /// The rank of R*.
        rank: usize,
    },
    /// It did not become as narrow as asked for.
    #[error("no enclosure of width 2^-{bits} with {cells} cells")]
    TooWide {
        /// The bits asked for.
        bits: u64,
        /// The most cells that are used.
        cells: usize,
    },
}

/// A component of F as the integral sees it: b is Gaussian, and in it `E[Q*ξ | b] − X̂ᴷ + X̄` is affine in b.
struct Part<S> {
    weight: S,
    /// R*μ and R* + R*ΔR*, the law of b.
    mean: Matrix<S>,
    covariance: Matrix<S>,
    /// The difference of the estimates, `slope b + offset`.
    slope: Matrix<S>,
    offset: Matrix<S>,
}

impl<S: OrderedField> Statistics<S> {
    /// Whether best and best affine estimate are equal for almost all readings, exactly decided, in any dimension.
    ///
    /// Densities of different Gaussian laws times polynomials are linearly independent, so ε(t) is zero exactly if the
    /// differences cancel within each set of components under which b has one law.
    ///
    /// SM-T3: `ε(t+1) is the integral (4.30) for every t ≥ 0`
    ///
    /// # Panics
    ///
    /// If the law has another dimension.
    pub fn is_linear_best(&self, initial: &InitialLaw<S>) -> bool {
        let (parts, precision) = (self.parts(initial), self.precision());
        parts.iter().all(|one| {
            let alike = parts.iter().filter(|other| (&one.mean, &one.covariance) == (&other.mean, &other.covariance));
            let n = self.mean.rows();
            let zero = (Matrix::zeros(n, n), Matrix::zeros(n, 1));
            let (slope, offset) = alike.fold(zero, |(slope, offset), part| {
                (slope + part.slope.scaled(&part.weight), offset + part.offset.scaled(&part.weight))
            });
            // b runs through the range of R*.
            (slope * &precision).is_zero() && offset.is_zero()
        })
    }

    fn parts(&self, initial: &InitialLaw<S>) -> Vec<Part<S>> {
        let (response, precision, n) = (self.response(), self.precision(), self.mean.rows());
        // Mean of Q*ξ given b as slope and offset, for N(μ, Δ).
        let affine = |mean: &Matrix<S>, covariance: &Matrix<S>| {
            let (offset, slope) = super::linear::tilted(mean, covariance, &Matrix::zeros(n, 1), &precision);
            (&response * slope, &response * offset)
        };
        let (slope, offset) = affine(&initial.mean(), &initial.covariance());
        let part = |component: &super::Component<S>| {
            let (mean, covariance) = (component.law.mean(), component.law.covariance());
            let (own_slope, own_offset) = affine(mean, covariance);
            Part {
                weight: component.weight.clone(),
                mean: &precision * mean,
                covariance: &precision + precision.congruence(covariance),
                slope: own_slope - &slope,
                offset: own_offset - &offset,
            }
        };
        initial.components().iter().map(part).collect()
    }
}

impl Statistics<Rational> {
    /// ε(t), by how much the mean squared error of the best affine estimate exceeds that of the best one: 0 exactly, or
    /// enclosed with a width of at most 2^−bits.
    ///
    /// SM-epsilon: `ε(t) = E‖X̂(t) − X̂ᴷ(t)‖²,  t = 1, 2, …`
    ///
    /// SM-4.30: `ε(t+1) = ∫ ‖Q*(t+1) ∫ {z − [R*(t+1) + Δ⁻¹]⁻¹[b + Δ⁻¹μ]} ω(z,b) dF(z)‖² [∫ ω(z,b) dF(z)]⁻¹ dG(b),  ω(z,b) = exp(zᵀb − ½ zᵀR*(t+1)z),  G = N(0, R*(t+1))`
    ///
    /// `∫ ω(z,b) dF(z) dG(b)` is the law of b under ℙ, a mixture of Gaussian laws, so for R* = c v vᵀ the integral is
    /// `∫ ‖Σ pᵢ(x) aᵢ(x)‖² / Σ pᵢ(x) dx` along one line, with densities pᵢ and affine aᵢ. It is enclosed by Taylor
    /// polynomials on cells, their remainders, and a bound of the tails.
    ///
    /// # Errors
    ///
    /// [`PriceError`] where R* has a rank above 1, unless ε = 0, or where the cells do not suffice.
    ///
    /// # Panics
    ///
    /// If the law has another dimension.
    pub fn price_of_linearity(&self, initial: &InitialLaw<Rational>, bits: u64) -> Result<Enclosed, PriceError> {
        let precision = self.precision();
        if self.is_linear_best(initial) {
            return Ok(Enclosed::Exact(ratio(0, 1)));
        }
        let rank = precision.rank();
        let entries = 0..precision.rows();
        let Some(pivot) = entries.clone().find(|&i| precision[(i, i)] > ratio(0, 1)) else {
            return Ok(Enclosed::Exact(ratio(0, 1)));
        };
        if rank > 1 {
            return Err(PriceError::Dimension { rank });
        }
        // b = v x with x = b_pivot: R* = c v vᵀ, c = R*_pivot,pivot.
        let direction = precision.select_columns(&[pivot]).map(|entry| entry / &precision[(pivot, pivot)]);
        let along = |part: Part<Rational>| {
            let slope = part.slope * &direction;
            Along {
                weight: part.weight,
                mean: part.mean[(pivot, 0)].clone(),
                variance: part.covariance[(pivot, pivot)].clone(),
                differences: entries
                    .clone()
                    .map(|row| (part.offset[(row, 0)].clone(), slope[(row, 0)].clone()))
                    .collect(),
            }
        };
        let parts: Vec<Along> = self.parts(initial).into_iter().map(along).collect();
        integral(&parts, bits).map(Enclosed::Between)
    }
}
