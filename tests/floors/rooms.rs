//! The floors of the house, and what is wrong with an import.

use crate::imports::rooms_named;

/// The floor of each room, those that are planned included.
const FLOORS: [(&str, u32); 22] = [
    ("scalar", 0),
    ("matrix", 1),
    ("modular", 1),
    ("gaussian", 2),
    ("model", 2),
    ("trace", 2),
    ("verify", 3),
    ("filter", 3),
    ("float", 3),
    ("riccati", 3),
    ("protocol", 3),
    ("certify", 4),
    ("nongaussian", 4),
    ("identify", 4),
    ("stability", 4),
    ("prove", 5),
    ("reproduce", 5),
    ("judge", 5),
    ("report", 6),
    ("spec", 6),
    ("cli", 7),
    ("lib", 8),
];

/// The floor of a room.
pub fn floor(room: &str) -> Option<u32> {
    FLOORS.iter().find(|(name, _)| *name == room).map(|(_, floor)| *floor)
}

/// What is wrong with the imports of a file of a room, `depth` modules down.
pub fn violations(room: &str, depth: usize, source: &str) -> Vec<String> {
    let Some(own) = floor(room) else { return vec![format!("{room} has no floor")] };
    let wrong = |other: &String| match floor(other) {
        _ if other == room => None,
        None => Some(format!("{room} names crate::{other}, which has no floor")),
        Some(floor) if floor < own => None,
        Some(floor) => Some(format!("{room} (floor {own}) imports {other} (floor {floor})")),
    };
    rooms_named(source, depth).iter().filter_map(wrong).collect()
}

#[test]
fn upward_and_sideways_imports_are_found() {
    let found = |room, source| violations(room, 2, source).len();
    assert_eq!(found("matrix", "use crate::scalar::Field;\nuse crate::matrix::Matrix;"), 0);
    assert_eq!(found("matrix", "use crate::filter::filter;"), 1);
    assert_eq!(found("float", "use crate::{matrix::Matrix, filter::{self, Precision}, judge};"), 2);
    assert_eq!(found("filter", "fn f(x: &crate::float::Form) {}"), 1);
    assert_eq!(found("gaussian", "pub(crate) use crate :: model :: System;"), 1);
    assert_eq!(found("gaussian", "use crate::cellar::Wine;"), 1);
    assert_eq!(found("model", "const N: usize = crate\n::judge::N; use my_crate::judge;"), 1);
    assert_eq!(found("attic", ""), 1);
    assert_eq!(found("matrix", "use super::solve::solve; use super::super::filter::filter;"), 1);
}
