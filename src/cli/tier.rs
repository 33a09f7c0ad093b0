//! How `solve` computes: exactly, by enclosures, or by both in turn.

use clap::ValueEnum;

/// The tiers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Tier {
    /// Exact numbers, which lengthen with every step.
    Exact,
    /// Enclosures alone, whose cost is the same at each step: digits are proved, an entry that may be zero or a tie is told
    /// with a bound (`0±3e-40`), and a rank that cannot be decided ends the answer.
    Certified,
    /// Exact numbers while they are short and wherever enclosures do not decide, else enclosures: the digits of the exact tier.
    Auto,
}

/// The options that choose a tier.
#[derive(clap::Args, Clone, Copy, Debug)]
pub(super) struct Tiering {
    /// How numbers are computed; they are the same to the last digit [default: auto; with --exact, --trace and --ahead,
    /// exact].
    #[arg(long, value_enum, conflicts_with = "exact")]
    tier: Option<Tier>,
    /// The most bits of enclosures: they begin with 4 for each digit and 128 more, and are doubled until all digits are
    /// proved [default: 4096, or four times those with which they begin if that is more].
    #[arg(long, value_name = "BITS", value_parser = clap::value_parser!(u64).range(64..=1 << 24))]
    most_bits: Option<u64>,
}

impl Tiering {
    /// The tier, for fractions or for what needs the readable recursion.
    pub(super) fn tier(self, exact: bool, readable: bool) -> Tier {
        match self.tier {
            _ if exact => Tier::Exact,
            Some(Tier::Auto) | None if readable => Tier::Exact,
            Some(tier) => tier,
            None => Tier::Auto,
        }
    }

    /// Whether exact numbers are asked for.
    pub(super) fn is_exact(self) -> bool {
        self.tier == Some(Tier::Exact)
    }

    /// The most bits, for so many digits.
    pub(super) fn most_bits(self, digits: u32) -> u64 {
        self.most_bits.unwrap_or_else(|| (4 * (4 * u64::from(digits) + 128)).max(1 << 12))
    }
}
