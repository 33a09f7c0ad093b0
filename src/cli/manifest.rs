//! The list of the files of a suite, with their checksums.

use std::collections::BTreeMap;

use serde::Serialize;
use sha2::{Digest as _, Sha256};

use crate::judge::SUITE_VERSION;

/// The document `MANIFEST.json`.
#[derive(Serialize)]
pub(super) struct Manifest {
    format: &'static str,
    /// Which published suite; nothing for cases of one's own.
    #[serde(skip_serializing_if = "Option::is_none")]
    suite: Option<u32>,
    /// Which made-up readings.
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
    cases: usize,
    /// SHA-256 of each file, by its path.
    files: BTreeMap<String, String>,
}

impl Manifest {
    /// A list without files yet; the seed is that of the built-in suite.
    pub(super) fn new(cases: usize, seed: Option<u64>) -> Self {
        let suite = seed.map(|_| SUITE_VERSION);
        Self { format: "exact-kalman/manifest/1", suite, seed, cases, files: BTreeMap::new() }
    }

    pub(super) fn add(&mut self, path: String, content: &str) {
        self.files.insert(path, checksum(content));
    }

    /// The document, a file a line.
    pub(super) fn text(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }
}

fn checksum(content: &str) -> String {
    let nibbles = Sha256::digest(content.as_bytes()).into_iter().flat_map(|byte| [byte >> 4, byte & 15]);
    nibbles.filter_map(|nibble| char::from_digit(nibble.into(), 16)).collect()
}
