//! Floor 5 · Identities, proved by running the library's own code on variables.
//!
//! An [`Identity`] of the [`catalogue`] has one body, written over any field: it asks for entries, calls the routines of the rooms
//! below, and hands out pairs of matrices that should be equal. The body is run in three ways:
//!
//! * on the variables of [`RationalFunction`](crate::scalar::RationalFunction): equal sides are a *proof* for matrices of that size.
//!   What is proved is the identity of rational functions: it holds wherever both sides are defined and the code takes the
//!   decisions (pivots, ranks) that it takes for variables, which is everywhere but on the zeros of some polynomial. What is supposed besides is
//!   the identity's hypothesis. Where a theorem is about singular matrices, others of its identities build them from factors;
//! * at random points of the field of 2⁶¹ − 1 elements, for larger sizes: equal sides are *no proof*, but a wrong identity would be
//!   accepted with a probability that is bounded ([`Chance`] has the argument);
//! * at small integers, for its *twin*: the same body with one slip that programmers make. The twin must be disproved, and the
//!   point at which it fails is shown.
//!
//! # Examples
//!
//! ```
//! use exact_kalman::{prove::catalogue, scalar::ratio};
//!
//! let identities = catalogue();
//! let subtractive = identities.iter().find(|identity| identity.identifiers.contains(&"AK-L4.1iv")).expect("one says it");
//! subtractive.proved(subtractive.symbolic[0])?;
//! assert!(subtractive.chance(subtractive.random[0], 1)?.bound() < ratio(1, 1_000_000_000_000_000));
//! let witness = subtractive.twin_disproved()?;
//! assert!(witness.to_string().contains("F = "));
//! # Ok::<(), exact_kalman::prove::Failure>(())
//! ```

mod body;
mod catalogue;
mod chance;
mod entries;
mod identities;
mod proof;
mod tracked;
mod witness;

pub use body::{Failure, Size};
pub use catalogue::{Identity, catalogue};
pub use chance::Chance;
pub use proof::Proof;
pub use tracked::Tracked;
pub use witness::Witness;
