//! The choices that an estimator of A, V and W must make, and that the paper leaves open.

/// Which estimate of A stands at step k in the sums AK-2.2.
///
/// All are consistent (AK-T2.2, AK-Rem2.2); for finite n they differ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Reading {
    /// Â(k) and Â(k)², as printed.
    #[default]
    Printed,
    /// Â(n) and Â(n)² in every term (AK-Rem2.2).
    Last,
    /// Â(k−1) for i = 1 and Â(k)Â(k−1) for i = 2, where Â(2) stands for Â(3): residuals of predictions, which meet
    /// the printed Table 1 (AK-Tab1), though (2.2) does not say so.
    Predictive,
}

impl Reading {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Printed, Self::Last, Self::Predictive];

    /// Its name, one word.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Printed => "printed",
            Self::Last => "last",
            Self::Predictive => "predictive",
        }
    }
}

/// What the adaptive filter does with V̂(k) or Ŵ(k) that is no covariance: not there, or not positive semidefinite.
///
/// AK-T2.4 assumes that this does not happen; AK-B.hat does not assure it. Each of the two is repaired on its own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Repair {
    /// Takes it as it is; where it is not there the filter stops.
    Keep,
    /// Puts the zero matrix in its place.
    #[default]
    Zero,
    /// Puts the last one that was positive semidefinite in its place; the zero matrix as long as there is none.
    LastSemidefinite,
}

impl Repair {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Keep, Self::Zero, Self::LastSemidefinite];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Keep => "keep",
            Self::Zero => "zero",
            Self::LastSemidefinite => "last semidefinite",
        }
    }
}
