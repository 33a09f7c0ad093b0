//! The kinds of data that a problem is made of.

use std::fmt;

/// A kind of datum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum DataKind {
    /// The initial mean and covariance.
    Start,
    /// The matrices A.
    Transition,
    /// The matrices C.
    Observation,
    /// The covariances of the noises, and between them.
    Noise,
    /// The inputs of state and observation.
    Input,
    /// The readings.
    Reading,
}

impl DataKind {
    /// Every kind, in order.
    pub const ALL: [Self; 6] =
        [Self::Start, Self::Transition, Self::Observation, Self::Noise, Self::Input, Self::Reading];

    const fn place(self) -> usize {
        match self {
            Self::Start => 0,
            Self::Transition => 1,
            Self::Observation => 2,
            Self::Noise => 3,
            Self::Input => 4,
            Self::Reading => 5,
        }
    }
}

impl fmt::Display for DataKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Start => "initial law",
            Self::Transition => "transition",
            Self::Observation => "observation matrix",
            Self::Noise => "noise",
            Self::Input => "input",
            Self::Reading => "readings",
        })
    }
}

/// Which kinds of data are moved, and by how much.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Moved {
    kinds: [bool; DataKind::ALL.len()],
    /// The relative move is 2 to the power of minus this.
    pub(super) bits: u32,
}

impl Moved {
    /// All data.
    pub(super) const fn all(bits: u32) -> Self {
        Self { kinds: [true; DataKind::ALL.len()], bits }
    }

    /// All data but those of one kind.
    pub(super) const fn all_but(kind: DataKind, bits: u32) -> Self {
        let mut kinds = [true; DataKind::ALL.len()];
        kinds[kind.place()] = false;
        Self { kinds, bits }
    }

    /// The data of one kind.
    pub(super) const fn only(kind: DataKind, bits: u32) -> Self {
        let mut kinds = [false; DataKind::ALL.len()];
        kinds[kind.place()] = true;
        Self { kinds, bits }
    }

    /// Whether data of this kind are moved.
    pub(super) const fn moves(self, kind: DataKind) -> bool {
        self.kinds[kind.place()]
    }
}
