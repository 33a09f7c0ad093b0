//! The price of linearity: how much worse the best affine estimate is than the best one.

use num_bigint::BigInt;

use super::quadrature::{Bump, MOST_WORK, Plan};
use super::{Enclosed, InitialLaw, Statistics};
use crate::matrix::Matrix;
use crate::scalar::{Dyadic, Interval, OrderedField, Rational, Toward, nearest_double, ratio};

/// Why the price is not computed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PriceError {
    /// The integral is over more than two dimensions.
    #[error("the readings see {rank} directions of the initial state; the integral is computed for two at most")]
    Dimension {
        /// The rank of R*.
        rank: usize,
    },
    /// It did not become as narrow as asked for.
    #[error("not proved to {bits} bits with {work} evaluations of a component")]
    TooWide {
        /// The bits asked for.
        bits: u64,
        /// The most work, in evaluations of a component at a point in 64 bits.
        work: u32,
        /// What is proved.
        found: Interval,
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
    /// enclosed with a relative width of at most 2^−bits.
    ///
    /// SM-epsilon: `ε(t) = E‖X̂(t) − X̂ᴷ(t)‖²,  t = 1, 2, …`
    ///
    /// SM-4.30: `ε(t+1) = ∫ ‖Q*(t+1) ∫ {z − [R*(t+1) + Δ⁻¹]⁻¹[b + Δ⁻¹μ]} ω(z,b) dF(z)‖² [∫ ω(z,b) dF(z)]⁻¹ dG(b),  ω(z,b) = exp(zᵀb − ½ zᵀR*(t+1)z),  G = N(0, R*(t+1))`
    ///
    /// `∫ ω(z,b) dF(z) dG(b)` is the law of b under ℙ, a mixture of Gaussian laws on the range of R*, so with coordinates x of the
    /// range the integral is `∫ ‖Σ pᵢ(x) aᵢ(x)‖² / Σ pᵢ(x) dx`, with densities pᵢ and affine aᵢ. It is enclosed by the midpoint
    /// rule and a bound of its error, which is exponentially small, over a line or a plane.
    ///
    /// # Errors
    ///
    /// [`PriceError`] where R* has a rank above 2, unless ε = 0, or where it would be too much work: then with what is
    /// proved.
    ///
    /// # Panics
    ///
    /// If the law has another dimension, or R* is not positive semidefinite, as that of [`super::statistics`] is.
    ///
    /// # Examples
    ///
    /// A coin with values ±1 read once through noise of variance 1: ε = E(tanh Y − Y/2)² = 0.05040049….
    ///
    /// ```
    /// use exact_kalman::matrix::Matrix;
    /// use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
    /// use exact_kalman::nongaussian::{Enclosed, InitialLaw, statistics};
    /// use exact_kalman::scalar::{Rational, ratio};
    ///
    /// let one = Matrix::<Rational>::identity(1);
    /// let system = System {
    ///     timing: Timing::Departing,
    ///     initial: Initial::new(Before::Observation, Matrix::zeros(1, 1), Matrix::zeros(1, 1)),
    ///     transition: one.clone().into(),
    ///     observation: one.clone().into(),
    ///     noise: Noise::Covariances { process: one.clone().into(), cross: None, observation: one.clone().into() },
    ///     input: None,
    ///     observation_input: None,
    /// };
    /// let path = system.realised(&[Observation::complete([ratio(0, 1)])])?;
    /// let coin = InitialLaw::atoms([(ratio(1, 2), one.clone()), (ratio(1, 2), one.scaled(&ratio(-1, 1)))])?;
    /// let Enclosed::Between(price) = statistics(&path)?[1].price_of_linearity(&coin, 20)? else { unreachable!() };
    /// assert!(price.lower().value() > Some(ratio(504_004, 10_000_000)));
    /// assert!(price.upper().value() < Some(ratio(504_006, 10_000_000)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn price_of_linearity(&self, initial: &InitialLaw<Rational>, bits: u64) -> Result<Enclosed, PriceError> {
        if self.is_linear_best(initial) {
            return Ok(Enclosed::Exact(ratio(0, 1)));
        }
        let factors = match self.precision().ldl() {
            Ok(factors) => factors,
            Err(error) => unreachable!("R* is positive semidefinite, but {error}"),
        };
        if factors.rank() > 2 {
            return Err(PriceError::Dimension { rank: factors.rank() });
        }
        let seen: Vec<usize> = (0..factors.pivots.len()).filter(|&i| factors.pivots[i] > ratio(0, 1)).collect();
        let directions = factors.lower.select_columns(&seen);
        let bumps: Option<Vec<Bump>> =
            self.parts(initial).into_iter().map(|part| bump(part, &directions, &seen)).collect();
        let spread = self.linear(initial).covariance - &self.covariance;
        let bound = (0..spread.rows()).fold(ratio(0, 1), |sum, i| sum + &spread[(i, i)]);
        let bound = Dyadic::rounded(&bound, 64, Toward::Above);
        let nothing = Interval::between(Dyadic::zero(), bound);
        match bumps {
            Some(bumps) => enclosed(&bumps, nothing, bits).map(Enclosed::Between),
            None => Err(PriceError::TooWide { bits, work: MOST_WORK, found: nothing }),
        }
    }
}

/// A component in coordinates x of the range of R*: b = V x, V being unit lower triangular in the rows `seen`.
fn bump(part: Part<Rational>, directions: &Matrix<Rational>, seen: &[usize]) -> Option<Bump> {
    let coordinates = directions.select_rows(seen).inverse().ok()?;
    let covariance = coordinates.congruence(&part.covariance.select(seen, seen));
    Some(Bump {
        weight: part.weight,
        mean: coordinates * part.mean.select_rows(seen),
        inverse: covariance.inverse().ok()?,
        determinant: covariance.determinant().ok()?,
        covariance,
        slope: part.slope * directions,
        offset: part.offset,
    })
}

/// The integral, which is known to be among `found`, with a relative width of at most 2^−bits.
fn enclosed(bumps: &[Bump], mut found: Interval, bits: u64) -> Result<Interval, PriceError> {
    let size = |end: &Dyadic| end.magnitude().unwrap_or_default();
    // A cheap first attempt, from which one knows how much is missing.
    let mut effort = 40_u64.saturating_add_signed(-size(found.upper())).clamp(40, MOST_EFFORT);
    let mut left = f64::from(MOST_WORK);
    loop {
        let wanted = effort;
        let plan = loop {
            let plan = Plan::new(bumps, effort, &mut left);
            match plan.map(|plan| (plan.work(bumps), plan)) {
                Some((work, plan)) if work <= left => {
                    left -= work;
                    break plan;
                }
                _ if effort <= LEAST_EFFORT => return Err(PriceError::TooWide { bits, work: MOST_WORK, found }),
                Some((work, _)) => effort = less(effort, left / work).max(LEAST_EFFORT),
                None => effort = less(effort, 1.0).max(LEAST_EFFORT),
            }
        };
        if let Some(better) = plan.integral(bumps) {
            let (lower, upper) = (better.lower().max(found.lower()), better.upper().min(found.upper()));
            debug_assert!(lower <= upper, "{better:?} and {found:?} hold one number");
            if lower <= upper {
                found = Interval::between(lower.clone(), upper.clone());
            }
        }
        let width = found.upper().plus(&found.lower().negated(), 64, Toward::Above);
        let part = Dyadic::new(BigInt::from(1), -i64::try_from(bits).unwrap_or(i64::MAX));
        let allowed = found.lower().times(&part, 64, Toward::Below);
        if width <= allowed {
            return Ok(found);
        }
        if effort < wanted || effort >= MOST_EFFORT {
            return Err(PriceError::TooWide { bits, work: MOST_WORK, found });
        }
        let missing = if found.lower().is_zero() { None } else { u64::try_from(size(&width) - size(&allowed)).ok() };
        effort = (effort + missing.map_or(effort, |missing| missing + 2)).min(MOST_EFFORT);
    }
}

/// The effort for this part of the work, which grows at least as its square; an eighth less at least.
fn less(effort: u64, part: f64) -> u64 {
    let square = |effort: u64| nearest_double(&Rational::from(BigInt::from(effort * effort)));
    (0..=effort - effort.div_ceil(8)).rev().find(|&less| square(less) <= part * square(effort)).unwrap_or(0)
}

/// Bits of effort below which nothing is learned, and above which nothing is tried.
const LEAST_EFFORT: u64 = 8;
const MOST_EFFORT: u64 = 1 << 13;
