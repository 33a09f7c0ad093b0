//! Bytes as a small system with data, through every exact route.

#![no_main]

#[path = "../bodies/recursion_agrees.rs"]
mod recursion_agrees;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    recursion_agrees::run(bytes);
});
