//! Every data set is listed with its origin, its licence and the checksum that it really has.

use std::fs;
use std::path::Path;

use sha2::{Digest, Sha256};

#[test]
fn data_sets_have_the_checksums_that_are_listed() -> Result<(), std::io::Error> {
    let sources = include_str!("../data/SOURCES.md");
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
    let mut seen = 0;
    for entry in fs::read_dir(directory)? {
        let path = entry?.path();
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default().to_owned();
        if name == "SOURCES.md" {
            continue;
        }
        let digest = Sha256::digest(fs::read(&path)?);
        let nibbles = digest.iter().flat_map(|byte| [byte >> 4, byte & 15]);
        let checksum: String = nibbles.filter_map(|nibble| char::from_digit(nibble.into(), 16)).collect();
        let row = sources.lines().find(|line| line.starts_with(&format!("| `{name}` |")));
        assert!(row.is_some_and(|row| row.contains(&checksum)), "{name} has the checksum {checksum}");
        seen += 1;
    }
    assert!(seen > 0);
    Ok(())
}
