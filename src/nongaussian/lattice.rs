//! Sums of the integrand over the nodes of a lattice, in fixed point with every error counted.
//!
//! f(p) = ‖Σ pᵢaᵢ‖²/Σ pᵢ with ‖aᵢ‖ ≤ α has |∂f/∂pᵢ| ≤ 3α² and |∂f/∂aᵢ| ≤ 2αpᵢ, wherever p ≥ 0: so errors of p and a are no worse where all
//! densities are small, and nodes where all are below one unit add nothing.

use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::line::{Ground, Line};
use super::quadrature::Bump;
use crate::scalar::{Dyadic, Interval, Rational};

/// Cells of one length; the nodes are their midpoints.
pub(super) struct Axis {
    pub(super) first: Rational,
    pub(super) step: Rational,
    pub(super) count: usize,
}

impl Axis {
    /// Where the last cell ends.
    pub(super) fn last(&self) -> Rational {
        &self.first + &self.step * Rational::from(BigInt::from(self.count))
    }

    pub(super) fn node(&self, place: usize) -> Rational {
        &self.first + &self.step * Rational::new(BigInt::from(2 * place + 1), BigInt::from(2))
    }

    /// The node next to x.
    pub(super) fn nearest(&self, x: &Rational) -> usize {
        let cell = ((x - &self.first) / &self.step).floor().to_integer();
        if cell.is_negative() { 0 } else { cell.to_usize().unwrap_or(usize::MAX).min(self.count - 1) }
    }
}

/// The sum of the integrand over all nodes, times the size of a cell, to about 2^−effort; ‖aᵢ‖² ≤ 4^scale at every node.
///
/// Nothing where a mass exceeds 1 in a cell.
pub(super) fn sum(bumps: &[Bump], axes: &[Axis], scale: i64, effort: u64) -> Option<Interval> {
    let (last, before) = axes.split_last()?;
    let nodes = axes.iter().fold(BigInt::one(), |product, axis| product * axis.count);
    let lost = nodes.bits() + 2 * BigInt::from(last.count).bits() + BigInt::from(bumps.len()).bits() + 12;
    let places = effort.saturating_add_signed(2 * scale).max(16) + lost;
    let factors: Vec<Interval> = bumps.iter().map(|bump| mass(bump, axes, places + 8)).collect::<Option<_>>()?;
    let (mut total, mut error) = (BigInt::zero(), BigInt::zero());
    for row in 0..before.first().map_or(1, |axis| axis.count) {
        let before: Vec<Rational> = before.iter().map(|axis| axis.node(row)).collect();
        let ground = Ground { axis: last, before: &before, scale, places };
        let lines = bumps.iter().zip(&factors).map(|(bump, mass)| Line::new(bump, mass, &ground));
        let lines: Vec<Line> = lines.collect::<Option<_>>()?;
        let (of_row, off) = along(&lines, last.count, places);
        total += of_row;
        error += off;
    }
    let exponent = 2 * scale - i64::try_from(places).ok()?;
    Some(Interval::between(Dyadic::new(&total - &error, exponent), Dyadic::new(total + error, exponent)))
}

/// The mass of a cell at the peak: the weight times the size of the cell over √((2π)^d det S).
fn mass(bump: &Bump, axes: &[Axis], work: u64) -> Option<Interval> {
    let cell = axes.iter().fold(bump.weight.clone(), |product, axis| product * &axis.step);
    let root = Interval::square_root(&bump.determinant, work).ok()?;
    let mut mass = Interval::of(&cell, work).over(&root, work).ok()?;
    let pi = Interval::pi(work);
    let two_pi = pi.plus(&pi, work);
    let end = |end: &Dyadic| Interval::square_root(&end.value()?, work).ok();
    let root = end(two_pi.lower())?.joined(&end(two_pi.upper())?);
    for _ in axes {
        mass = mass.over(&root, work).ok()?;
    }
    (*mass.upper() <= Dyadic::one()).then_some(mass)
}

/// The sum over a row and how far it may be off, in units of the last place.
fn along(lines: &[Line], count: usize, places: u64) -> (BigInt, BigInt) {
    let mut total = BigInt::zero();
    let rows = lines.first().map_or(0, |line| line.values.len());
    let (first, end) = lines
        .iter()
        .filter(|line| !line.masses.is_empty())
        .fold((count, 0), |(first, end), line| (first.min(line.first), end.max(line.first + line.masses.len())));
    let mut sums = vec![BigInt::zero(); rows];
    for place in first..end {
        let mut whole = BigInt::zero();
        for sum in &mut sums {
            sum.set_zero();
        }
        for line in lines {
            let Some(mass) = place.checked_sub(line.first).and_then(|place| line.masses.get(place)) else { continue };
            whole += mass;
            for (sum, (value, step)) in sums.iter_mut().zip(&line.values) {
                *sum += mass * (value + step * place);
            }
        }
        if !whole.is_zero() {
            let squares: BigInt = sums
                .iter()
                .map(|sum| {
                    let short = sum >> places;
                    &short * &short
                })
                .sum();
            total += squares / whole;
        }
    }
    let (rows, parts) = (BigInt::from(rows), BigInt::from(lines.len()));
    let of_masses: BigInt = lines.iter().map(|line| &line.error).sum();
    // α² ≤ 1 in these units, each coordinate of a is off by count + 1 at most, Σ p ≤ k, and (N + 1)²/D ≤ N²/D + 4 in each coordinate.
    let each = of_masses * 3_u8 + &rows * (parts * (count + 1) * 3_u8 + 4_u8) + 1_u8;
    (total, each * count)
}
