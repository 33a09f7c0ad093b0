//! The judge: digits, attainable digits, verdicts, and the suite of cases.
#![cfg(feature = "judge")]

mod attainable;
mod bad_cases;
mod best_form;
mod built_in;
mod digits;
mod exact_solver;
mod forms;
mod known;
mod likelihood;
mod mistakes;
mod references;
mod samples;
mod suite;
mod verdicts;
