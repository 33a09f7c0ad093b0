//! What is too much for the judge, so that no case takes much more than a minute.
//!
//! Three things make work long: exact numbers so long that one step takes long, many steps with long numbers, and many steps at
//! all. Each has one limit; the first two matter where only exact numbers decide, since enclosures follow them elsewhere. All
//! were chosen by measurement, on two cores; on one, all takes up to twice as long.

use num_integer::Roots;

use crate::model::Path;
use crate::scalar::Rational;

/// The length in bits that exact denominators may reach, for one state and one sensor. It is the time and the memory of
/// single steps that this bounds.
///
/// More states and sensors make each step longer, so they must do with shorter numbers: this is divided by the root of
/// their number, which is relative to the two of a scalar state with one sensor.
const MAXIMAL_BITS: u64 = 1 << 19;

/// The most work on long numbers, taken as steps times the square of states plus sensors times the power 3/2 of the length
/// that denominators may reach.
///
/// Numbers lengthen step by step, and measured times follow this law between 640 and 2000 steps of a scalar state. At this
/// work the exact answer takes, with full doubles, 14 s for a scalar state (1530 steps) and twice as long where the
/// transition departs; 5 s for n = 4, m = 2 (330 steps) and 4 s for n = 8, m = 4 (120 steps), where it is computed modulo
/// primes.
const MAXIMAL_WORK: u64 = 1 << 40;

/// The most operations on entries, taken as steps times the third power of states plus sensors and some more, that are begun at
/// all.
///
/// It is the perturbed problems that this bounds: with full doubles the truth and twenty of them take some 60 µs for each
/// operation on one core: a minute at this limit, which is some 26,000 steps of a scalar state, 4000 of n = 4, m = 2, and 600 of
/// n = 8, m = 4.
const MAXIMAL_OPERATIONS: u64 = 1 << 20;

/// What a step costs whatever its size, in operations.
const OPERATIONS_OF_A_STEP: u64 = 32;

/// The length in bits that exact denominators may reach along a path.
pub(super) fn maximal_bits(path: &Path<Rational>) -> u64 {
    let dimensions = dimensions(path).max(1);
    let of_a_step = (2 * MAXIMAL_BITS * MAXIMAL_BITS / dimensions).isqrt();
    let entries = dimensions.saturating_mul(dimensions);
    let share = MAXIMAL_WORK / steps(path).saturating_mul(entries).max(1);
    // At most 2²⁷.
    let of_the_path = u64::try_from((u128::from(share) * u128::from(share)).cbrt()).unwrap_or(u64::MAX);
    of_a_step.min(of_the_path)
}

/// Whether there are more operations to do than are begun.
pub(super) fn is_too_much(path: &Path<Rational>) -> bool {
    let of_a_step = dimensions(path).saturating_pow(3).saturating_add(OPERATIONS_OF_A_STEP);
    of_a_step.saturating_mul(steps(path)) > MAXIMAL_OPERATIONS
}

fn steps(path: &Path<Rational>) -> u64 {
    u64::try_from(path.steps().len()).unwrap_or(u64::MAX)
}

/// States and sensors.
fn dimensions(path: &Path<Rational>) -> u64 {
    u64::try_from(path.states() + path.sensors()).unwrap_or(u64::MAX)
}
