//! Whether a step is known as well as it is wanted.

/// What is to be done with a step of which so many digits are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(not(feature = "judge"), expect(dead_code, reason = "digits are those of the protocol's decimals"))]
pub(super) enum Standing {
    /// All are proved.
    Proved,
    /// More bits may prove them.
    Short,
    /// All are known to many more digits of their units, but some may be zero, or ties.
    Tied,
}
