//! Theorems under their hypotheses, and without each of them: a search over the same models finds where the conclusion fails.
//!
//! README.md beside this file lists every theorem of SPEC.md with the test that it holds and the tests that drop its
//! hypotheses, here and elsewhere; `table` keeps the list true.

mod conditioning;
mod enclosures;
mod linear_filter;
mod mixed_start;
#[path = "../papers/anderson_riccati/draws.rs"]
#[expect(dead_code, reason = "shared with tests/papers, which uses more of it")]
mod models;
mod moments;
mod parallel_sums;
mod random_modes;
mod riccati;
mod search;
mod stability;
mod table;
