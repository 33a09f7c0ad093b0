//! How long exact numbers may become.

use std::str::FromStr;

/// The memory that the numbers of one step may take, in bits: a quarter of a gibibyte.
///
/// A step works on m observed entries, the state and the next state, so on (m + 2n)² numbers of one length. Besides there
/// are products, and up to three steps that wait to be printed: by measurement the program takes three (n = 4) to seven
/// times (n = 1) as much, so less than two gibibytes, which most machines have to spare. Time runs out long before, and
/// has no limit of its own: steps are printed as they come, and Ctrl-C loses none.
const MEMORY: u64 = 1 << 31;

/// The length in bits that denominators may reach.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum MaximalBits {
    /// As much as the memory above has room for.
    #[default]
    Memory,
    /// So many.
    Bits(u64),
    /// No limit.
    Unlimited,
}

impl FromStr for MaximalBits {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "none" => Ok(Self::Unlimited),
            text => match text.parse() {
                Ok(bits @ 1..) => Ok(Self::Bits(bits)),
                _ => Err("a number of bits, at least 1, or `none`"),
            },
        }
    }
}

impl MaximalBits {
    /// The limit for so many states and sensors.
    pub(super) fn of(self, states: usize, sensors: usize) -> Option<u64> {
        let rows = u64::try_from(states.saturating_mul(2).saturating_add(sensors)).unwrap_or(u64::MAX).max(1);
        match self {
            Self::Memory => Some(MEMORY / rows.saturating_mul(rows)),
            Self::Bits(bits) => Some(bits),
            Self::Unlimited => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits() {
        // By hand: 2³¹/9, and 2³¹/100 for n = 4, m = 2.
        assert_eq!(MaximalBits::Memory.of(1, 1), Some(238_609_294));
        assert_eq!(MaximalBits::Memory.of(4, 2), Some(21_474_836));
        assert_eq!(MaximalBits::Memory.of(usize::MAX, 1), Some(0));
        assert_eq!("none".parse::<MaximalBits>().map(|limit| limit.of(1, 1)), Ok(None));
        assert_eq!("7".parse::<MaximalBits>().map(|limit| limit.of(1, 1)), Ok(Some(7)));
        for text in ["0", "-1", "", "1e6", "all"] {
            assert!(text.parse::<MaximalBits>().is_err(), "{text}");
        }
    }
}
