//! Certificates from outside, and changed ones.

#![no_main]

#[path = "../bodies/verify_certificate.rs"]
mod verify_certificate;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify_certificate::run(bytes);
});
