//! How numbers are printed: as fractions, or as correctly rounded decimals.

use num_bigint::BigInt;
use num_traits::Signed;

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

    /// A text for a bound from above: where it is rounded, it stands for no less.
    pub(super) fn above(self, value: &Rational) -> String {
        self.text(&self.moved(value, |rounded| rounded >= value, 1))
    }

    /// A text for a bound from below.
    pub(super) fn below(self, value: &Rational) -> String {
        self.text(&self.moved(value, |rounded| rounded <= value, -1))
    }

    /// The value, or one farther away that rounds to the next decimal.
    fn moved(self, value: &Rational, is_good: impl Fn(&Rational) -> bool, direction: i64) -> Rational {
        let is_good = |candidate: &Rational| is_good(&Decimal::rounded(candidate, self.digits).value());
        let mut moved = value.clone();
        // A unit of the last digit is between one and ten times this.
        let mut distance = value.abs() / Rational::from(BigInt::from(10).pow(self.digits));
        while !self.exact && !is_good(&moved) {
            moved = value + &distance * Rational::from(BigInt::from(direction));
            distance = &distance + &distance;
        }
        moved
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::ratio;

    /// A rounded bound still bounds, and is near.
    #[test]
    fn bounds_are_rounded_outward() {
        for digits in [1, 2, 3, 17] {
            let numbers = Numbers { digits, exact: false };
            for value in
                [ratio(43, 7), ratio(-43, 7), ratio(1, 3), ratio(2, 3), ratio(-999, 1000), ratio(5, 1), ratio(0, 1)]
            {
                let read = |text: String| crate::protocol::Numbers::Exact.read_finite(&text).expect("a decimal");
                let (above, below) = (read(numbers.above(&value)), read(numbers.below(&value)));
                assert!(below <= value && value <= above, "{below} {value} {above}");
                let near = (above - below) * Rational::from(BigInt::from(10).pow(digits - 1));
                assert!(near <= value.abs(), "{digits} digits of {value}");
            }
        }
        assert_eq!(Numbers { digits: 3, exact: true }.above(&ratio(43, 7)), "43/7");
        assert_eq!(Numbers { digits: 3, exact: false }.below(&ratio(43, 7)), "6.14");
        assert_eq!(Numbers { digits: 3, exact: false }.above(&ratio(1, 4)), "0.25");
    }
}
