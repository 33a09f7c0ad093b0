//! Floor 3 · The checker of certificates: integers only, and no code of what makes them.
//!
//! A certificate says of each step of a filter, or of a steady state, where the exact values lie, with the few matrices that
//! prove it. The checker trusts none of them: it computes both sides of each inequality as integers. The format and the
//! inequalities are described in `docs/CERTIFICATES.md`.

mod belief;
mod certificate;
mod definite;
mod digest;
mod document;
mod filter;
mod hexadecimal;
mod lines;
mod polynomial;
mod rejection;
mod steady;
mod steady_document;
mod step;
mod table;
mod unified;
mod written;

pub use belief::Belief;
pub use certificate::{CertificateWriter, FilterCertificate};
pub use document::{
    BeliefDocument, DyadicMatrix, DyadicNumber, FilterEnd, FilterFormat, FilterHeader, MAXIMAL_EXPONENT,
    MAXIMAL_LINE_BYTES, MAXIMAL_ROWS, StepDocument,
};
pub use filter::{FilterCheck, ProvedStep};
pub use hexadecimal::{Hexadecimal, MAXIMAL_DIGITS};
pub use lines::VerifyError;
pub use rejection::{Condition, Rejection};
pub use steady::{ProvedSteady, check_steady};
pub use steady_document::{RationalRows, Stabilising, SteadyDocument, SteadyEvidence};
