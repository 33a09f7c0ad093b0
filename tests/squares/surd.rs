//! ℚ(√2): an ordered field that is not the rationals, with maps of its own.

use std::cmp::Ordering;

use exact_kalman::scalar::{Field, OrderedField, Rational, Scalar, Undefined, ZeroTest, laws, ratio};
use proptest::prelude::*;

use super::commuting::Drawn;

/// `rational + root · √2`
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Surd {
    pub rational: Rational,
    pub root: Rational,
}

impl Surd {
    pub fn new(rational: Rational, root: Rational) -> Self {
        Self { rational, root }
    }

    pub fn conjugated(&self) -> Self {
        Self::new(self.rational.clone(), -self.root.clone())
    }

    /// `rational² − 2 root²`, zero for zero only.
    fn norm(&self) -> Rational {
        &self.rational * &self.rational - ratio(2, 1) * &self.root * &self.root
    }

    fn sign(&self) -> Ordering {
        let zero = ratio(0, 1);
        let (a, b) = (self.rational.cmp(&zero), self.root.cmp(&zero));
        match (a, b) {
            (a, Ordering::Equal) => a,
            (Ordering::Equal, b) => b,
            (a, b) if a == b => a,
            // The signs differ: that of the larger square.
            (a, b) => {
                if self.norm() > zero {
                    a
                } else {
                    b
                }
            }
        }
    }
}

impl PartialOrd for Surd {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Surd {
    fn cmp(&self, other: &Self) -> Ordering {
        self.minus(other).sign()
    }
}

impl Scalar for Surd {
    fn zero() -> Self {
        Self::new(ratio(0, 1), ratio(0, 1))
    }

    fn one() -> Self {
        Self::new(ratio(1, 1), ratio(0, 1))
    }

    fn plus(&self, other: &Self) -> Self {
        Self::new(&self.rational + &other.rational, &self.root + &other.root)
    }

    fn minus(&self, other: &Self) -> Self {
        Self::new(&self.rational - &other.rational, &self.root - &other.root)
    }

    fn times(&self, other: &Self) -> Self {
        let (a, b, c, d) = (&self.rational, &self.root, &other.rational, &other.root);
        Self::new(a * c + ratio(2, 1) * b * d, a * d + b * c)
    }

    fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
        if divisor.is_zero() {
            return Err(Undefined::DivisionByZero);
        }
        let (product, norm) = (self.times(&divisor.conjugated()), divisor.norm());
        Ok(Self::new(product.rational / &norm, product.root / norm))
    }

    fn zero_test(&self) -> ZeroTest {
        if self.is_zero() { ZeroTest::Zero } else { ZeroTest::Nonzero }
    }
}

impl Field for Surd {}

impl Drawn for Surd {
    fn drawn(first: &Rational, second: &Rational) -> Self {
        Self::new(first.clone(), second.clone())
    }
}

impl OrderedField for Surd {}

fn surds() -> impl Strategy<Value = Surd> {
    let fraction = || (-9_i64..=9, 1_i64..=4).prop_map(|(a, b)| ratio(a, b));
    (fraction(), fraction()).prop_map(|(a, b)| Surd::new(a, b))
}

proptest! {
    #[test]
    fn fractions_and_a_root_are_an_ordered_field(a in surds(), b in surds(), c in surds()) {
        prop_assert_eq!(laws::ordered_field(&a, &b, &c), Ok(()));
    }
}
