//! Bytes from outside, as a case.

#![no_main]

#[path = "../bodies/parse_case.rs"]
mod parse_case;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    parse_case::run(bytes);
});
