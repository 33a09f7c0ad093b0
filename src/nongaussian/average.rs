//! Averages under weights that are no fractions.
//!
//! An average of rational values with weights `w d^(−½) exp(q)`, all w, d, q rational, is a fraction or irrational, and
//! which of the two is decided exactly (`classes.rs`, `pairs.rs`). An irrational one can be enclosed (`enclosure.rs`).

use std::fmt;

use super::pairs::Central;
use crate::scalar::{Interval, Rational};

/// A number: a fraction, or irrational and enclosed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Enclosed {
    /// The number itself.
    Exact(Rational),
    /// It is irrational and lies between the ends.
    Between(Interval),
}

/// What of a posterior a number is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The probability of a component.
    Weight(usize),
    /// An entry of the best estimate.
    Mean(usize),
    /// An entry of the difference between the best and the best affine estimate.
    Difference(usize),
    /// An entry of the covariance.
    Covariance(usize, usize),
    /// The value of the characteristic function.
    Characteristic,
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Weight(component) => write!(f, "the probability of component {component}"),
            Self::Mean(row) => write!(f, "entry {row} of the best estimate"),
            Self::Difference(row) => write!(f, "entry {row} of the difference"),
            Self::Covariance(row, column) => write!(f, "entry ({row}, {column}) of the covariance"),
            Self::Characteristic => write!(f, "the characteristic function"),
        }
    }
}

/// An enclosure did not become as narrow as asked for: terms cancel, or exponents are beyond ±2⁶².
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{quantity} is not enclosed to {bits} bits with {most} bits of work")]
pub struct TooWide {
    /// What was asked for.
    pub quantity: Quantity,
    /// The bits asked for.
    pub bits: u64,
    /// The bits of work that were not enough.
    pub most: u64,
    /// Between these ends it lies; nothing where it is not known even so.
    pub known: Option<Interval>,
}

/// A number that is an average: a fraction, or irrational and to be had from [`Averages`](super::Averages) to any number of bits.
#[derive(Clone, Debug)]
pub struct Average {
    /// Which one it is.
    pub quantity: Quantity,
    pub(super) exact: Option<Rational>,
    pub(super) form: Form,
}

/// What is averaged over classes.
#[derive(Clone, Debug)]
pub(super) enum Form {
    /// A value for each.
    Values(Vec<Rational>),
    /// A value for one, and 0 for all others.
    Indicator(usize, Rational),
    /// An entry of the covariance.
    Central(Central),
}
