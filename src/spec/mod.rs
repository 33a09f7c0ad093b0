//! Floor 6 · The specification and, read from the same page, its entries as data: what `exact-kalman spec` prints
//! and what the tests hold against code and tests. Holds no equation of its own.

mod backing;
mod entry;
mod erratum;
mod parse;

pub use backing::{Backing, Evidence};
pub use entry::{Entry, Paper, Status};
pub use erratum::Erratum;
pub use parse::{MalformedEntry, parse};

/// What begins the line of evidence, and that of tests, which are written by `UPDATE_SPEC=1 cargo test --test spec`.
const BACKING: &str = "\nBacking: ";
const TESTS: &str = "\nTests: ";

/// The page.
const PAGE: &str = include_str!("../../SPEC.md");

/// Every entry of the specification, in the order of the page.
///
/// # Errors
///
/// [`MalformedEntry`] if the page that this library was built with is damaged.
///
/// # Examples
///
/// ```
/// let entries = exact_kalman::spec::entries()?;
/// let gain = entries.iter().find(|entry| entry.id == "CKS-K").expect("the gain of the filter has an entry");
/// assert_eq!(gain.code, ["trace::Record"]);
/// # Ok::<(), exact_kalman::spec::MalformedEntry>(())
/// ```
pub fn entries() -> Result<Vec<Entry<'static>>, MalformedEntry> {
    parse(PAGE)
}
