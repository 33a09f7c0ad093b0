//! A component along a row of a lattice, in fixed point.
//!
//! Along a row the logarithm of a density is quadratic, so from the node next to its peak outwards each density is the one before
//! times a ratio below 1, and each ratio the one before times a constant. In units of the last place, with everything rounded
//! down, the ratios are off by at most `r₀ + l(g + 1)` after l steps and the densities by `p₀ + l(r₀ + 1) + l²(g + 1)`.

use num_bigint::BigInt;
use num_traits::{One, Zero};

use super::lattice::Axis;
use super::quadrature::Bump;
use crate::matrix::Matrix;
use crate::scalar::{Interval, Rational, ratio};

/// Where a row lies, and the unit 2^−places of what is summed.
pub(super) struct Ground<'a> {
    pub(super) axis: &'a Axis,
    /// The coordinates before the last.
    pub(super) before: &'a [Rational],
    /// Vectors are taken over 2^scale.
    pub(super) scale: i64,
    pub(super) places: u64,
}

/// A component along a row.
pub(super) struct Line {
    /// The node of the first mass.
    pub(super) first: usize,
    /// The masses of the cells, rounded down; all others are below `error`.
    pub(super) masses: Vec<BigInt>,
    /// How far each may be off.
    pub(super) error: BigInt,
    /// Each coordinate of the vector: its value at the first node of the row, and its step. After l steps it is off by less than l + 1.
    pub(super) values: Vec<(BigInt, BigInt)>,
}

impl Line {
    /// For a component whose peak has this mass.
    pub(super) fn new(bump: &Bump, mass: &Interval, ground: &Ground<'_>) -> Option<Self> {
        let Ground { axis, before, places, .. } = *ground;
        let last = before.len();
        let at = |x: &Rational| Matrix::column(before.iter().chain([x]).cloned().collect());
        let own = &bump.inverse[(last, last)];
        let middle = &bump.mean[(last, 0)];
        let tilt = (bump.inverse.select_rows(&[last]) * (at(middle) - &bump.mean))[(0, 0)].clone();
        let peak = axis.nearest(&(middle - tilt / own));
        let level = |x: &Rational| form(&(at(x) - &bump.mean), bump);
        let top = axis.node(peak);
        let highest = level(&top);
        let mut line = Self { first: peak, masses: Vec::new(), error: BigInt::one(), values: values(bump, ground) };
        // exp(−0.7 places) < 2^−places
        if highest < Rational::new(BigInt::from(places) * -7, BigInt::from(10)) {
            return Some(line);
        }
        let fixed = |x: &Interval| Fixed::new(x, places);
        let exponential = |x: &Rational| Interval::exponential(x, places + 8).ok();
        let start = fixed(&exponential(&highest)?.times(mass, places + 8))?;
        let bend = fixed(&exponential(&(-own * &axis.step * &axis.step))?)?;
        let ratio_towards =
            |sign: i64| fixed(&exponential(&(level(&(&top + &axis.step * ratio(sign, 1))) - &highest))?);
        let (left, right) = (ratio_towards(-1)?, ratio_towards(1)?);
        let outwards = |first: &Fixed, room: usize| {
            let (mut mass, mut quotient) = (start.value.clone(), first.value.clone());
            let mut masses = Vec::new();
            while masses.len() < room {
                mass = (mass * &quotient) >> places;
                if mass.is_zero() {
                    break;
                }
                masses.push(mass.clone());
                quotient = (quotient * &bend.value) >> places;
            }
            masses
        };
        let (mut masses, after) = (outwards(&left, peak), outwards(&right, axis.count - 1 - peak));
        line.first = peak - masses.len();
        masses.reverse();
        masses.push(start.value.clone());
        masses.extend(after);
        line.masses = masses;
        let steps = BigInt::from(axis.count);
        let of_ratios = left.error.max(right.error) + 1_u8;
        line.error += start.error + &steps * of_ratios + &steps * &steps * (bend.error + 1_u8);
        Some(line)
    }
}

/// The logarithm of the density over that at the mean.
fn form(away: &Matrix<Rational>, bump: &Bump) -> Rational {
    away.transpose().congruence(&bump.inverse)[(0, 0)].clone() * ratio(-1, 2)
}

fn values(bump: &Bump, ground: &Ground<'_>) -> Vec<(BigInt, BigInt)> {
    let Ground { axis, before, scale, places } = *ground;
    let power = |exponent: i64| BigInt::one() << u64::try_from(exponent).unwrap_or(0);
    let unit = Rational::new(power(-scale) << places, power(scale));
    let fixed = |value: &Rational| (value * &unit).floor().to_integer();
    let start = &bump.slope * Matrix::column(before.iter().chain([&axis.node(0)]).cloned().collect()) + &bump.offset;
    let steps = bump.slope.select_columns(&[before.len()]).scaled(&axis.step);
    start.entries().iter().zip(steps.entries()).map(|(value, step)| (fixed(value), fixed(step))).collect()
}

/// A number between 0 and 1, rounded down to units of the last place.
struct Fixed {
    value: BigInt,
    /// How far it may be off.
    error: BigInt,
}

impl Fixed {
    fn new(x: &Interval, places: u64) -> Option<Self> {
        let unit = Rational::from(BigInt::one() << places);
        let value = (x.lower().value()? * &unit).floor().to_integer();
        let error = (x.upper().value()? * unit).ceil().to_integer() - &value;
        Some(Self { value, error })
    }
}
