//! How numbers are printed: as fractions, or as correctly rounded decimals.

use crate::matrix::Matrix;
use crate::protocol::Decimal;
use crate::scalar::Rational;

/// The choice.
#[derive(clap::Args, Clone, Copy, Debug)]
pub(super) struct Numbers {
    /// Significant decimal digits, correctly rounded (halves away from zero).
    #[arg(long, default_value_t = 17, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub(super) digits: u32,
    /// Print fractions instead of decimals.
    #[arg(long, conflicts_with = "digits")]
    pub(super) exact: bool,
}

impl Numbers {
    pub(super) fn text(self, value: &Rational) -> String {
        if self.exact { value.to_string() } else { Decimal::rounded(value, self.digits).to_string() }
    }
}

/// A number, a column as `[a, b]`, or a matrix as `[[a, b], [c, d]]`.
pub(super) fn laid_out(texts: &Matrix<String>) -> String {
    match (texts.rows(), texts.columns()) {
        (1, 1) => texts[(0, 0)].clone(),
        (_, 1) => format!("[{}]", texts.entries().join(", ")),
        _ => texts.to_string(),
    }
}
