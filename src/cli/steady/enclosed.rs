//! The named matrices of a steady state, and numbers that are enclosed as decimals with a bound of their error.

use num_traits::{Signed, Zero};

use super::Page;
use crate::certify::SteadyState;
use crate::cli::numbers::Numbers;
use crate::matrix::Matrix;
use crate::model::Timing;
use crate::protocol::Decimal;
use crate::scalar::{Interval, Rational, ratio};

/// A decimal, and how far the number may be from it; nothing if it is the number correctly rounded.
pub(super) struct Shown {
    pub(super) value: String,
    pub(super) within: Option<String>,
}

impl Shown {
    pub(super) fn text(&self) -> String {
        self.within.as_ref().map_or_else(|| self.value.clone(), |within| format!("{}±{within}", self.value))
    }
}

/// An enclosed number in so many digits.
pub(super) fn shown(interval: &Interval, digits: u32) -> Shown {
    let ends = [interval.lower(), interval.upper()].map(|end| end.value().unwrap_or_default());
    let [lower, upper] = &ends;
    let round = |value: &Rational| Decimal::rounded(value, digits);
    let decimals = [round(lower), round(upper)];
    if decimals[0] == decimals[1] && (lower == upper || !lower.is_zero() && !upper.is_zero()) {
        return Shown { value: decimals[0].to_string(), within: None };
    }
    let middle = (lower + upper) / ratio(2, 1);
    // Digits beyond the bound say nothing.
    let straddles = lower.is_negative() != upper.is_negative() || lower.is_zero() || upper.is_zero();
    let value = if straddles { Decimal::rounded(&Rational::zero(), 1) } else { round(&middle) };
    let far = ends.iter().map(|end| (end - value.value()).abs()).max().unwrap_or_default();
    let within = Numbers { digits: 2, exact: false }.above(&far);
    Shown { value: value.to_string(), within: Some(within) }
}

/// The matrices by the names that those who use them know.
pub(super) fn named<'a>(page: &Page<'_>, state: &'a SteadyState) -> Vec<(&'static str, Matrix<&'a Interval>)> {
    let plain = |matrix: &'a Matrix<Interval>| Matrix::from_fn(matrix.rows(), matrix.columns(), |i, j| &matrix[(i, j)]);
    let SteadyState {
        solution, gain, innovation_covariance, filtered_covariance, filter_gain, open_covariance, ..
    } = state;
    match page.model.equation.timing() {
        Some(Timing::Departing) => vec![
            ("predicted covariance", plain(solution)),
            ("predictor gain", plain(gain)),
            ("innovation covariance", plain(innovation_covariance)),
            ("filtered covariance", plain(filtered_covariance)),
            ("filter gain", plain(filter_gain)),
        ],
        Some(Timing::Arriving) => vec![
            ("predicted covariance", plain(open_covariance)),
            ("innovation covariance", plain(innovation_covariance)),
            ("filtered covariance", plain(solution)),
            ("filter gain", plain(gain)),
        ],
        None => vec![
            ("solution X", plain(solution)),
            ("feedback F", plain(gain).transpose()),
            ("R + BᵀXB", plain(innovation_covariance)),
        ],
    }
}

/// The square root of r², rounded up to so many digits.
pub(super) fn rate(state: &SteadyState, digits: u32) -> String {
    let square = state.rate_squared.value().unwrap_or_else(|| ratio(1, 1));
    let bits = u64::from(digits) * 4 + 16;
    let root = Interval::square_root(&square, bits).ok().and_then(|root| root.upper().value());
    let root = root.unwrap_or_else(|| ratio(1, 1));
    // Enough digits that it is not one.
    let text = Numbers { digits, exact: false }.above(&root);
    if text == "1" && digits < 4096 { rate(state, 2 * digits) } else { text }
}
