//! The program, run as people run it. Subjects are shell scripts, so this is for Linux.
#![cfg(all(feature = "cli", target_os = "linux"))]

mod cases;
mod check;
mod declared;
mod estimate;
mod explain;
mod formats;
mod help;
mod identify;
mod input;
mod interrupt;
mod jobs;
mod judge;
mod limit;
mod misbehaviour;
mod program;
mod report;
mod reproduce;
mod solve;
mod spec;
mod stability;
mod steady;
mod verdicts;
mod verify;
