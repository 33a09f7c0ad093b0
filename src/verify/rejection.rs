//! Why a certificate is not accepted.

use std::fmt;

use super::definite::Indefinite;

/// A condition that a certificate must meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Condition {
    /// The text is a document of its form.
    Document,
    /// The digest is that of the bytes.
    Digest,
    /// The case is one of which such a certificate can speak.
    Case,
    /// The steps are those of the case, each once and in its order.
    Order,
    /// The members are those that the step has, and no others.
    Members,
    /// The matrices have the shapes that the case asks for.
    Shape,
    /// The numbers are not too far from one for a checker.
    Size,
    /// `−W ≤ P − P̃ ≤ W` for the belief before the first step.
    StartCovariance,
    /// `(x̂ − x̃)(x̂ − x̃)ᵀ ≤ E` for the belief before the first step.
    StartMean,
    /// The sensors that are left out follow from those that are kept.
    Kept,
    /// κ > 0: the covariance of the innovation is regular.
    Regular,
    /// `−W₊ ≤ φ(P) − P̃₊ ≤ W₊` for all P between P̃ ± W.
    Covariance,
    /// `e₊e₊ᵀ ≤ E₊` for all e with eeᵀ ≤ E.
    Mean,
    /// E > 0: the set of covariances is bounded and has an interior.
    Interior,
    /// The recursion maps the set of covariances into itself.
    Invariance,
    /// X > 0, r < 1, and r²X − GXGᵀ ≥ 0 for all closed loops.
    Contraction,
    /// The columns, or rows, are independent.
    Independent,
    /// The equations of the subspace.
    Subspace,
    /// The eigenvalue that is claimed.
    Eigenvalue,
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Document => "document",
            Self::Digest => "digest",
            Self::Case => "case",
            Self::Order => "order of the steps",
            Self::Members => "members",
            Self::Shape => "shape",
            Self::Size => "size",
            Self::StartCovariance => "covariance before the first step",
            Self::StartMean => "mean before the first step",
            Self::Kept => "sensors left out",
            Self::Regular => "regular innovation",
            Self::Covariance => "covariance",
            Self::Mean => "mean",
            Self::Interior => "interior",
            Self::Invariance => "invariance",
            Self::Contraction => "contraction",
            Self::Independent => "independence",
            Self::Subspace => "subspace",
            Self::Eigenvalue => "eigenvalue",
        })
    }
}

/// The first condition of a certificate that does not hold.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{}{condition}: {message}", place("line", *line), place("step", *step))]
pub struct Rejection {
    /// The line, from 1, of a certificate that has many.
    pub line: Option<usize>,
    /// The step, from 0.
    pub step: Option<usize>,
    /// Which one it is.
    pub condition: Condition,
    /// By how much, or what else is wrong.
    pub message: String,
}

fn place(name: &str, number: Option<usize>) -> String {
    number.map(|number| format!("{name} {number}, ")).unwrap_or_default()
}

/// A condition that does not hold; where, is not yet said.
pub(super) fn wrong(condition: Condition, message: impl Into<String>) -> Rejection {
    Rejection { line: None, step: None, condition, message: message.into() }
}

/// A matrix that must be positive semidefinite and is not known to be.
pub(super) fn indefinite(condition: Condition, what: &str, found: &Indefinite) -> Rejection {
    let Indefinite { row, size, is_decided } = found;
    if !is_decided {
        return wrong(condition, format!("{what} is not proved: to decide it exactly would take too long"));
    }
    let by = size.map(|size| format!(", short by about 2^{size}")).unwrap_or_default();
    wrong(condition, format!("{what} is not proved: not positive semidefinite in row {row}{by}"))
}
