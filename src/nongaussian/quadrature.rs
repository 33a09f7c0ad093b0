//! Rigorous integrals over a line or a plane: `∫ ‖Σ pᵢ(x) aᵢ(x)‖² / Σ pᵢ(x) dx` for weighted Gaussian densities pᵢ and affine aᵢ.
//!
//! The midpoint rule is used, because its error for functions that are analytic beside the real axis is exponentially small.
//! On [A, B] with cells of length h, residues at the nodes give for each axis
//!
//! `|∫ f dx − h Σ f(xₖ)| ≤ 2 F/(exp(2πα/h) − 1) + (h/π)(F_A + F_B)`,
//!
//! where F bounds `∫ |f(x ± iα)| dx` over [A, B], and F_A and F_B bound |f| at `A + iy` and `B + iy` for |y| ≤ α. Here
//! `|Σ pᵢ| ≥ ¾/k Σ |pᵢ|` (see [`half_widths`]), so that |f| ≤ 4k/3 Σ |pᵢ| ‖aᵢ‖² by Cauchy and Schwarz, and
//! `|pᵢ(x + iy)| = pᵢ(x) exp(y²κ/2)`, κ being a diagonal entry of the inverse covariance. In a plane one axis is summed after the
//! other.
//!
//! Of what lies outside the boxes, |f| ≤ Σ pᵢ‖aᵢ‖² is enough: for X ~ N(m, S) and L ≥ m₁,
//! `E[‖a(X)‖² 1(X₁ > L)] ≤ E[‖a(X)‖² exp((L − m₁)(X₁ − L)/S₁₁)] = exp(−(L − m₁)²/(2S₁₁)) E‖a(X + Se₁(L − m₁)/S₁₁)‖²`.

use num_bigint::BigInt;

use super::lattice::{Axis, sum};
use super::strip::{self, half_widths};
use crate::matrix::Matrix;
use crate::scalar::{Dyadic, Interval, Rational, Toward, nearest_double, ratio};

/// A weighted Gaussian density with an affine vector.
pub(super) struct Bump {
    pub(super) weight: Rational,
    /// d×1.
    pub(super) mean: Matrix<Rational>,
    /// d×d, regular.
    pub(super) covariance: Matrix<Rational>,
    /// The inverse of the covariance.
    pub(super) inverse: Matrix<Rational>,
    /// Of the covariance.
    pub(super) determinant: Rational,
    /// The vector is `slope x + offset`; n×d and n×1.
    pub(super) slope: Matrix<Rational>,
    pub(super) offset: Matrix<Rational>,
}

/// An interval on each axis.
pub(super) type Bounds = Vec<(Rational, Rational)>;

/// The most work for an integral, in evaluations of a component at a point in 64 bits.
pub(super) const MOST_WORK: u32 = 1 << 23;

/// Bits of bounds that need not be sharp.
pub(super) const COARSE: u64 = 64;

/// Where the integrand is evaluated so that the error is about 2^−effort.
pub(super) struct Plan {
    effort: u64,
    boxes: Vec<(Vec<Axis>, Vec<Rational>)>,
}

impl Plan {
    /// Nothing where the components are too different in scale, or where half of the work that is left does not find the strips; the work
    /// for them is taken away.
    pub(super) fn new(bumps: &[Bump], effort: u64, left: &mut f64) -> Option<Self> {
        let boxes = disjoint(bumps.iter().map(|bump| support(bump, effort)).collect());
        let count = nearest_double(&Rational::from(BigInt::from(boxes.len())));
        let cuts = strip::cuts(boxes.first()?.len(), bumps.len(), *left / 2.0 / count)?;
        *left -= strip::work(bumps.len(), cuts) * count;
        let planned = |bounds: Bounds| {
            let widths = half_widths(bumps, &bounds, cuts)?;
            let axes = bounds.iter().zip(&widths).map(|(ends, width)| axis(ends, width, effort));
            Some((axes.collect::<Option<_>>()?, widths))
        };
        Some(Self { effort, boxes: boxes.into_iter().map(planned).collect::<Option<_>>()? })
    }

    /// About how much work it is: a component is evaluated at the points within its ellipse, and with a row or a box there is more to do. It
    /// bounds the work, and proves nothing.
    pub(super) fn work(&self, bumps: &[Bump]) -> f64 {
        let double = |x: &Rational| nearest_double(x);
        let whole = |count: usize| double(&Rational::from(BigInt::from(count)));
        let bits = double(&Rational::from(BigInt::from(self.effort + 64)));
        let of_box = |(axes, _): &(Vec<Axis>, Vec<Rational>)| {
            let cell: f64 = axes.iter().map(|axis| double(&axis.step)).product();
            let all: f64 = axes.iter().map(|axis| whole(axis.count)).product();
            let ellipse = |bump: &Bump| match axes.len() {
                1 => 2.0 * (1.4 * bits * double(&bump.determinant)).sqrt() / cell,
                _ => std::f64::consts::PI * 1.4 * bits * double(&bump.determinant).sqrt() / cell,
            };
            let rows = if axes.len() == 1 { 0.0 } else { whole(axes[0].count) };
            let points: f64 = bumps.iter().map(|bump| all.min(ellipse(bump))).sum();
            points + whole(bumps.len()) * (20.0 * rows + 32.0)
        };
        self.boxes.iter().map(of_box).sum::<f64>() * bits / 64.0
    }

    /// The integral; nothing where a bound overflows.
    pub(super) fn integral(&self, bumps: &[Bump]) -> Option<Interval> {
        let work = self.effort.saturating_add(64);
        let (mut total, mut error) = (Interval::zero(), Interval::zero());
        for (axes, widths) in &self.boxes {
            let sizes = bumps.iter().flat_map(|bump| {
                axes.iter().zip(widths).enumerate().map(|(place, (_, width))| largest(bump, axes, place, width))
            });
            let size = Dyadic::rounded(&sizes.max()?, COARSE, Toward::Above).magnitude().unwrap_or_default();
            // Rounded towards more.
            let scale = size.div_euclid(2) + size.rem_euclid(2);
            total = total.plus(&sum(bumps, axes, scale, self.effort)?, work);
            error = error.plus(&remainder(bumps, axes, widths)?, COARSE);
        }
        let either = error.joined(&error.negated());
        // The integrand is nowhere negative: the tails only add.
        let whole = total.plus(&either, work).plus(&Interval::zero().joined(&self.tails(bumps)?), work);
        let lower = if whole.lower().is_negative() { Dyadic::zero() } else { whole.lower().clone() };
        Some(Interval::between(lower, whole.upper().clone()))
    }

    /// A bound of Σ ∫ pᵢ‖aᵢ‖² outside the support of each.
    fn tails(&self, bumps: &[Bump]) -> Option<Interval> {
        let mut total = Interval::zero();
        for bump in bumps {
            for (axis, (first, last)) in support(bump, self.effort).iter().enumerate() {
                for end in [first, last] {
                    let variance = &bump.covariance[(axis, axis)];
                    let away = end - &bump.mean[(axis, 0)];
                    let size = Interval::exponential(&(-(&away * &away) / (variance * ratio(2, 1))), COARSE).ok()?;
                    let shift = bump.covariance.select_columns(&[axis]).scaled(&(&away / variance));
                    let value = &bump.slope * (&bump.mean + shift) + &bump.offset;
                    let square = value.transpose().congruence(&Matrix::identity(value.rows()))[(0, 0)].clone()
                        + bump.slope.congruence(&bump.covariance).trace();
                    total = total.plus(&size.times(&Interval::of(&(square * &bump.weight), COARSE), COARSE), COARSE);
                }
            }
        }
        Some(total)
    }
}

/// Outside of it the density has tails of less than about 2^−effort: √(2 ln 2 effort) deviations on each axis.
fn support(bump: &Bump, effort: u64) -> Bounds {
    let along = |axis: usize| {
        let square = &bump.covariance[(axis, axis)] * ratio(i64::try_from(effort).unwrap_or(i64::MAX / 4) * 7, 5);
        let reach = root_above(&square);
        let unit = power_of_two(reach.numer().bits(), reach.denom().bits());
        let mean = &bump.mean[(axis, 0)];
        // Short fractions, so that the nodes are short.
        (((mean - &reach) / &unit).floor() * &unit, ((mean + &reach) / &unit).ceil() * &unit)
    };
    (0..bump.mean.rows()).map(along).collect()
}

/// 2^(one − other − 6), about a sixty-fourth of a fraction of these lengths.
fn power_of_two(one: u64, other: u64) -> Rational {
    let power = |bits: u64| BigInt::from(1) << bits;
    Rational::new(power(one), power(other + 6))
}

/// Boxes that cover these and do not overlap.
fn disjoint(mut boxes: Vec<Bounds>) -> Vec<Bounds> {
    let overlap = |one: &Bounds, other: &Bounds| one.iter().zip(other).all(|(a, b)| a.0 < b.1 && b.0 < a.1);
    let join = |one: &Bounds, other: &Bounds| {
        let least = |a: &Rational, b: &Rational| a.min(b).clone();
        let most = |a: &Rational, b: &Rational| a.max(b).clone();
        one.iter().zip(other).map(|(a, b)| (least(&a.0, &b.0), most(&a.1, &b.1))).collect()
    };
    let mut done: Vec<Bounds> = Vec::new();
    while let Some(next) = boxes.pop() {
        match done.iter().position(|other| overlap(&next, other)) {
            // The larger box may meet others.
            Some(place) => boxes.push(join(&next, &done.swap_remove(place))),
            None => done.push(next),
        }
    }
    done
}

/// So many cells that exp(2πα/h) is about 2^effort: ln 2/(2π) < 0.1104.
fn axis((first, last): &(Rational, Rational), width: &Rational, effort: u64) -> Option<Axis> {
    let length = last - first;
    let cells = &length * ratio(i64::try_from(effort).ok()?, 1) * ratio(1104, 10_000) / width;
    let count = usize::try_from(cells.ceil().to_integer()).ok()?.max(1);
    Some(Axis { first: first.clone(), step: length / Rational::from(BigInt::from(count)), count })
}

/// A bound of the error of the sum over a box.
fn remainder(bumps: &[Bump], axes: &[Axis], widths: &[Rational]) -> Option<Interval> {
    let count = i64::try_from(bumps.len()).ok()?;
    let coarse = |value: &Rational| Interval::of(value, COARSE);
    let mut total = Interval::zero();
    for bump in bumps {
        let mut rows = Interval::of(&ratio(1, 1), COARSE);
        for (place, (axis, width)) in axes.iter().zip(widths).enumerate() {
            // 2π > 6.28318, and 2/(1 − e) ≤ 4 for e ≤ ½, of which there is plenty.
            let decay = Interval::exponential(&(-(width / &axis.step) * ratio(628_318, 100_000)), COARSE).ok()?;
            let along = if *decay.upper() <= Dyadic::new(BigInt::from(1), -1) { ratio(4, 1) } else { return None };
            let mut parts = decay.times(&coarse(&along), COARSE);
            let variance = &bump.covariance[(place, place)];
            for end in [axis.first.clone(), axis.last()] {
                let away = end - &bump.mean[(place, 0)];
                let size = Interval::exponential(&(-(&away * &away) / (variance * ratio(2, 1))), COARSE).ok()?;
                // 1/√(2π) < 0.4 and 1/π < 0.32
                let height = root_above(&variance.recip()) * &axis.step * ratio(128, 1000);
                parts = parts.plus(&size.times(&coarse(&height), COARSE), COARSE);
            }
            // |p| grows by exp(y²κ/2) ≤ e² < 8.
            let most = largest(bump, axes, place, width) * &bump.weight * ratio(32 * count, 3);
            total = total.plus(&parts.times(&rows, COARSE).times(&coarse(&most), COARSE), COARSE);
            // h Σ g(xₖ) ≤ ∫ g + h max g for a density with one peak, here that of a coordinate given the other.
            let peak = root_above(&bump.inverse[(place, place)]) * &axis.step * ratio(4, 10);
            rows = rows.times(&coarse(&(peak + ratio(1, 1))), COARSE);
        }
    }
    Some(total)
}

/// A bound of ‖a‖² in a box, and so far beside it along an axis.
fn largest(bump: &Bump, axes: &[Axis], place: usize, width: &Rational) -> Rational {
    let middle = Matrix::column(axes.iter().map(|axis| (&axis.first + axis.last()) * ratio(1, 2)).collect());
    let value = &bump.slope * middle + &bump.offset;
    let of_row = |row: usize| {
        let size = |x: &Rational| if *x < ratio(0, 1) { -x } else { x.clone() };
        let reach = |(column, axis): (usize, &Axis)| {
            size(&bump.slope[(row, column)]) * (axis.last() - &axis.first) * ratio(1, 2)
        };
        let real = axes.iter().enumerate().map(reach).fold(size(&value[(row, 0)]), |sum, part| sum + part);
        let imaginary = &bump.slope[(row, place)] * width;
        &real * &real + &imaginary * &imaginary
    };
    (0..value.rows()).map(of_row).fold(ratio(0, 1), |sum, part| sum + part)
}

/// A fraction a little above the root of a positive one.
pub(super) fn root_above(value: &Rational) -> Rational {
    let root = Interval::square_root(value, 16).ok().and_then(|root| root.upper().shortened(16, Toward::Above).value());
    root.unwrap_or_else(|| value + ratio(1, 1))
}
