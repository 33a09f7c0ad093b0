//! The protocol: what is read, what is refused, and what a subject may do to us.
#![cfg(feature = "judge")]

mod answers;
mod bad_input;
mod cases;
mod certificates;
mod decimals;
mod declaration;
mod estimate;
#[cfg(target_os = "linux")]
mod examples;
mod identification;
mod mutation;
mod numbers;
mod page;
mod samples;
mod schema;
mod stability_model;
mod steady_model;
#[cfg(target_os = "linux")]
mod subjects;
#[cfg(target_os = "linux")]
mod textbook;
