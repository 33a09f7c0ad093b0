//! Rounding each entry to a unit of its own.

use num_bigint::BigInt;
use num_traits::One as _;

use super::{Packed, Part};
use crate::certify::grid::nearest;
use crate::certify::words::{Integer, add_shifted, length, negate, put_nearest};
use crate::matrix::Matrix;

impl Packed {
    /// Each entry over an odd integer, rounded to the nearest multiple of its own unit, which is not below the common one; where the
    /// matrix is symmetric, and its units are, the triangle decides. `seen` is told which entry was exact.
    pub(in crate::certify) fn to_units(
        &self,
        odd: &BigInt,
        (least, unit): (i64, impl Fn(usize, usize) -> i64),
        is_symmetric: bool,
        mut seen: impl FnMut(usize, usize, bool),
    ) -> Self {
        let part = if is_symmetric { Part::Triangle } else { Part::All };
        let entries = || {
            let columns = move |i| if is_symmetric { i + 1 } else { self.columns };
            (0..self.rows).flat_map(move |i| (0..columns(i)).map(move |j| (i, j)))
        };
        if !odd.is_one() {
            let mut mantissas = Matrix::<BigInt>::zeros(self.rows, self.columns);
            for (i, j) in entries() {
                let unit = unit(i, j);
                let (whole, is_exact) = nearest(&self.mantissa(i, j), self.exponent - unit, odd);
                seen(i, j, is_exact);
                let lifted = whole << (unit - least);
                if is_symmetric {
                    mantissas[(j, i)].clone_from(&lifted);
                }
                mantissas[(i, j)] = lifted;
            }
            return Self::of(&mantissas, least);
        }
        let mut bits = 0;
        for (i, j) in entries() {
            let own = i64::try_from(self.integer(i, j).bits()).unwrap_or(i64::MAX);
            let unit = unit(i, j);
            // Rounded, then lifted.
            let rounded = if own == 0 { 0 } else { (own + self.exponent - unit).max(0) + 1 + unit - least };
            bits = bits.max(rounded.unsigned_abs());
        }
        let mut quotient = Vec::new();
        Self::built((self.rows, self.columns), length(bits + 1), least, part, |sum, i, j| {
            let (integer, unit) = (self.integer(i, j), unit(i, j));
            if integer.words.is_empty() {
                return seen(i, j, true);
            }
            let lift = (unit - least).unsigned_abs();
            if self.exponent >= unit {
                add_shifted(sum, integer, (self.exponent - least).unsigned_abs());
                return seen(i, j, true);
            }
            let dropped = (unit - self.exponent).unsigned_abs();
            if lift == 0 {
                return seen(i, j, put_nearest(sum, integer, dropped));
            }
            quotient.clear();
            quotient.resize(integer.words.len() + 1, 0);
            seen(i, j, put_nearest(&mut quotient, integer, dropped));
            let is_negative = quotient.last().is_some_and(|last| last >> 63 == 1);
            if is_negative {
                negate(&mut quotient);
            }
            add_shifted(sum, Integer::new(&quotient, is_negative), lift);
        })
    }
}
