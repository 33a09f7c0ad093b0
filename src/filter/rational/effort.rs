//! How far the filter on exact rationals goes, and by which route.

/// How the states of a path are computed; all routes give the same values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Route {
    /// The route that is expected to be the fastest, step by step.
    #[default]
    Fastest,
    /// Elimination on integers over one denominator.
    FractionFree,
    /// The same elimination modulo many primes, and the integers from their remainders.
    Multimodular,
}

/// Which results of a step are handed out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wanted {
    /// All but the gain.
    #[default]
    Everything,
    /// The filtered mean and covariance.
    Filtered,
}

/// How far the filter on exact rationals goes, and by which route.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// The route.
    pub route: Route,
    /// What is handed out of each step.
    pub wanted: Wanted,
    /// The length in bits that denominators may reach, if there is a limit; a sixteenth of it in steps that go through
    /// the recursion.
    pub maximal_bits: Option<u64>,
}
