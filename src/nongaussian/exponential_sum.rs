//! Sums of algebraic multiples of exponentials of fractions, in normal form.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::{Enclosed, Evidence};
use crate::scalar::{Dyadic, Interval, Rational, Toward};

/// The number `Σ cᵢ dᵢ^(−½) exp(qᵢ)`, all c, d, q rational, with terms that are linearly independent over the rationals.
///
/// By the theorem of Lindemann and Weierstrass exponentials of different fractions are independent over the algebraic numbers, and
/// square roots of fractions are over the rationals unless a quotient of two is a fraction. So the number is zero exactly if no
/// term is left, and a quotient of two is a fraction exactly if their terms are proportional.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExponentialSum {
    /// Their `weight` is c ≠ 0, of any sign.
    terms: Vec<Evidence<Rational>>,
}

/// A number was not enclosed as narrowly as asked for: its terms cancel, or its size has no exponent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("not enclosed to {bits} bits with {most} bits of work")]
pub struct Unresolved {
    /// The bits asked for.
    pub bits: u64,
    /// The bits of work that were not enough.
    pub most: u64,
}

/// No number is worked on with more bits.
const MOST_BITS: u64 = 1 << 18;

impl ExponentialSum {
    /// The sum of these multiples of evidence.
    pub fn new(terms: impl IntoIterator<Item = (Evidence<Rational>, Rational)>) -> Self {
        let mut merged: Vec<Evidence<Rational>> = Vec::new();
        for (evidence, multiple) in terms {
            let weight = evidence.weight * multiple;
            let alike = merged
                .iter_mut()
                .find_map(|term| Some((share(term, &evidence.determinant, &evidence.exponent)?, term)));
            match alike {
                Some((share, term)) => term.weight += share * weight,
                None => merged.push(Evidence { weight, ..evidence }),
            }
        }
        merged.retain(|term| !term.weight.is_zero());
        Self { terms: merged }
    }

    /// Its terms; `weight` is of any sign, but not zero.
    pub fn terms(&self) -> &[Evidence<Rational>] {
        &self.terms
    }

    /// The number: a fraction, which is decided, or irrational and with a relative width of at most 2^−bits.
    ///
    /// # Errors
    ///
    /// [`Unresolved`] if terms cancel too far, or an exponent is beyond 2⁶¹.
    pub fn value(&self, bits: u64) -> Result<Enclosed, Unresolved> {
        match &self.terms[..] {
            [] => return Ok(Enclosed::Exact(Rational::zero())),
            [term] if term.exponent.is_zero() => {
                if let Some(root) = square_root(&term.determinant) {
                    return Ok(Enclosed::Exact(&term.weight / root));
                }
            }
            _ => {}
        }
        narrowed(bits, |work| self.enclosed(&Rational::zero(), work)).map(Enclosed::Between)
    }

    /// The quotient by a sum that is not zero.
    pub(super) fn over(&self, divisor: &Self, bits: u64) -> Result<Enclosed, Unresolved> {
        if let Some(quotient) = self.proportion(divisor) {
            return Ok(Enclosed::Exact(quotient));
        }
        let base = divisor.largest();
        narrowed(bits, |work| self.enclosed(&base, work)?.over(&divisor.enclosed(&base, work)?, work).ok())
            .map(Enclosed::Between)
    }

    /// The factor between two sums whose terms are proportional.
    fn proportion(&self, divisor: &Self) -> Option<Rational> {
        if self.terms.is_empty() {
            return Some(Rational::zero());
        }
        let factor = |term: &Evidence<Rational>| {
            let of =
                |other: &Evidence<Rational>| Some(share(term, &other.determinant, &other.exponent)? * &other.weight);
            Some(&term.weight / divisor.terms.iter().find_map(of)?)
        };
        let first = factor(self.terms.first()?)?;
        let is_alike = self.terms.len() == divisor.terms.len();
        (is_alike && self.terms.iter().all(|term| factor(term).as_ref() == Some(&first))).then_some(first)
    }

    pub(super) fn largest(&self) -> Rational {
        self.terms.iter().map(|term| &term.exponent).max().cloned().unwrap_or_default()
    }

    /// Over exp(base).
    fn enclosed(&self, base: &Rational, work: u64) -> Option<Interval> {
        let sizes = self.terms.iter().map(|term| size(term, base, work));
        sizes.into_iter().try_fold(Interval::zero(), |sum, size| Some(sum.plus(&size?, work)))
    }
}

/// `c d^(−½) exp(q − base)`
pub(super) fn size(term: &Evidence<Rational>, base: &Rational, work: u64) -> Option<Interval> {
    let exponential = Interval::exponential(&(&term.exponent - base), work).ok()?;
    let root = Interval::square_root(&term.determinant, work).ok()?;
    exponential.times(&Interval::of(&term.weight, work), work).over(&root, work).ok()
}

/// An enclosure with a relative width of at most 2^−bits, by as much work as it takes.
pub(super) fn narrowed(bits: u64, of: impl Fn(u64) -> Option<Interval>) -> Result<Interval, Unresolved> {
    let mut work = bits.saturating_add(32);
    while work <= MOST_BITS {
        if let Some(found) = of(work).filter(|found| is_narrow(found, bits)) {
            return Ok(found);
        }
        work *= 2;
    }
    Err(Unresolved { bits, most: MOST_BITS })
}

/// Whether upper − lower ≤ 2^−bits · |x| for all x of the interval.
fn is_narrow(found: &Interval, bits: u64) -> bool {
    let (lower, upper) = (found.lower(), found.upper());
    if lower == upper {
        return true;
    }
    if lower.is_zero() || upper.is_zero() || lower.is_negative() != upper.is_negative() {
        return false;
    }
    let least = if lower.is_negative() { upper.negated() } else { lower.clone() };
    let part = Dyadic::new(BigInt::one(), -i64::try_from(bits).unwrap_or(i64::MAX));
    upper.plus(&lower.negated(), 64, Toward::Above) <= least.times(&part, 64, Toward::Below)
}

/// The root of `term.determinant / determinant`, if it is a fraction and the exponents are equal.
fn share(term: &Evidence<Rational>, determinant: &Rational, exponent: &Rational) -> Option<Rational> {
    (term.exponent == *exponent).then(|| square_root(&(&term.determinant / determinant)))?
}

/// The square root of a positive fraction, if it is a fraction.
fn square_root(value: &Rational) -> Option<Rational> {
    let root = |n: &BigInt| {
        let root = (!n.is_negative()).then(|| n.sqrt())?;
        (&root * &root == *n).then_some(root)
    };
    Some(Rational::new_raw(root(value.numer())?, root(value.denom())?))
}
