//! How far beside the real axis the integrand is analytic.
//!
//! At x + iy on one axis the phase of pᵢ/pⱼ is y times the derivative of r = log(pᵢ/pⱼ) at x, and r is quadratic. So let a box be
//! cut into cells. In each, leave out what is negligible: i is if `|pᵢ| ≤ |pⱼ|/(4k)` throughout for some j, k being the number of
//! components. If the phases of all others differ by at most 3/2 < π/2, then beside that of the largest density no
//! other takes anything away, and `|Σ pᵢ| ≥ ¾ max |pᵢ| ≥ ¾/k Σ |pᵢ|`.

use num_bigint::BigInt;
use num_traits::Signed;

use super::quadrature::{Bounds, Bump, COARSE, root_above};
use crate::matrix::Matrix;
use crate::scalar::{Interval, Rational, ratio};

/// For each axis an α such that for |y| ≤ α, everywhere in the box, `|Σ pᵢ| ≥ ¾/k Σ |pᵢ|` at x + iy, and α²κ ≤ 4 for each κ.
pub(super) fn half_widths(bumps: &[Bump], bounds: &Bounds) -> Option<Vec<Rational>> {
    let (cells, halves) = Cells::of(bounds);
    let middle = Matrix::column(bounds.iter().map(|(first, last)| (first + last) * ratio(1, 2)).collect());
    let pairs: Vec<Quotient> = (0..bumps.len())
        .flat_map(|i| (0..i).map(move |j| (i, j)))
        .map(|(i, j)| Quotient::new(bumps, i, j, &middle, &halves))
        .collect::<Option<_>>()?;
    let threshold = threshold(bumps.len());
    let mut steepest = vec![ratio(0, 1); bounds.len()];
    for cell in cells {
        let found: Vec<Range> = pairs.iter().map(|pair| pair.over(&cell)).collect::<Option<_>>()?;
        let mut matters = vec![true; bumps.len()];
        for (pair, range) in pairs.iter().zip(&found) {
            matters[pair.one] &= range.most > -&threshold;
            matters[pair.other] &= range.least < threshold;
        }
        for (pair, range) in pairs.iter().zip(&found).filter(|(pair, _)| matters[pair.one] && matters[pair.other]) {
            debug_assert!(pair.one > pair.other, "each pair once");
            for (most, slope) in steepest.iter_mut().zip(&range.slopes) {
                if slope > most {
                    *most = slope.clone();
                }
            }
        }
    }
    let widths = steepest.iter().enumerate().map(|(axis, slope)| {
        let narrowest = bumps.iter().map(|bump| &bump.inverse[(axis, axis)]).max()?;
        let limit = ratio(2, 1) / root_above(narrowest);
        Some(if (slope * &limit) > ratio(3, 2) { ratio(3, 2) / slope } else { limit })
    });
    widths.collect()
}

/// Above log(4k) + 2: beside the real axis, the quotient of two densities grows by e² at most.
fn threshold(count: usize) -> Rational {
    // ln 2 < 0.7
    Rational::from(BigInt::from(usize::BITS - (4 * count).leading_zeros())) * ratio(7, 10) + ratio(2, 1)
}

/// The cells of a box, by the offsets of their centres from its centre.
struct Cells;

impl Cells {
    fn of(bounds: &Bounds) -> (Vec<Vec<Rational>>, Vec<Rational>) {
        let count = if bounds.len() == 1 { 128 } else { 24 };
        let halves: Vec<Rational> = bounds.iter().map(|(first, last)| (last - first) * ratio(1, 2 * count)).collect();
        let along = |half: &Rational| (0..count).map(|i| half * ratio(2 * i + 1 - count, 1)).collect::<Vec<_>>();
        let cells = halves.iter().map(along).fold(vec![Vec::new()], |cells, offsets| {
            let longer = |cell: &Vec<Rational>| {
                let cell = cell.clone();
                offsets
                    .iter()
                    .map(move |offset| cell.iter().cloned().chain([offset.clone()]).collect())
                    .collect::<Vec<_>>()
            };
            cells.iter().flat_map(longer).collect()
        });
        (cells, halves)
    }
}

/// What r and its derivatives are in a cell.
struct Range {
    least: Rational,
    most: Rational,
    /// Bounds of their sizes.
    slopes: Vec<Rational>,
}

/// r = level + slopeᵀy − ½ yᵀKy around the centre of the box, for two components.
struct Quotient {
    one: usize,
    other: usize,
    level: Interval,
    slope: Vec<Interval>,
    bend: Matrix<Interval>,
    /// Bounds of the sizes of the entries of K times half a cell, summed by rows.
    spread: Vec<Interval>,
    halves: Vec<Interval>,
}

impl Quotient {
    fn new(bumps: &[Bump], one: usize, other: usize, middle: &Matrix<Rational>, halves: &[Rational]) -> Option<Self> {
        let (a, b) = (bumps.get(one)?, bumps.get(other)?);
        let (from_a, from_b) = (middle - &a.mean, middle - &b.mean);
        let form = |bump: &Bump, away: &Matrix<Rational>| away.transpose().congruence(&bump.inverse)[(0, 0)].clone();
        let level = (form(b, &from_b) - form(a, &from_a)) * ratio(1, 2);
        let weights = &a.weight / &b.weight;
        let twice = logarithm(&(&weights * &weights * &b.determinant / &a.determinant));
        let slope = &b.inverse * from_b - &a.inverse * from_a;
        let bend = &a.inverse - &b.inverse;
        let coarse = |x: &Rational| Interval::of(x, COARSE);
        let spread = (0..halves.len()).map(|row| {
            halves.iter().enumerate().fold(ratio(0, 1), |sum, (column, half)| sum + bend[(row, column)].abs() * half)
        });
        Some(Self {
            one,
            other,
            level: coarse(&level).plus(&twice.times(&coarse(&ratio(1, 2)), COARSE), COARSE),
            slope: slope.entries().iter().map(coarse).collect(),
            spread: spread.map(|sum| coarse(&sum)).collect(),
            bend: bend.map(coarse),
            halves: halves.iter().map(coarse).collect(),
        })
    }

    /// By the values at the centre of the cell and bounds of the derivatives.
    fn over(&self, cell: &[Rational]) -> Option<Range> {
        let offset: Vec<Interval> = cell.iter().map(|x| Interval::of(x, COARSE)).collect();
        let half = Interval::of(&ratio(1, 2), COARSE);
        let (mut value, mut around) = (self.level.clone(), Interval::zero());
        let mut slopes = Vec::new();
        for (row, y) in offset.iter().enumerate() {
            let curved = offset.iter().enumerate().fold(Interval::zero(), |sum, (column, other)| {
                sum.plus(&self.bend[(row, column)].times(other, COARSE), COARSE)
            });
            let mean = self.slope[row].minus(&curved.times(&half, COARSE), COARSE);
            value = value.plus(&mean.times(y, COARSE), COARSE);
            let slope = size(&self.slope[row].minus(&curved, COARSE))?;
            let spread = self.spread[row].upper().value()?;
            let reach = self.halves[row].upper().value()?;
            let bound = (&slope + &spread * ratio(1, 2)) * reach;
            around = around.plus(&Interval::of(&bound, COARSE), COARSE);
            slopes.push(slope + spread);
        }
        let around = around.upper().value()?;
        Some(Range { least: value.lower().value()? - &around, most: value.upper().value()? + around, slopes })
    }
}

/// The largest size of a member.
fn size(x: &Interval) -> Option<Rational> {
    Some(x.lower().value()?.abs().max(x.upper().value()?.abs()))
}

/// The natural logarithm of a positive fraction, roughly.
fn logarithm(value: &Rational) -> Interval {
    let bits = |n: &BigInt| i64::try_from(n.bits()).unwrap_or(i64::MAX / 4);
    let power = bits(value.numer()) - bits(value.denom());
    // 2^(power − 1) < value < 2^(power + 1)
    let of = |x: Rational| Interval::of(&x, COARSE);
    let exponent = of(ratio(power - 1, 1)).joined(&of(ratio(power + 1, 1)));
    exponent.times(&of(ratio(693, 1000)).joined(&of(ratio(694, 1000))), COARSE)
}
