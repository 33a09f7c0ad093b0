//! The price of linearity, simulated where no integral proves it.

use std::fmt;

use num_bigint::BigInt;
use num_traits::Zero;

use super::Stream;
use crate::gaussian::Gaussian;
use crate::matrix::Matrix;
use crate::nongaussian::{Component, InitialLaw, Statistics};
use crate::scalar::{Rational, nearest_double, ratio};

/// A mean over draws: an estimate of the price of linearity, and no proof.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimulatedPrice {
    /// The mean of ‖X̂ − X̂ᴷ‖² over the draws.
    pub mean: f64,
    /// The sample deviation over √draws.
    pub standard_error: f64,
    /// How many.
    pub draws: u32,
    /// The seed of the stream "price of linearity".
    pub seed: u64,
}

/// Why there is no number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("not simulated: doubles do not hold it, or lose it in rounding")]
pub struct NotSimulated;

impl fmt::Display for SimulatedPrice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { mean, standard_error, draws, seed } = self;
        write!(
            f,
            "simulated {mean:.3e} ± {standard_error:.1e}, mean ± standard error of {draws} draws, seed {seed}; no proof"
        )
    }
}

/// Draws ξ ~ F and b ~ N(R*ξ, R*), which is all that the readings tell of ξ (SM-L1), and averages ‖X̂ − X̂ᴷ‖², both estimates computed from b
/// in doubles (SM-epsilon). It works for R* of any rank.
///
/// ε(t) is that of ξ − μ, and grows as the square of the unit of ξ: so the law is first moved to the mean 0, and its numbers to about 1 by a
/// power of two, exactly.
///
/// # Errors
///
/// [`NotSimulated`] where the mean is no double, or lost in the rounding of the estimates.
///
/// # Panics
///
/// If the law has another dimension, or there are fewer than 2 draws.
///
/// # Examples
///
/// ```
/// use exact_kalman::matrix::Matrix;
/// use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
/// use exact_kalman::nongaussian::{InitialLaw, statistics};
/// use exact_kalman::reproduce::simulated_price;
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
/// let found = simulated_price(&statistics(&path)?[1], &coin, 10_000, 1)?;
/// // E(tanh Y − Y/2)² = 0.0504…; five standard errors are exceeded once in a million.
/// assert!((found.mean - 0.050_400_490_8).abs() < 5.0 * found.standard_error);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn simulated_price(
    now: &Statistics<Rational>,
    initial: &InitialLaw<Rational>,
    draws: u32,
    seed: u64,
) -> Result<SimulatedPrice, NotSimulated> {
    assert!(draws >= 2, "a standard error needs two draws");
    let unit = unit(initial);
    let precision = now.precision().scaled(&power_of_two(2 * unit));
    let response = doubles(&now.response());
    let sizes = response.map(|x| x.abs());
    let middle = initial.mean();
    let centred = |law: Gaussian<Rational>| {
        let mean = (law.mean() - &middle).scaled(&power_of_two(-unit));
        gaussian(mean, law.covariance().scaled(&power_of_two(-2 * unit)))
    };
    let component =
        |part: &Component<Rational>| Component { weight: part.weight.clone(), law: centred(part.law.clone()) };
    let parts: Vec<Part> = initial.components().iter().map(|part| Part::new(&component(part), &precision)).collect();
    let all = Component { weight: ratio(1, 1), law: centred(gaussian(middle.clone(), initial.covariance())) };
    let affine = Part::new(&all, &precision);
    let (precision, noise) = (doubles(&precision), root(&precision));
    let mut stream = Stream::named("price of linearity", seed);
    let (mut mean, mut squares, mut rounding) = (0.0, 0.0, 0.0);
    for draw in 1..=draws {
        let chosen = choice(&parts, stream.uniform());
        let start = sum(&chosen.mean, &times(&chosen.root, &normals(&mut stream, chosen.mean.len())));
        let b = sum(&times(&precision, &start), &times(&noise, &normals(&mut stream, start.len())));
        let linear = affine.estimate(&b);
        let away: Vec<f64> = best(&parts, &b).iter().zip(&linear).map(|(one, other)| one - other).collect();
        let value = square(&times(&response, &away));
        rounding += square(&times(&sizes, &linear.iter().map(|x| x.abs()).collect::<Vec<_>>())) * ROUNDING;
        let step = value - mean;
        mean += step / f64::from(draw);
        squares += step * (value - mean);
    }
    let standard_error = (squares / f64::from(draws - 1) / f64::from(draws)).sqrt();
    let in_units =
        |x: f64| libm::ldexp(x, i32::try_from(2 * unit).unwrap_or(if unit < 0 { i32::MIN } else { i32::MAX }));
    let found = SimulatedPrice { mean: in_units(mean), standard_error: in_units(standard_error), draws, seed };
    let is_seen = found.mean.is_normal() && found.standard_error.is_normal() && mean > rounding / f64::from(draws);
    if is_seen || (found.mean == 0.0 && now.is_linear_best(initial)) { Ok(found) } else { Err(NotSimulated) }
}

/// The squares of estimates are off by about this part: their entries by some 10⁻¹⁵, and a digit more is wanted.
const ROUNDING: f64 = 1e-28;

/// The power of two next to the largest deviation of a component from the mean of all, or of an entry from that of its component.
fn unit(initial: &InitialLaw<Rational>) -> i64 {
    let bits = |n: &BigInt| i64::try_from(n.bits()).unwrap_or(i64::MAX / 4);
    let size = |x: &Rational| (!x.is_zero()).then(|| bits(x.numer()) - bits(x.denom()));
    let mean = initial.mean();
    let of_part = |part: &Component<Rational>| {
        let away = part.law.mean() - &mean;
        let spread = part.law.covariance().entries().iter().filter_map(size).max();
        away.entries().iter().filter_map(size).max().max(spread.map(|bits| bits / 2))
    };
    initial.components().iter().filter_map(of_part).max().unwrap_or(0)
}

fn power_of_two(exponent: i64) -> Rational {
    let power = BigInt::from(1) << exponent.unsigned_abs();
    if exponent < 0 { Rational::new(BigInt::from(1), power) } else { power.into() }
}

fn gaussian(mean: Matrix<Rational>, covariance: Matrix<Rational>) -> Gaussian<Rational> {
    match Gaussian::new(mean, covariance) {
        Ok(law) => law,
        Err(error) => unreachable!("a covariance is symmetric, but {error}"),
    }
}

/// A component in doubles.
struct Part {
    weight: f64,
    mean: Vec<f64>,
    /// L√D of its covariance.
    root: Matrix<f64>,
    /// log(weight) − ½ log det(I + ΔR*)
    level: f64,
    precision: Matrix<f64>,
    /// (I + ΔR*)⁻¹Δ and (I + ΔR*)⁻¹μ
    spread: Matrix<f64>,
    centre: Vec<f64>,
}

impl Part {
    fn new(part: &Component<Rational>, precision: &Matrix<Rational>) -> Self {
        let (mean, covariance) = (part.law.mean(), part.law.covariance());
        let regular = Matrix::identity(mean.rows()) + covariance * precision;
        let (Ok(inverse), Ok(determinant)) = (regular.inverse(), regular.determinant()) else {
            unreachable!("I + ΔR* is regular for positive semidefinite Δ and R*")
        };
        let weight = nearest_double(&part.weight);
        Self {
            weight,
            mean: doubles(mean).entries().to_vec(),
            root: root(covariance),
            level: libm::log(weight) - 0.5 * libm::log(nearest_double(&determinant)),
            precision: doubles(precision),
            spread: doubles(&(&inverse * covariance)),
            centre: doubles(&(&inverse * mean)).entries().to_vec(),
        }
    }

    /// E[ξ | b] in it.
    fn estimate(&self, b: &[f64]) -> Vec<f64> {
        sum(&self.centre, &times(&self.spread, b))
    }

    /// The logarithm of its weight given b.
    fn evidence(&self, b: &[f64]) -> f64 {
        let of_mean = times(&self.precision, &self.mean);
        let rest: Vec<f64> = b.iter().zip(&of_mean).map(|(b, m)| b - m).collect();
        let dot = |one: &[f64], other: &[f64]| one.iter().zip(other).map(|(a, b)| a * b).sum::<f64>();
        self.level + dot(&self.mean, b) - 0.5 * dot(&self.mean, &of_mean)
            + 0.5 * dot(&rest, &times(&self.spread, &rest))
    }
}

fn choice(parts: &[Part], uniform: f64) -> &Part {
    let mut left = uniform;
    let inside = |part: &&Part| {
        left -= part.weight;
        left < 0.0
    };
    parts.iter().find(inside).unwrap_or(&parts[parts.len() - 1])
}

/// E[ξ | b]
fn best(parts: &[Part], b: &[f64]) -> Vec<f64> {
    let evidence: Vec<f64> = parts.iter().map(|part| part.evidence(b)).collect();
    let most = evidence.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let sizes: Vec<f64> = evidence.iter().map(|x| libm::exp(x - most)).collect();
    let whole: f64 = sizes.iter().sum();
    parts.iter().zip(&sizes).fold(vec![0.0; b.len()], |mean, (part, size)| {
        let estimate: Vec<f64> = part.estimate(b).iter().map(|x| x * size / whole).collect();
        sum(&mean, &estimate)
    })
}

fn normals(stream: &mut Stream, count: usize) -> Vec<f64> {
    (0..count).map(|_| stream.normal()).collect()
}

fn doubles(matrix: &Matrix<Rational>) -> Matrix<f64> {
    matrix.map(nearest_double)
}

/// L√D of a covariance LDLᵀ.
fn root(covariance: &Matrix<Rational>) -> Matrix<f64> {
    match covariance.ldl() {
        Ok(factors) => {
            let pivots: Vec<f64> = factors.pivots.iter().map(|pivot| nearest_double(pivot).sqrt()).collect();
            let lower = doubles(&factors.lower);
            Matrix::from_fn(lower.rows(), lower.columns(), |row, column| lower[(row, column)] * pivots[column])
        }
        Err(error) => unreachable!("a covariance is positive semidefinite, but {error}"),
    }
}

fn times(matrix: &Matrix<f64>, vector: &[f64]) -> Vec<f64> {
    (0..matrix.rows()).map(|row| matrix.row(row).iter().zip(vector).map(|(a, x)| a * x).sum()).collect()
}

fn square(vector: &[f64]) -> f64 {
    vector.iter().map(|x| x * x).sum()
}

fn sum(one: &[f64], other: &[f64]) -> Vec<f64> {
    one.iter().zip(other).map(|(a, b)| a + b).collect()
}
