//! Intervals with dyadic ends: what is proved about a number that is no fraction.

use num_bigint::BigInt;
use num_traits::{One, Signed};

use super::dyadic::{Dyadic, Toward};
use super::{Rational, Undefined};

/// All numbers between two dyadic ones; every operation encloses all results, rounded outward to the bits it is given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interval {
    lower: Dyadic,
    upper: Dyadic,
}

impl Interval {
    /// The numbers between two, given in any order.
    pub fn between(one: Dyadic, other: Dyadic) -> Self {
        if one <= other { Self { lower: one, upper: other } } else { Self { lower: other, upper: one } }
    }

    /// Zero alone.
    pub fn zero() -> Self {
        Self { lower: Dyadic::zero(), upper: Dyadic::zero() }
    }

    /// A fraction, enclosed to so many bits.
    pub fn of(value: &Rational, bits: u64) -> Self {
        Self { lower: Dyadic::rounded(value, bits, Toward::Below), upper: Dyadic::rounded(value, bits, Toward::Above) }
    }

    /// The lower end.
    pub fn lower(&self) -> &Dyadic {
        &self.lower
    }

    /// The upper end.
    pub fn upper(&self) -> &Dyadic {
        &self.upper
    }

    /// The sum.
    pub fn plus(&self, other: &Self, bits: u64) -> Self {
        Self {
            lower: self.lower.plus(&other.lower, bits, Toward::Below),
            upper: self.upper.plus(&other.upper, bits, Toward::Above),
        }
    }

    /// The numbers with the other sign.
    pub fn negated(&self) -> Self {
        Self { lower: self.upper.negated(), upper: self.lower.negated() }
    }

    /// The difference.
    pub fn minus(&self, other: &Self, bits: u64) -> Self {
        self.plus(&other.negated(), bits)
    }

    /// The least interval with the numbers of both.
    pub fn joined(&self, other: &Self) -> Self {
        let lower = if self.lower <= other.lower { &self.lower } else { &other.lower };
        let upper = if self.upper >= other.upper { &self.upper } else { &other.upper };
        Self { lower: lower.clone(), upper: upper.clone() }
    }

    /// The product.
    pub fn times(&self, other: &Self, bits: u64) -> Self {
        if !self.lower.is_negative() && !other.lower.is_negative() {
            return Self {
                lower: self.lower.times(&other.lower, bits, Toward::Below),
                upper: self.upper.times(&other.upper, bits, Toward::Above),
            };
        }
        self.hull(other, |a, b, toward| Some(a.times(b, bits, toward)))
            .unwrap_or_else(|| unreachable!("products have values"))
    }

    /// The quotient.
    ///
    /// # Errors
    ///
    /// [`Undefined`] if the divisor is zero, or may be.
    pub fn over(&self, divisor: &Self, bits: u64) -> Result<Self, Undefined> {
        let zero = Dyadic::zero();
        if divisor.lower == zero && divisor.upper == zero {
            return Err(Undefined::DivisionByZero);
        }
        if divisor.lower <= zero && zero <= divisor.upper {
            return Err(Undefined::Undecided);
        }
        self.hull(divisor, |a, b, toward| a.over(b, bits, toward)).ok_or(Undefined::DivisionByZero)
    }

    /// The square root of a positive fraction.
    ///
    /// # Errors
    ///
    /// [`Undefined::OutsideTheRing`] for a negative one.
    pub fn square_root(value: &Rational, bits: u64) -> Result<Self, Undefined> {
        if value.is_negative() {
            return Err(Undefined::OutsideTheRing);
        }
        // value · 4^half has at least 2·bits bits, so its root has the bits that are wanted.
        let missing = (2 * bits + 2 + value.denom().bits()).saturating_sub(value.numer().bits());
        let half = missing.div_ceil(2);
        let whole: BigInt = (value.numer() << (2 * half)) / value.denom();
        let root = whole.sqrt();
        let is_exact = &root * &root * value.denom() == value.numer() << (2 * half);
        let next = if is_exact { root.clone() } else { &root + BigInt::one() };
        let exponent = -i64::try_from(half).unwrap_or(i64::MAX);
        Ok(Self { lower: Dyadic::new(root, exponent), upper: Dyadic::new(next, exponent) })
    }

    /// The least interval with the results at all four pairs of ends.
    fn hull(&self, other: &Self, of: impl Fn(&Dyadic, &Dyadic, Toward) -> Option<Dyadic>) -> Option<Self> {
        let pairs = [
            (&self.lower, &other.lower),
            (&self.lower, &other.upper),
            (&self.upper, &other.lower),
            (&self.upper, &other.upper),
        ];
        let ends = |toward| pairs.iter().map(|(a, b)| of(a, b, toward)).collect::<Option<Vec<_>>>();
        let (lower, upper) = (ends(Toward::Below)?.into_iter().min()?, ends(Toward::Above)?.into_iter().max()?);
        Some(Self { lower, upper })
    }
}
