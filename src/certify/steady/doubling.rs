//! The stabilising solution by doubling, in fixed point: a proposal.
//!
//! From a point P₁ with Σ > 0 there, with G₁ and N = HᵀΣ⁻¹H of that point,
//!
//! > `φ(P₁ + D) − P₁ = G₁ D (I + N D)⁻¹ G₁ᵀ + φ(P₁) − P₁`
//!
//! so D = S − P₁ solves an equation that structured doubling solves, whether R is regular or not: its iterates are
//! φ^(2ᵏ)(P₁) − P₁, and for P₁ ≥ S they fall to the stabilising solution. With coordinates such that P₁ = I all matrices stay
//! of moderate size, since those of the second kind stay below (P₁ − S)⁻¹.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed};

use super::fixed::{
    Rows, identity, in_units, minus, most_bits, plus, solved, symmetric_product, times, times_transposed, transposed,
};
use crate::model::UnifiedStep;
use crate::scalar::Rational;

/// An approximate solution: `2^(sᵢ + sⱼ − places)` times integers.
#[derive(Clone, Debug)]
pub(super) struct Proposal {
    pub(super) rows: Rows,
    pub(super) units: Vec<i64>,
    pub(super) places: u64,
    /// Whether variances may be negative, since weights are.
    pub(super) is_signed: bool,
}

/// Why there is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Failure {
    /// Σ is singular at the point of departure.
    Singular,
    /// The iterates do not come to rest.
    Restless,
}

/// 2^400 steps, or 2^80 of many states: a closed loop that is nearer to the unit circle is taken for one that reaches it.
const MOST_DOUBLINGS: [usize; 2] = [400, 80];

/// Beyond so many states each doubling takes long.
const FEW_STATES: usize = 8;

/// The units begin with a variance that is larger by the fourth power of two to these.
const LIFTS: [i64; 3] = [6, 40, 160];

/// What rescaling may cost in bits before it is done again.
const WORTH: u64 = 24;

/// Units are mended so often.
const MOST_PASSES: usize = 6;

impl Proposal {
    /// About so many bits of each entry in its unit.
    pub(super) fn of(step: &UnifiedStep, bits: u64) -> Result<Self, Failure> {
        let mut failure = Failure::Restless;
        let start = first_units(step);
        for lift in LIFTS {
            let units: Vec<i64> = start.iter().map(|unit| unit + lift).collect();
            match Self::from(step, &units, bits + 4 * lift.unsigned_abs()) {
                Ok(proposal) => match proposal.mended(step, bits) {
                    Ok(proposal) => return Ok(proposal),
                    Err(found) => failure = found,
                },
                Err(found) => failure = found,
            }
        }
        Err(failure)
    }

    /// The same again from a point near the solution, until it is that.
    fn mended(mut self, step: &UnifiedStep, bits: u64) -> Result<Self, Failure> {
        let n = u64::try_from(self.rows.len()).unwrap_or(u64::MAX);
        let room = i64::from((2 * n).max(2).next_power_of_two().trailing_zeros());
        for _ in 0..MOST_PASSES {
            let sizes = self.sizes();
            let size = |i: usize| sizes[i].map(|bits| bits - i64::try_from(self.places).unwrap_or(i64::MAX));
            let fits = |i| size(i).is_none_or(|size| size <= 1 && size.unsigned_abs() <= WORTH + room.unsigned_abs());
            if (0..sizes.len()).all(fits) && self.places >= bits + WORTH {
                break;
            }
            let unit = |i: usize| self.units[i] + size(i).map_or(0, |size| Integer::div_ceil(&(size + room), &2));
            let units: Vec<i64> = (0..sizes.len()).map(unit).collect();
            let unsigned = room.unsigned_abs();
            self = Self::from(step, &units, bits + 2 * WORTH + 2 * unsigned)?;
        }
        Ok(self)
    }

    /// The bits of each variance; nothing where it is zero as far as one sees.
    pub(super) fn sizes(&self) -> Vec<Option<i64>> {
        let size = |i: usize| {
            let variance = &self.rows[i][i];
            let counts = (self.is_signed || variance.is_positive()) && variance.bits() > self.places / 4;
            counts.then(|| i64::try_from(variance.bits()).unwrap_or(i64::MAX))
        };
        (0..self.rows.len()).map(size).collect()
    }

    /// By doubling from diag(4^units).
    fn from(step: &UnifiedStep, units: &[i64], places: u64) -> Result<Self, Failure> {
        let (n, m) = (step.states(), step.sensors());
        let sensors = sensor_units(step, units);
        let minus_units: Vec<i64> = units.iter().map(|unit| -unit).collect();
        let minus_sensors: Vec<i64> = sensors.iter().map(|unit| -unit).collect();
        let a = in_units(&step.transition, units, units, places);
        let h = in_units(&step.observation, &sensors, units, places);
        let q = in_units(&step.process_noise, units, &minus_units, places);
        let s = in_units(&step.cross_noise, units, &minus_sensors, places);
        let r = in_units(&step.observation_noise, &sensors, &minus_sensors, places);
        let mut closed = a.clone();
        let mut seen = vec![vec![BigInt::default(); n]; n];
        let mut excess = minus(&plus(&symmetric_product(&a, &a, places), &q), &identity(n, places));
        if m > 0 {
            let sigma = plus(&symmetric_product(&h, &h, places), &r);
            let gamma = plus(&times_transposed(&a, &h, places), &s);
            let right: Rows = transposed(&gamma, m).into_iter().zip(&h).map(|(a, b)| [&a[..], b].concat()).collect();
            // Rounding alone keeps the pivots of a singular matrix from zero.
            let solution = solved(&sigma, &right, places, places / 2).ok_or(Failure::Singular)?;
            let gain: Rows = transposed(&solution.iter().map(|row| row[..n].to_vec()).collect(), n);
            let weighed: Rows = solution.iter().map(|row| row[n..].to_vec()).collect();
            closed = minus(&a, &times(&gain, &h, n, places));
            seen = symmetric_product(&transposed(&h, n), &transposed(&weighed, n), places);
            excess = minus(&excess, &symmetric_product(&gain, &gamma, places));
        }
        let solution = doubled(transposed(&closed, n), seen, excess, places).ok_or(Failure::Restless)?;
        let is_signed = (0..n).any(|i| step.process_noise[(i, i)].is_negative());
        Ok(Self { rows: plus(&solution, &identity(n, places)), units: units.to_vec(), places, is_signed })
    }
}

/// X = AᵀX(I + GX)⁻¹A + H, where the iterates from zero converge.
fn doubled(mut a: Rows, mut g: Rows, mut h: Rows, places: u64) -> Option<Rows> {
    let n = a.len();
    for _ in 0..MOST_DOUBLINGS[usize::from(n > FEW_STATES)] {
        let matrix = plus(&identity(n, places), &times_transposed(&g, &h, places));
        let right: Rows = a.iter().zip(&g).map(|(a, g)| [&a[..], &g[..]].concat()).collect();
        let solution = solved(&matrix, &right, places, 0)?;
        let first: Rows = solution.iter().map(|row| row[..n].to_vec()).collect();
        let second: Rows = solution.iter().map(|row| row[n..].to_vec()).collect();
        // Both are symmetric: (I + GH)⁻¹G and H(I + GH)⁻¹.
        g = plus(&g, &symmetric_product(&times(&a, &second, n, places), &a, places));
        let carried = times(&h, &first, n, places);
        h = plus(&h, &symmetric_product(&transposed(&a, n), &transposed(&carried, n), places));
        a = times(&a, &first, n, places);
        if [&a, &g, &h].into_iter().any(|rows| most_bits(rows) > 3 * places) {
            return None;
        }
        if most_bits(&a) < (places / 2).saturating_sub(8) {
            return Some(h);
        }
    }
    None
}

/// e with 2^(e−2) < |value| < 2^e; nothing for zero.
fn magnitude(value: &Rational) -> Option<i64> {
    let bits = |integer: &BigInt| i64::try_from(integer.bits()).unwrap_or(i64::MAX);
    (value.numer().bits() > 0).then(|| bits(value.numer()) - bits(value.denom()) + 1)
}

/// Of deviations: by the noise, by what it reaches, by what reaches that.
fn first_units(step: &UnifiedStep) -> Vec<i64> {
    let n = step.states();
    let half = |size: i64| Integer::div_ceil(&size, &2);
    let mut units: Vec<Option<i64>> = (0..n).map(|i| magnitude(&step.process_noise[(i, i)]).map(half)).collect();
    for _ in 0..n {
        let reached = |i: usize| {
            let from = |j: usize| Some(units[j]? + magnitude(&step.transition[(i, j)])?);
            units[i].or_else(|| (0..n).filter_map(from).max())
        };
        let next: Vec<Option<i64>> = (0..n).map(reached).collect();
        if next == units {
            break;
        }
        units = next;
    }
    let reaching = |i: usize| {
        let to = |j: usize| Some(units[j]? - magnitude(&step.transition[(j, i)])?);
        let seen =
            |j: usize| Some(half(magnitude(&step.observation_noise[(j, j)])?) - magnitude(&step.observation[(j, i)])?);
        let sensors = (0..step.sensors()).filter_map(seen).min();
        units[i].or_else(|| (0..n).filter_map(to).min()).or(sensors).unwrap_or(0)
    };
    (0..n).map(reaching).collect()
}

/// Of readings, where the state has these.
fn sensor_units(step: &UnifiedStep, units: &[i64]) -> Vec<i64> {
    let of = |j: usize| {
        let signals = (0..step.states()).filter_map(|k| Some(magnitude(&step.observation[(j, k)])? + units[k]));
        let noise = magnitude(&step.observation_noise[(j, j)]).map(|size| Integer::div_ceil(&size, &2));
        signals.chain(noise).max().unwrap_or(0)
    };
    (0..step.sensors()).map(of).collect()
}

impl Proposal {
    /// The matrix on a grid of so many bits, each row in the unit of its own deviation, with those units; rows of zeros where
    /// nothing is seen.
    pub(super) fn on_grid(&self, bits: u64) -> (super::Dyadics, Vec<Option<i64>>) {
        let places = i64::try_from(self.places).unwrap_or(i64::MAX);
        let sizes = self.sizes();
        let scale = |i: usize| sizes[i].map(|size| self.units[i] + Integer::div_ceil(&(size - places), &2));
        let scales: Vec<Option<i64>> = (0..sizes.len()).map(scale).collect();
        let least = self.units.iter().copied().min().unwrap_or(0);
        let lift = |i: usize| if scales[i].is_some() { self.units[i] - least } else { 0 };
        let gone = |i: usize| scales[i].is_none();
        let mantissas = super::symmetric(sizes.len(), |i, j| {
            if gone(i) || gone(j) { BigInt::default() } else { &self.rows[i][j] << (lift(i) + lift(j)) }
        });
        let exact = super::Dyadics { mantissas, exponent: 2 * least - places };
        (super::rounded(&exact, &BigInt::one(), &scales, bits).0, scales)
    }
}
