//! The judge: digits, attainable digits, verdicts, and the suite of cases.
#![cfg(feature = "judge")]

mod attainable;
mod bad_cases;
mod built_in;
mod digits;
mod exact_solver;
mod mistakes;
mod references;
mod samples;
mod suite;
mod verdicts;
