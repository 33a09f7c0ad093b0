//! Digests, which catch accidents; they prove nothing.

use std::fmt::Write;

use sha2::{Digest, Sha256};

/// The SHA-256 of bytes, in lowercase hexadecimal digits.
pub(super) fn sha256(bytes: &[u8]) -> String {
    digits(Sha256::new().chain_update(bytes))
}

/// The digest of what was taken in.
pub(super) fn digits(state: Sha256) -> String {
    state.finalize().iter().fold(String::new(), |mut digits, byte| {
        let _ = write!(digits, "{byte:02x}");
        digits
    })
}
