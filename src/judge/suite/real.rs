//! Observations of the world. Origins, licences and checksums stand in `data/SOURCES.md`.

use super::draft::Draft;
use crate::protocol::Case;

/// The annual flow of the Nile at Aswan, 1871–1970, in 10⁸ m³.
const NILE: &str = include_str!("../../../data/nile.csv");

fn nile() -> impl Iterator<Item = &'static str> {
    NILE.lines().skip(1).filter_map(|line| line.split(',').nth(1))
}

/// With the years 1891–1910 and 1931–1950 taken away, as Durbin and Koopman do.
fn nile_with_gaps() -> impl Iterator<Item = &'static str> {
    nile().enumerate().map(|(k, flow)| if (20..40).contains(&k) || (60..80).contains(&k) { "" } else { flow })
}

pub(super) fn cases() -> Vec<Case> {
    let level = |id: &str, about: &str, flags: &[&str]| Draft::new(id, about, flags).noise("1469.1", "15099");
    vec![
        level("nile/diffuse", "annual flow of the Nile 1871-1970, diffuse start", &["real-data", "diffuse"])
            .starting("0", "0")
            .diffuse("1")
            .reading(nile()),
        level("nile/large-prior", "the same flows, initial variance 10⁷ in place of the limit", &["real-data"])
            .starting("0", "1e7")
            .reading(nile()),
        level("nile/missing-years", "the same flows without 1891-1910 and 1931-1950", &["real-data", "missing"])
            .starting("0", "1e7")
            .reading(nile_with_gaps()),
        level(
            "nile/missing-years-diffuse",
            "the same flows without these years, diffuse start",
            &["real-data", "missing", "diffuse"],
        )
        .starting("0", "0")
        .diffuse("1")
        .reading(nile_with_gaps()),
    ]
}
