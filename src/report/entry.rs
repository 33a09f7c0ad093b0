//! How numbers are shown.

use crate::protocol::{Decimal, shortest_double};
use crate::scalar::{Rational, exact_value, nearest_double};

/// An answered number: a double by the fewest digits that name it, anything else to seventeen.
pub(super) fn answered(value: &Rational) -> String {
    let double = nearest_double(value);
    if exact_value(double).as_ref() == Some(value) { shortest_double(double) } else { exact(value) }
}

/// An exact number, to more digits than a double has.
pub(super) fn exact(value: &Rational) -> String {
    Decimal::rounded(value, 17).to_string()
}
