//! Floor 3 · The checker of certificates: integers only, and no code of what makes them.
//!
//! A certificate says of each step of a filter, or of a steady state, where the exact values lie, with the few matrices that
//! prove it. The checker trusts none of them: it computes both sides of each inequality as integers. The format and the
//! inequalities are described in `docs/CERTIFICATES.md`.

mod digest;
mod document;
mod hexadecimal;
mod steady_document;
mod written;

pub use document::{
    BeliefDocument, DyadicMatrix, DyadicNumber, FilterEnd, FilterFormat, FilterHeader, MAXIMAL_EXPONENT,
    MAXIMAL_LINE_BYTES, MAXIMAL_ROWS, StepDocument,
};
pub use hexadecimal::{Hexadecimal, MAXIMAL_DIGITS};
pub use steady_document::{RationalRows, Stabilising, SteadyDocument, SteadyEvidence};
