//! Averages under weights that are no fractions.
//!
//! An average of rational values with weights `w d^(−½) exp(q)`, all w, d, q rational, is a fraction or irrational, and
//! which of the two is decided exactly: by the theorem of Lindemann and Weierstrass a sum of algebraic multiples of
//! exponentials of different rational numbers vanishes only term by term, and square roots of fractions are linearly
//! independent over the rationals unless the product of two is a square.

use num_bigint::BigInt;

use super::Evidence;
use crate::scalar::{Dyadic, Interval, Overflow, Rational, Scalar, Toward, Undefined};

/// A number: a fraction, or irrational and enclosed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Enclosed {
    /// The number itself.
    Exact(Rational),
    /// It is irrational and lies between the ends.
    Between(Interval),
}

/// An enclosure did not become as narrow as asked for: the number is too close to zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the number is too close to zero to be enclosed to {bits} bits with {most} bits of work")]
pub struct TooWide {
    /// The bits asked for.
    pub bits: u64,
    /// The bits of work that were not enough.
    pub most: u64,
}

/// No number is worked on with more bits.
pub(super) const MOST_BITS: u64 = 1 << 18;

/// A value and what its weight is made of.
pub(super) type Weighted = (Evidence<Rational>, Rational);

/// The average, with a relative width of at most 2^−bits where it is irrational.
pub(super) fn average(values: &[Weighted], bits: u64) -> Result<Enclosed, TooWide> {
    if let Some(value) = rational_average(values) {
        return Ok(Enclosed::Exact(value));
    }
    let mut work = bits.saturating_add(32);
    while work <= MOST_BITS {
        if let Ok(found) = enclosed(values, work)
            && is_narrow(&found, bits)
        {
            return Ok(Enclosed::Between(found));
        }
        work *= 2;
    }
    Err(TooWide { bits, most: MOST_BITS })
}

/// The average if it is a fraction; nothing if it is irrational.
///
/// Σ cᵢ(vᵢ − ρ) = 0 with cᵢ = wᵢ dᵢ^(−½) exp(qᵢ) holds for a fraction ρ iff it holds over each class of terms whose qᵢ are
/// equal and whose dᵢ differ by squares.
fn rational_average(values: &[Weighted]) -> Option<Rational> {
    let mut classes: Vec<Class<'_>> = Vec::new();
    for (evidence, value) in values {
        match classes.iter_mut().find_map(|class| Some((class.share(evidence)?, class))) {
            Some((share, class)) => {
                class.sum = class.sum.plus(&share.times(value));
                class.weight = class.weight.plus(&share);
            }
            None => classes.push(Class {
                first: evidence,
                weight: evidence.weight.clone(),
                sum: evidence.weight.times(value),
            }),
        }
    }
    let mut means = classes.iter().map(|class| class.sum.over(&class.weight).ok());
    let first = means.next()??;
    means.all(|mean| mean.as_ref() == Some(&first)).then_some(first)
}

/// Terms whose weights are rational multiples of each other.
struct Class<'a> {
    first: &'a Evidence<Rational>,
    /// Σ of the multiples.
    weight: Rational,
    /// Σ of the multiples times the values.
    sum: Rational,
}

impl Class<'_> {
    /// The multiple for a weight, if it belongs to this class.
    fn share(&self, evidence: &Evidence<Rational>) -> Option<Rational> {
        if self.first.exponent != evidence.exponent {
            return None;
        }
        let root = square_root(&self.first.determinant.over(&evidence.determinant).ok()?)?;
        Some(root.times(&evidence.weight))
    }
}

/// The square root of a positive fraction, if it is a fraction.
fn square_root(value: &Rational) -> Option<Rational> {
    let root = |n: &BigInt| {
        let root = n.sqrt();
        (&root * &root == *n).then_some(root)
    };
    Some(Rational::new_raw(root(value.numer())?, root(value.denom())?))
}

/// The sizes of all evidence over that of the largest exponent, with so many bits of work.
pub(super) fn relative_sizes<'a>(
    all: impl Iterator<Item = &'a Evidence<Rational>> + Clone,
    work: u64,
) -> Result<Vec<Interval>, Undefined> {
    let most = all.clone().map(|evidence| &evidence.exponent).max().ok_or(Undefined::DivisionByZero)?;
    let size = |evidence: &Evidence<Rational>| {
        // No exponent is positive once the largest is taken away.
        let size =
            Interval::exponential(&evidence.exponent.minus(most), work).map_err(|Overflow| Undefined::Undecided)?;
        let root = Interval::square_root(&evidence.determinant, work)?;
        size.times(&Interval::of(&evidence.weight, work), work).over(&root, work)
    };
    all.map(size).collect()
}

/// The average with so many bits of work.
fn enclosed(values: &[Weighted], work: u64) -> Result<Interval, Undefined> {
    let (mut numerator, mut denominator) = (Interval::zero(), Interval::zero());
    let sizes = relative_sizes(values.iter().map(|(evidence, _)| evidence), work)?;
    for (size, (_, value)) in sizes.iter().zip(values) {
        numerator = numerator.plus(&size.times(&Interval::of(value, work), work), work);
        denominator = denominator.plus(size, work);
    }
    numerator.over(&denominator, work)
}

/// Whether upper − lower ≤ 2^−bits · |x| for all x of the interval.
fn is_narrow(found: &Interval, bits: u64) -> bool {
    let (lower, upper) = (found.lower(), found.upper());
    if lower.is_negative() != upper.is_negative() || lower.is_zero() || upper.is_zero() {
        return false;
    }
    let least = if lower.is_negative() { upper.negated() } else { lower.clone() };
    let width = upper.plus(&lower.negated(), 64, Toward::Above);
    let part = Dyadic::new(BigInt::from(1), -i64::try_from(bits).unwrap_or(i64::MAX));
    width <= least.times(&part, 64, Toward::Below)
}
