//! The price of linearity as `estimate` prints it.

use super::numbers::Numbers;
use super::proved::written;
use crate::nongaussian::{Enclosed, InitialLaw, PriceError, Statistics};
use crate::protocol::Decimal;
use crate::reproduce::simulated_price;
use crate::scalar::{Dyadic, Interval, Rational};

/// No more digits of it are computed.
const MOST_DIGITS: u32 = 50;

/// Whether it is wanted, and how it is simulated where it is not proved.
#[derive(clap::Args, Clone, Copy, Debug)]
pub(super) struct Price {
    /// Also what the affine estimate loses on average, to at most 50 digits (slower). Proved where the readings see one or two
    /// directions of the first state; simulated, and labelled so, where they see more.
    #[arg(id = "price", long)]
    wanted: bool,
    /// So many draws where it is simulated.
    #[arg(long = "price-draws", requires = "price", default_value_t = 100_000, value_parser = clap::value_parser!(u32).range(2..=100_000_000))]
    draws: u32,
    /// The seed of these draws.
    #[arg(long, requires = "price", default_value_t = 1)]
    seed: u64,
}

impl Price {
    /// The price, if wanted: the proved digits, or between which numbers it is proved to be, or that it is only simulated.
    pub(super) fn text(
        self,
        now: &Statistics<Rational>,
        law: &InitialLaw<Rational>,
        numbers: Numbers,
    ) -> Option<String> {
        self.wanted.then(|| {
            let digits = numbers.digits.min(MOST_DIGITS);
            // Two more bits than needed for one unit of the last digit; again, if rounding has to be decided.
            let bits = [4, 8].map(|per_digit| u64::from(digits) * per_digit + 6);
            let mut found = now.price_of_linearity(law, bits[0]);
            if matches!(&found, Ok(Enclosed::Between(interval)) if Decimal::of_interval(interval, digits).is_none()) {
                found = now.price_of_linearity(law, bits[1]);
            }
            let mark = if numbers.exact { "…" } else { "" };
            match found {
                Ok(Enclosed::Exact(value)) => numbers.text(&value),
                Ok(Enclosed::Between(interval)) | Err(PriceError::TooWide { found: interval, .. }) => {
                    Decimal::of_interval(&interval, digits)
                        .map_or_else(|| ends(&interval, digits), |digits| format!("{digits}{mark}"))
                }
                Err(error @ PriceError::Dimension { .. }) => {
                    let simulated = simulated_price(now, law, self.draws, self.seed);
                    let simulated = simulated.map_or_else(|why| why.to_string(), |found| found.to_string());
                    format!("unsupported ({error}); {simulated}")
                }
            }
        })
    }
}

/// Between which numbers it is, rounded outwards: with three digits more than are proved.
fn ends(interval: &Interval, digits: u32) -> String {
    let end = |end: &Dyadic| if end.is_zero() { Some(Rational::default()) } else { written(end) };
    let (Some(lower), Some(upper)) = (end(interval.lower()), end(interval.upper())) else {
        // It is never negative.
        return format!("<2^{}", interval.upper().magnitude().unwrap_or_default());
    };
    let known = (1..digits).rev().find(|&digits| Decimal::of_interval(interval, digits).is_some()).unwrap_or(0);
    let numbers = Numbers { digits: known + 3, exact: false };
    format!("from {} to {}", numbers.below(&lower), numbers.above(&upper))
}
