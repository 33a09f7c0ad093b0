//! The cases that everybody is asked, by category.
//!
//! Each case tests one thing and says which: its flags are explained once, in [`flags`], its category in [`categories`].
//! Ordinary models come first, so that a mistake of an adapter is told apart from one of a filter.

mod adapted;
mod ahead;
mod arriving;
mod bad_input;
mod bad_shapes;
mod basic;
mod category;
mod collinear;
mod contradiction;
mod conventions;
mod correlated;
mod diffuse;
mod draft;
mod draw;
mod flags;
mod flat;
mod input;
mod large;
mod likelihood;
mod long;
mod missing;
mod poles;
mod prior;
mod real;
mod sampling;
mod sensor;
mod single;
mod singular;
mod still;
mod table;
mod units;
mod unstable;
mod varying;

pub use category::{Category, categories};
pub use flags::{Flag, flag, flags, meaning};

use crate::protocol::Case;
use draw::Draw;

/// The version of the suite, which `suite/MANIFEST.json` names.
///
/// It is raised whenever the problem of a published case changes, a case is taken away, or a case is added: two reports
/// with one version are about the same questions. Ids are never used again for another problem. Sentences, flags and
/// references do not raise it; a wrong reference is a mistake, and its repair stands in the change log.
pub const SUITE_VERSION: u32 = 1;

/// All cases of the suite, in order.
///
/// # Examples
///
/// ```
/// let cases = exact_kalman::judge::suite();
/// assert!(cases.len() >= 200);
/// assert_eq!(cases[0].id, "basic/constant");
/// ```
pub fn suite() -> Vec<Case> {
    suite_seeded(0)
}

/// The suite with other made-up readings, so that nobody can fit the published ones; seed 0 is [`suite`].
///
/// Ids, models, inputs and flags stay. So do readings of the world, and those that must fit together: of singular
/// innovations, of contradictions, of bad input, of answers known by hand.
///
/// # Examples
///
/// ```
/// use exact_kalman::judge::{suite, suite_seeded};
///
/// let (published, drawn) = (suite(), suite_seeded(7));
/// assert!(published.iter().map(|case| &case.id).eq(drawn.iter().map(|case| &case.id)));
/// assert_ne!(published, drawn);
/// ```
pub fn suite_seeded(seed: u64) -> Vec<Case> {
    category::CASES.iter().flat_map(|(_, cases)| cases(Draw::seeded(seed))).collect()
}
