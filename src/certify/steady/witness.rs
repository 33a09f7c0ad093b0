//! What proves a steady state, as the document that a checker reads.

use super::proof::Proof;
use crate::certify::certificate::{full, triangle};
use crate::verify::{DyadicNumber, Hexadecimal, Stabilising};

impl Proof {
    pub(super) fn evidence(&self, kept: Option<&[usize]>) -> Stabilising {
        let (mantissa, exponent) = self.rate_squared.parts();
        Stabilising {
            solution: triangle(&self.reading.point),
            gap: triangle(&self.gap),
            gain: full(&self.image.gain),
            whitening: full(&self.reading.whitening),
            shape: triangle(&self.shape),
            rate_squared: DyadicNumber { exponent, mantissa: Hexadecimal(mantissa.clone()) },
            balance: self.balance,
            kept: kept.map(<[usize]>::to_vec),
        }
    }
}
