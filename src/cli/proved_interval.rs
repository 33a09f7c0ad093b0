//! Numbers of which two bounds are known, to the digits that both share.

use num_traits::{Signed, Zero};

use crate::protocol::Decimal;
use crate::scalar::{Rational, ratio};

/// The decimal to which all numbers between two bounds are rounded, with as many digits as that allows and `most` at most; or, where
/// there is none, about what lies between them.
pub(super) fn text([lower, upper]: &[Rational; 2], most: u32) -> String {
    // Fewer digits are shared by more numbers, but for those beside a tie: so each count is tried.
    let shared = |digits: u32| {
        let decimal = Decimal::rounded(lower, digits);
        (decimal == Decimal::rounded(upper, digits)).then_some(decimal)
    };
    let width = upper - lower;
    if width.is_zero() {
        return Decimal::rounded(lower, most).to_string();
    }
    let begin = leading(&(lower.abs().max(upper.abs()) / &width)).min(most);
    if let Some(decimal) = (1..=begin).rev().find_map(shared) {
        return decimal.to_string();
    }
    let half = ratio(1, 2);
    format!("{}±{}", Decimal::rounded(&((lower + upper) * &half), 1), Decimal::rounded(&(width * ratio(11, 10)), 1))
}

/// One digit more than a number has before its point.
fn leading(number: &Rational) -> u32 {
    let bits = number.to_integer().bits();
    u32::try_from(bits * 30_103 / 100_000 + 2).unwrap_or(u32::MAX)
}

pub(super) fn shown(entries: &[String]) -> String {
    if let [entry] = entries { entry.clone() } else { format!("[{}]", entries.join(", ")) }
}

pub(super) fn shown_matrix(rows: &[Vec<String>]) -> String {
    if let [row] = rows
        && row.len() == 1
    {
        return row[0].clone();
    }
    let rows: Vec<String> = rows.iter().map(|row| format!("[{}]", row.join(", "))).collect();
    format!("[{}]", rows.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shared_digits_are_printed() {
        let of = |lower: (i64, i64), upper: (i64, i64), most| {
            text(&[ratio(lower.0, lower.1), ratio(upper.0, upper.1)], most)
        };
        assert_eq!(of((1, 3), (1, 3), 5), "0.33333");
        assert_eq!(of((33_331, 100_000), (33_334, 100_000), 17), "0.333");
        assert_eq!(of((-33_334, 100_000), (-33_331, 100_000), 2), "-0.33");
        assert_eq!(of((-1, 1000), (1, 1000), 17), "0±0.002");
        // Beside a tie: 0.1249… and 0.1250… are both 0.1, and neither 0.12 nor 0.13.
        assert_eq!(of((12_499, 100_000), (12_501, 100_000), 17), "0.125");
        assert_eq!(of((14_999, 100_000), (15_001, 100_000), 17), "0.15");
    }
}
