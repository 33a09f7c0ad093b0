//! What is too much for the judge, so that no case takes more than about a minute.
//!
//! Two things make exact work long: long numbers and many of them. Each has one limit.

use crate::model::Path;
use crate::scalar::Rational;

/// The length in bits that exact denominators may reach, for one state and one sensor: some eight hundred steps of full
/// doubles. It is the time of the last steps that this bounds, and with it memory.
const MAXIMAL_BITS: u64 = 1 << 17;

/// The most operations on entries, taken as steps times the third power of states plus sensors, that are begun at all. It is
/// the time of runs with numbers that stay short that this bounds.
const MAXIMAL_OPERATIONS: u64 = 1 << 18;

/// The length in bits that exact denominators may reach along a path.
///
/// More states and sensors make each step longer, so they must do with shorter numbers: [`MAXIMAL_BITS`] is divided by
/// the root of their number, which is relative to the two of a scalar state with one sensor.
pub(super) fn maximal_bits(path: &Path<Rational>) -> u64 {
    (2 * MAXIMAL_BITS * MAXIMAL_BITS / dimensions(path).max(1)).isqrt()
}

/// Whether there are more operations to do than are begun.
pub(super) fn is_too_much(path: &Path<Rational>) -> bool {
    let steps = u64::try_from(path.steps().len()).unwrap_or(u64::MAX);
    dimensions(path).saturating_pow(3).saturating_mul(steps) > MAXIMAL_OPERATIONS
}

/// States and sensors.
fn dimensions(path: &Path<Rational>) -> u64 {
    u64::try_from(path.states() + path.sensors()).unwrap_or(u64::MAX)
}
