//! Bounds from above.

use num_bigint::BigInt;
use num_traits::One as _;

use super::grid::BOUND_BITS;
use crate::scalar::{Dyadic, Rational, Toward};

/// Arithmetic whose results are never too small, with so many bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Upper {
    pub(super) bits: u64,
}

/// Bounds that are single numbers of a step.
pub(super) const BOUND: Upper = Upper { bits: BOUND_BITS };

impl Upper {
    pub(super) fn of(self, value: &Rational) -> Dyadic {
        Dyadic::rounded(value, self.bits, Toward::Above)
    }

    pub(super) fn product(self, a: &Dyadic, b: &Dyadic) -> Dyadic {
        a.times(b, self.bits, Toward::Above)
    }

    pub(super) fn sum(self, a: &Dyadic, b: &Dyadic) -> Dyadic {
        a.plus(b, self.bits, Toward::Above)
    }

    /// `a / divisor^power` for a positive integer.
    pub(super) fn over(self, a: &Dyadic, divisor: &BigInt, power: u32) -> Dyadic {
        if divisor.is_one() {
            return a.clone();
        }
        a.over(&Dyadic::new(divisor.pow(power), 0), self.bits, Toward::Above).unwrap_or_else(Dyadic::zero)
    }
}
