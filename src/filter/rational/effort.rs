//! How far the filter on exact rationals goes, and by which route.

/// How the states of a path are computed; all routes give the same values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Route {
    /// The route that is expected to be the fastest, step by step: remainders where several states or sensors are to be
    /// worked through and numbers have some hundred bits, elimination on integers elsewhere.
    #[default]
    Fastest,
    /// Elimination on integers over one denominator.
    FractionFree,
    /// The same elimination modulo many primes below 2⁶², on all cores, and the integers from their remainders.
    ///
    /// So many primes are taken that they determine the integers, by a bound that holds where covariances are positive
    /// semidefinite. Those of a path that [`System::realised`](crate::model::System::realised) has made are; other paths go
    /// through the elimination on integers.
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

/// The part of a limit on lengths that counts where fractions are kept in lowest terms: they cost so much more than integers
/// that they may grow so much less.
pub const FRACTIONS_PART: u64 = 16;

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
