//! Floor 3 · The line protocol: cases, answers, and the programs that are asked.
//!
//! A [`Case`] goes out on one line of JSON, an [`Answer`] comes back on one line; a [`Subject`] is the program in
//! between, which may first say what it is in a [`Declaration`]. Numbers travel as strings, and [`Numbers`] says what the strings mean. Everything that comes from
//! outside is bounded before it is computed with: [`MAXIMAL_DOCUMENT_BYTES`],
//! [`MAXIMAL_LITERAL_CHARACTERS`], [`MAXIMAL_EXACT_EXPONENT`], and the [`Limits`] of a subject.
//!
//! Holds no filter and no verdict: a case becomes the exact [`Problem`] it means, an answer becomes
//! [`Values`](crate::trace::Values), a misbehaving subject becomes a [`Reply`]. The format is described for
//! strangers in `docs/PROTOCOL.md`, and as JSON Schema in `schema/`.

mod ahead_document;
mod along;
mod answer;
mod answer_document;
mod answer_number;
mod answer_stream;
mod case;
mod case_error;
mod datum;
mod decimal;
mod decimal_of_interval;
mod declaration;
mod declared;
mod document;
mod entry;
mod estimate_case;
mod fault;
mod identification;
mod input_error;
mod literal;
mod number;
mod pretty;
mod problem;
mod stability_model;
mod steady_model;
mod subject;
mod values;
mod witness;

pub use along::{Along, Matrices, Rows, Vectors};
pub use answer::{Answer, AnswerError, LawAhead, Outcome};
pub use answer_number::AnswerNumber;
pub use answer_stream::AnswerStream;
pub use case::{Case, CaseFormat, Expect, InitialLaw, InputTerm, NoiseLaw};
pub use case_error::CaseError;
pub use datum::Datum;
pub use decimal::Decimal;
pub use declaration::{Declaration, DeclarationFormat, MAXIMAL_DECLARATION_BYTES};
pub use declared::Declared;
pub use document::MAXIMAL_DOCUMENT_BYTES;
pub use entry::Entry;
pub use estimate_case::{EstimateCase, EstimateFormat, LawPart};
pub use identification::{
    AdaptiveStart, Identification, IdentificationFormat, LeastSquares, Moments, RepairName, ResidualsName,
};
pub use input_error::InputError;
pub use literal::{MAXIMAL_EXACT_EXPONENT, MAXIMAL_LITERAL_CHARACTERS};
pub use number::{Number, NumberError, Numbers, shortest_double};
pub use problem::Problem;
pub use stability_model::{ChainDocument, ChainMatrices, ModeDocument, ModeMatrices, StabilityFormat, StabilityModel};
pub use steady_model::{SteadyEquation, SteadyModel};
pub use subject::{Limits, Reply, Strays, Subject};
pub use witness::short_witness;
