//! How far beside the real axis the integrand is analytic.
//!
//! At x + iy on one axis the phase of pᵢ/pⱼ is y times the derivative of r = log(pᵢ/pⱼ) at x, and r is quadratic. So let a box be
//! cut into cells. In each, leave out what is negligible: i is if `|pᵢ| ≤ |pⱼ|/(4k)` throughout for some j, k being the number of
//! components. If the phases of all others differ by at most 3/2 < π/2, then beside that of the largest density no
//! other takes anything away, and `|Σ pᵢ| ≥ ¾ max |pᵢ| ≥ ¾/k Σ |pᵢ|`.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::collections::binary_heap::PeekMut;

use num_bigint::BigInt;
use num_traits::Signed;

use super::quadrature::{Bounds, Bump, COARSE, root_above};
use crate::matrix::Matrix;
use crate::scalar::{Interval, Rational, nearest_double, ratio};

/// For each axis an α such that for |y| ≤ α, everywhere in the box, `|Σ pᵢ| ≥ ¾/k Σ |pᵢ|` at x + iy, and α²κ ≤ 4 for each κ: the wider, the more cuts.
pub(super) fn half_widths(bumps: &[Bump], bounds: &Bounds, cuts: u32) -> Option<Vec<Rational>> {
    let middle = Matrix::column(bounds.iter().map(|(first, last)| (first + last) * ratio(1, 2)).collect());
    let quotients = Quotients {
        pairs: (0..bumps.len())
            .flat_map(|i| (0..i).map(move |j| (i, j)))
            .map(|(i, j)| Quotient::new(bumps, i, j, &middle))
            .collect::<Option<_>>()?,
        count: bumps.len(),
        threshold: threshold(bumps.len()),
    };
    let limit =
        |axis: usize| Some(ratio(2, 1) / root_above(bumps.iter().map(|bump| &bump.inverse[(axis, axis)]).max()?));
    let limits: Vec<Rational> = (0..bounds.len()).map(limit).collect::<Option<_>>()?;
    let whole = Cell {
        centre: vec![ratio(0, 1); bounds.len()],
        halves: bounds.iter().map(|(first, last)| (last - first) * ratio(1, 2)).collect(),
    };
    // The steeper a cell, the sooner it is cut: only where components of one size meet do cells have to be small.
    let mut cells = BinaryHeap::from([quotients.steepness(whole, &limits)?]);
    for _ in 0..cuts {
        let Some(steepest) = cells.peek_mut().filter(|steepest| steepest.worst > ratio(3, 2)) else { break };
        for half in PeekMut::pop(steepest).cell.halved(&limits) {
            cells.push(quotients.steepness(half, &limits)?);
        }
    }
    let widths = limits.into_iter().enumerate().map(|(axis, limit)| {
        let slope = cells.iter().map(|cell| &cell.slopes[axis]).max()?;
        Some(if (slope * &limit) > ratio(3, 2) { ratio(3, 2) / slope } else { limit })
    });
    widths.collect()
}

/// How often a box is cut: a line 128 times, a plane four times as often, less often where so much work is not allowed; nothing where not even
/// one cut is.
pub(super) fn cuts(dimension: usize, components: usize, allowed: f64) -> Option<u32> {
    let most = if dimension == 1 { 128 } else { 512 };
    (1..=most).rev().find(|&cuts| work(components, cuts) <= allowed)
}

/// In evaluations of a component at a point: eight for each pair in each cell, of which a cut makes two, and as much as for four cells to begin.
pub(super) fn work(components: usize, cuts: u32) -> f64 {
    let count = nearest_double(&Rational::from(BigInt::from(components)));
    count * (count - 1.0) / 2.0 * 8.0 * f64::from(4 + 2 * cuts)
}

/// A part of the box, by the offset of its centre from that of the box.
struct Cell {
    centre: Vec<Rational>,
    halves: Vec<Rational>,
}

impl Cell {
    /// Cut across the axis on which it is longest.
    fn halved(&self, units: &[Rational]) -> [Self; 2] {
        let longest = (0..units.len()).max_by_key(|&axis| &self.halves[axis] / &units[axis]).unwrap_or_default();
        [-1, 1].map(|side| {
            let (mut centre, mut halves) = (self.centre.clone(), self.halves.clone());
            halves[longest] = &halves[longest] * ratio(1, 2);
            centre[longest] = &centre[longest] + &halves[longest] * ratio(side, 1);
            Self { centre, halves }
        })
    }
}

/// A cell with bounds of the slopes of r in it, for the components that matter there; cells are ordered by the worst of
/// these times the limits of the axes.
struct Steepness {
    cell: Cell,
    slopes: Vec<Rational>,
    worst: Rational,
}

impl PartialEq for Steepness {
    fn eq(&self, other: &Self) -> bool {
        self.worst == other.worst
    }
}

impl Eq for Steepness {}

impl PartialOrd for Steepness {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Steepness {
    fn cmp(&self, other: &Self) -> Ordering {
        self.worst.cmp(&other.worst)
    }
}

/// The quotients of all pairs of components.
struct Quotients {
    pairs: Vec<Quotient>,
    count: usize,
    threshold: Rational,
}

impl Quotients {
    fn steepness(&self, cell: Cell, limits: &[Rational]) -> Option<Steepness> {
        let found: Vec<Range> = self.pairs.iter().map(|pair| pair.over(&cell)).collect::<Option<_>>()?;
        let mut matters = vec![true; self.count];
        for (pair, range) in self.pairs.iter().zip(&found) {
            matters[pair.one] &= range.most > -&self.threshold;
            matters[pair.other] &= range.least < self.threshold;
        }
        let both = self.pairs.iter().zip(found).filter(|(pair, _)| matters[pair.one] && matters[pair.other]);
        let slopes = both.fold(vec![ratio(0, 1); limits.len()], |steepest, (_, range)| {
            steepest.into_iter().zip(range.slopes).map(|(one, other)| one.max(other)).collect()
        });
        let worst = slopes.iter().zip(limits).map(|(slope, limit)| slope * limit).max()?;
        Some(Steepness { cell, slopes, worst })
    }
}

/// Above log(4k) + 2: beside the real axis, the quotient of two densities grows by e² at most.
fn threshold(count: usize) -> Rational {
    // ln 2 < 0.7
    Rational::from(BigInt::from(usize::BITS - (4 * count).leading_zeros())) * ratio(7, 10) + ratio(2, 1)
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
}

impl Quotient {
    fn new(bumps: &[Bump], one: usize, other: usize, middle: &Matrix<Rational>) -> Option<Self> {
        let (a, b) = (bumps.get(one)?, bumps.get(other)?);
        let (from_a, from_b) = (middle - &a.mean, middle - &b.mean);
        let form = |bump: &Bump, away: &Matrix<Rational>| away.transpose().congruence(&bump.inverse)[(0, 0)].clone();
        let level = (form(b, &from_b) - form(a, &from_a)) * ratio(1, 2);
        let weights = &a.weight / &b.weight;
        let twice = logarithm(&(&weights * &weights * &b.determinant / &a.determinant));
        let slope = &b.inverse * from_b - &a.inverse * from_a;
        let bend = &a.inverse - &b.inverse;
        let coarse = |x: &Rational| Interval::of(x, COARSE);
        Some(Self {
            one,
            other,
            level: coarse(&level).plus(&twice.times(&coarse(&ratio(1, 2)), COARSE), COARSE),
            slope: slope.entries().iter().map(coarse).collect(),
            bend: bend.map(coarse),
        })
    }

    /// By the values at the centre of the cell and bounds of the derivatives.
    fn over(&self, cell: &Cell) -> Option<Range> {
        let offset: Vec<Interval> = cell.centre.iter().map(|x| Interval::of(x, COARSE)).collect();
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
            // By how much the derivative changes between the centre and the ends of the cell.
            let change = |(column, half): (usize, &Rational)| Some(size(&self.bend[(row, column)])? * half);
            let changes = cell.halves.iter().enumerate().map(change).collect::<Option<Vec<_>>>()?;
            let spread = changes.into_iter().fold(ratio(0, 1), |sum, change| sum + change);
            let reach = &cell.halves[row];
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
