//! A rigorous integral along a line: `∫ ‖Σ pᵢ(x) aᵢ(x)‖² / Σ pᵢ(x) dx` for weighted Gaussian densities pᵢ and affine aᵢ.
//!
//! On a cell of half width h around c, a Taylor polynomial of even order N is integrated with its coefficients at c; the
//! remainder is `f_N(ξ)(x − c)^N` with f_N enclosed over the whole cell. Where little is, Cauchy's and Schwarz's
//! inequality `‖Σ pᵢaᵢ‖²/Σ pᵢ ≤ Σ pᵢ‖aᵢ‖²` is enough, and so it is for the tails: for X ~ N(m, s²), L ≥ m and affine a(x),
//! `E[a²(X) 1(X > L)] ≤ E[a²(X) exp((L − m)(X − L)/s²)] = exp(−(L − m)²/(2s²)) (a²(L) + a′²s²)`.

use num_bigint::BigInt;

use super::PriceError;
use crate::scalar::{Dyadic, Interval, Rational, Taylor, Toward, ratio};

/// A component along the line: x ~ N(mean, variance) with this weight, and for each row (offset, slope) of a.
pub(super) struct Along {
    pub(super) weight: Rational,
    pub(super) mean: Rational,
    pub(super) variance: Rational,
    pub(super) differences: Vec<(Rational, Rational)>,
}

/// The most cells that are looked at.
const MOST_CELLS: usize = 1 << 14;

/// No narrower enclosure is tried.
const MOST_BITS: u64 = 1 << 10;

/// The integral, with a width of at most 2^−bits.
pub(super) fn integral(parts: &[Along], bits: u64) -> Result<Interval, PriceError> {
    let failed = PriceError::TooWide { bits, cells: MOST_CELLS };
    if bits > MOST_BITS {
        return Err(failed);
    }
    let integrand = Integrand::new(parts, bits).ok_or(failed)?;
    let (first, last) = support(parts, bits);
    let tails = integrand.tails(&first, Side::Below).plus(&integrand.tails(&last, Side::Above), integrand.work);
    // What a cell may contribute to the width: half of everything, in proportion to its length.
    let density = power_of_two(bits.saturating_add(1)) / (&last - &first);
    let mut pending = vec![(first, last)];
    let (mut sum, mut cells) = (Interval::zero(), 0);
    while let Some((from, to)) = pending.pop() {
        cells += 1;
        if cells > MOST_CELLS {
            return Err(failed);
        }
        let share = Interval::of(&(&density * (&to - &from)), 64);
        match integrand.cell(&from, &to) {
            Some(found) if width(&found) <= *share.lower() => sum = sum.plus(&found, integrand.work),
            _ => {
                let middle = (&from + &to) * ratio(1, 2);
                pending.push((middle.clone(), to));
                pending.push((from, middle));
            }
        }
    }
    // The integrand is nowhere negative: the tails only add.
    let whole = sum.plus(&Interval::zero().joined(&tails), integrand.work);
    let two_pi = Interval::pi(integrand.work);
    let two_pi = two_pi.plus(&two_pi, integrand.work);
    let found = root(&two_pi, integrand.work).and_then(|root| whole.over(&root, integrand.work).ok()).ok_or(failed)?;
    let found =
        if found.lower().is_negative() { Interval::between(Dyadic::zero(), found.upper().clone()) } else { found };
    let most = Interval::of(&power_of_two(bits), 64);
    if width(&found) <= *most.lower() { Ok(found) } else { Err(failed) }
}

/// Which end of the line.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Below,
    Above,
}

/// An interval outside which every density has tails of less than about 2^−bits: √(2 ln 2 (bits + 40)) deviations away.
fn support(parts: &[Along], bits: u64) -> (Rational, Rational) {
    let reach = |part: &Along| {
        let square = &part.variance * ratio(i64::try_from(bits).unwrap_or(i64::MAX / 4).saturating_add(40) * 2, 1);
        // A fraction above the root.
        Rational::from(square.ceil().to_integer().sqrt() + BigInt::from(1))
    };
    let first = parts.iter().map(|part| &part.mean - reach(part)).min().unwrap_or_default();
    let last = parts.iter().map(|part| &part.mean + reach(part)).max().unwrap_or_default();
    (first, last)
}

struct Integrand<'a> {
    parts: &'a [Along],
    /// weight / s, by component.
    factors: Vec<Interval>,
    order: usize,
    work: u64,
}

impl<'a> Integrand<'a> {
    fn new(parts: &'a [Along], bits: u64) -> Option<Self> {
        let work = bits.saturating_add(40);
        let factor = |part: &Along| {
            Interval::of(&part.weight, work).over(&Interval::square_root(&part.variance, work).ok()?, work).ok()
        };
        let factors = parts.iter().map(factor).collect::<Option<_>>()?;
        // Even, and about what pays off.
        let order = 2 * usize::try_from(bits.min(4000) / 8 + 3).ok()?;
        Some(Self { parts, factors, order, work })
    }

    /// √(2π) times a bound of Σ ∫ pᵢ‖aᵢ‖² beyond an end of the line.
    fn tails(&self, end: &Rational, side: Side) -> Interval {
        let nothing = Interval::zero();
        self.parts.iter().fold(nothing, |sum, part| {
            let away = if side == Side::Above { end - &part.mean } else { &part.mean - end };
            debug_assert!(away >= ratio(0, 1), "the ends lie beyond all means");
            let size = self.exponential(&(-(&away * &away) / (&part.variance * ratio(2, 1))));
            let square = part.differences.iter().fold(ratio(0, 1), |square, (offset, slope)| {
                let value = offset + slope * end;
                square + &value * &value + slope * slope * &part.variance
            });
            // √(2π) < 3
            let bound = size.times(&Interval::of(&(square * &part.weight * ratio(3, 1)), self.work), self.work);
            sum.plus(&bound, self.work)
        })
    }

    fn exponential(&self, x: &Rational) -> Interval {
        // No exponent here is positive.
        Interval::exponential(x, self.work).unwrap_or_else(|overflow| unreachable!("{overflow}"))
    }

    /// √(2π) times the integral over a cell; nothing where no enclosure was found.
    fn cell(&self, from: &Rational, to: &Rational) -> Option<Interval> {
        let middle = (from + to) * ratio(1, 2);
        let half = (to - from) * ratio(1, 2);
        let whole = Interval::of(from, self.work).joined(&Interval::of(to, self.work));
        let coarse = self.bound(&whole)?.times(&Interval::of(&(to - from), self.work), self.work);
        if coarse.upper().magnitude().is_none_or(|size| size < -i64::try_from(self.work).unwrap_or(i64::MAX)) {
            return Some(Interval::zero().joined(&coarse));
        }
        let (at_middle, over_cell) = (self.expansion(&Interval::of(&middle, self.work))?, self.expansion(&whole)?);
        let mut sum = Interval::zero();
        let mut power = half.clone();
        for j in (0..=self.order).step_by(2) {
            let coefficients = if j == self.order { &over_cell } else { &at_middle };
            // ∫ (x − c)^j = 2 h^(j+1)/(j+1)
            let moment = &power * Rational::new(BigInt::from(2), BigInt::from(j + 1));
            let term = coefficients.coefficients().get(j)?.times(&Interval::of(&moment, self.work), self.work);
            sum = sum.plus(&term, self.work);
            power = power * &half * &half;
        }
        Some(sum)
    }

    /// Σ pᵢ‖aᵢ‖² over a cell, from above, times √(2π).
    fn bound(&self, x: &Interval) -> Option<Interval> {
        let mut sum = Interval::zero();
        for (part, factor) in self.parts.iter().zip(&self.factors) {
            let density = self.density(part, factor, x, 0)?.coefficients().first()?.clone();
            for difference in &part.differences {
                let value = self.affine(difference, x);
                sum = sum.plus(&density.times(&value.times(&value, self.work), self.work), self.work);
            }
        }
        // A square is not negative, whatever the product of two intervals says.
        Some(Interval::zero().joined(&sum))
    }

    fn affine(&self, (offset, slope): &(Rational, Rational), x: &Interval) -> Interval {
        Interval::of(slope, self.work).times(x, self.work).plus(&Interval::of(offset, self.work), self.work)
    }

    /// pᵢ √(2π) around the points of x.
    fn density(&self, part: &Along, factor: &Interval, x: &Interval, order: usize) -> Option<Taylor> {
        let work = self.work;
        let away = x.minus(&Interval::of(&part.mean, work), work);
        let inverse = Interval::of(&part.variance.recip(), work);
        let half = Interval::of(&ratio(-1, 2), work);
        let curvature = half.times(&inverse, work);
        let slope = away.times(&inverse, work).negated();
        let exponent = square(&away, work).times(&curvature, work);
        let density = Taylor::new([exponent, slope, curvature], order, work).exponential().ok()?;
        Some(density.times(&Taylor::new([factor.clone()], order, work)))
    }

    /// The integrand times √(2π) around the points of x.
    fn expansion(&self, x: &Interval) -> Option<Taylor> {
        let work = self.work;
        let rows = self.parts.first()?.differences.len();
        let zero = || Taylor::new([], self.order, work);
        let (mut total, mut sums) = (zero(), vec![zero(); rows]);
        for (part, factor) in self.parts.iter().zip(&self.factors) {
            let density = self.density(part, factor, x, self.order)?;
            for (sum, difference) in sums.iter_mut().zip(&part.differences) {
                let affine = [self.affine(difference, x), Interval::of(&difference.1, work)];
                *sum = sum.plus(&density.times(&Taylor::new(affine, self.order, work)));
            }
            total = total.plus(&density);
        }
        let squares = sums.iter().fold(zero(), |all, sum| all.plus(&sum.times(sum)));
        squares.over(&total).ok()
    }
}

/// The squares of the members.
fn square(x: &Interval, work: u64) -> Interval {
    let product = x.times(x, work);
    let around = x.lower().is_negative() && !x.upper().is_negative();
    if around { Interval::zero().joined(&Interval::between(Dyadic::zero(), product.upper().clone())) } else { product }
}

/// The root of an interval of positive numbers.
fn root(x: &Interval, work: u64) -> Option<Interval> {
    let of = |end: Option<Rational>| Interval::square_root(&end?, work).ok();
    Some(of(x.lower().value())?.joined(&of(x.upper().value())?))
}

fn width(x: &Interval) -> Dyadic {
    x.upper().plus(&x.lower().negated(), 64, Toward::Above)
}

/// 2^−bits
fn power_of_two(bits: u64) -> Rational {
    Rational::new(BigInt::from(1), BigInt::from(1) << bits)
}
