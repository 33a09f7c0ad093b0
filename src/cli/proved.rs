//! Digits that are proved, of numbers that are enclosed.

use std::cmp::Ordering;

use super::numbers::Numbers;
use crate::nongaussian::{Average, Averages, Enclosed, TooWide};
use crate::protocol::Decimal;
use crate::scalar::{Dyadic, Interval, Rational, ratio};

/// The number correctly rounded (a fraction as it is, if so wished), or a bound where it is too close to zero for any digits, or
/// why there is neither.
pub(super) fn proved(averages: &mut Averages<'_>, number: &Average, numbers: Numbers) -> Result<String, String> {
    let mark = if numbers.exact { "…" } else { "" };
    // Two decimals of so many digits are farther apart than the ends.
    let enough = u64::from(numbers.digits) * 4 + 16;
    for bits in [enough, 2 * enough, 4 * enough] {
        let interval = match averages.enclosed(number, bits) {
            Ok(Enclosed::Exact(value)) => return Ok(numbers.text(&value)),
            Ok(Enclosed::Between(interval)) => interval,
            Err(TooWide { known, most, .. }) => return told_by_size(known.as_ref(), most),
        };
        if let Some(decimal) = Decimal::of_interval(&interval, numbers.digits) {
            return Ok(format!("{decimal}{mark}"));
        }
        if let (Some(lower), Some(upper)) = (written(interval.lower()), written(interval.upper())) {
            // Between them lies one point where rounding changes. The number is irrational, and so not there.
            let [lower, upper] = [lower, upper].map(|end| Decimal::rounded(&end, numbers.digits));
            let tie = (lower.value() + upper.value()) * ratio(1, 2);
            return match averages.compared(number, &tie) {
                Ok(Ordering::Less) => Ok(format!("{lower}{mark}")),
                Ok(_) => Ok(format!("{upper}{mark}")),
                Err(_) => Err(format!("from {lower} to {upper}, too close to the middle of both to be rounded")),
            };
        }
        // A tie of this size is too long to be compared with; more bits it must be.
    }
    Err(format!("it is too close to a tie to be rounded with {} bits", 4 * enough))
}

/// A number that is not too small or too large to be written out.
pub(super) fn written(end: &Dyadic) -> Option<Rational> {
    const MOST: u64 = 1 << 16;
    end.magnitude().filter(|size| size.unsigned_abs() <= MOST).and(end.value())
}

/// What is known of a number that is not enclosed as wanted: if its sign is, a power of two that bounds it.
fn told_by_size(known: Option<&Interval>, most: u64) -> Result<String, String> {
    let Some(known) = known else { return Err(format!("nothing is known with {most} bits of work")) };
    let ends = [known.lower(), known.upper()].map(Dyadic::magnitude);
    match ends {
        // Whatever its digits are, it is closer to zero than the end that is farther away.
        [None, Some(size)] => Ok(format!("<2^{size}")),
        [Some(size), None] => Ok(format!(">-2^{size}")),
        [lower, upper] => {
            let size = lower.max(upper).unwrap_or_default();
            Err(format!("its absolute value is below 2^{size}; no more is known with {most} bits of work"))
        }
    }
}
