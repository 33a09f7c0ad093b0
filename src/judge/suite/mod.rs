//! The cases that everybody is asked, by category.
//!
//! Each case tests one thing and says which: its flags are explained once, in [`meaning`]. Ordinary models come
//! first, so that a mistake of an adapter is told apart from one of a filter.

mod adapted;
mod bad_input;
mod basic;
mod correlated;
mod diffuse;
mod draft;
mod flags;
mod missing;
mod real;
mod singular;
mod units;
mod unstable;
mod varying;

pub use flags::meaning;

use crate::protocol::Case;

/// All cases of the suite, in order.
///
/// # Examples
///
/// ```
/// let cases = exact_kalman::judge::suite();
/// assert!(cases.len() >= 30);
/// assert_eq!(cases[0].id, "basic/constant");
/// ```
pub fn suite() -> Vec<Case> {
    let categories: [fn() -> Vec<Case>; 11] = [
        basic::cases,
        missing::cases,
        varying::cases,
        adapted::cases,
        correlated::cases,
        diffuse::cases,
        unstable::cases,
        units::cases,
        singular::cases,
        real::cases,
        bad_input::cases,
    ];
    categories.iter().flat_map(|category| category()).collect()
}
