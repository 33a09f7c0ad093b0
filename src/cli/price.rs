//! The price of linearity as `estimate` prints it.

use super::estimate::written;
use crate::nongaussian::{Enclosed, InitialLaw, Statistics};
use crate::protocol::Decimal;
use crate::scalar::{Dyadic, Rational};

/// The bits of the width of the price.
const PRICE_BITS: u64 = 36;

/// The price to so many decimals as are proved, at most ten.
pub(super) fn price(now: &Statistics<Rational>, law: &InitialLaw<Rational>) -> String {
    let interval = match now.price_of_linearity(law, PRICE_BITS) {
        Ok(Enclosed::Exact(value)) => return value.to_string(),
        Ok(Enclosed::Between(interval)) => interval,
        Err(error) => return format!("unknown ({error})"),
    };
    let end = |end: &Dyadic| if end.is_zero() { Some(Rational::default()) } else { written(end) };
    let (Some(lower), Some(upper)) = (end(interval.lower()), end(interval.upper())) else {
        // It is never negative.
        return format!("<2^{}", interval.upper().magnitude().unwrap_or_default());
    };
    let rounded = |digits| [&lower, &upper].map(|end| Decimal::rounded(end, digits));
    let proved = (1..=10).rev().map(rounded).find(|[lower, upper]| lower == upper);
    proved.map_or_else(|| format!("from {lower} to {upper}"), |[digits, _]| digits.to_string())
}
