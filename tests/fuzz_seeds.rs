//! The seeds of the fuzz targets through the same bodies, without a fuzzer.

#![cfg(feature = "judge")]

#[path = "../fuzz/bodies/parse_case.rs"]
mod parse_case;
#[path = "../fuzz/bodies/recursion_agrees.rs"]
mod recursion_agrees;
#[path = "../fuzz/bodies/verify_certificate.rs"]
mod verify_certificate;

use std::path::Path;

use exact_kalman::model::Timing;
use parse_case::Reached;

/// The names and contents of the seeds of a target, by name.
fn seeds(target: &str) -> Vec<(String, Vec<u8>)> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/seeds").join(target);
    let entries = std::fs::read_dir(&directory).unwrap_or_else(|error| panic!("{}: {error}", directory.display()));
    let mut seeds: Vec<_> = entries
        .map(|entry| {
            let path = entry.unwrap_or_else(|error| panic!("{error}")).path();
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            assert!(bytes.len() < 2048, "{name} is no small seed");
            (name, bytes)
        })
        .collect();
    seeds.sort();
    seeds
}

/// A seed's name begins with how far it comes.
#[test]
fn cases_are_read_or_refused() {
    let mut counts = [0; 4];
    for (name, bytes) in seeds("parse_case") {
        let stages = [
            ("document", Reached::NoCase),
            ("number", Reached::NoProblem),
            ("model", Reached::NoPath),
            ("path", Reached::Path),
        ];
        let (place, expected) = stages
            .iter()
            .enumerate()
            .find_map(|(place, (stage, expected))| name.starts_with(stage).then_some((place, *expected)))
            .unwrap_or_else(|| panic!("{name} says not how far it comes"));
        assert_eq!(parse_case::run(&bytes), expected, "{name}");
        counts[place] += 1;
    }
    assert!(counts.iter().all(|&count| count > 0), "a stage has no seed: {counts:?}");
}

#[test]
fn every_route_agrees_on_the_seeds() {
    let met: Vec<_> = seeds("recursion_agrees").iter().map(|(_, bytes)| recursion_agrees::run(bytes)).collect();
    for timing in [Timing::Arriving, Timing::Departing] {
        for singular in [false, true] {
            let count = met.iter().filter(|met| met.timing == timing && met.singular == singular).count();
            assert!(count > 0, "no seed is {timing:?} with singular = {singular}: {met:?}");
        }
    }
    assert!(met.iter().all(|met| met.modular) && met.iter().any(|met| met.gap), "{met:?}");
}

/// A seed's name begins with how far it comes, or with «any».
#[test]
fn certificates_are_verified_or_rejected() {
    use verify_certificate::Reached::{Accepted, Nothing, Rejected};
    let stages = [("nothing", Nothing), ("rejected", Rejected), ("accepted", Accepted)];
    let mut counts = [0; 3];
    for (name, bytes) in seeds("verify_certificate") {
        let reached = verify_certificate::run(&bytes);
        if let Some(place) = stages.iter().position(|(stage, _)| name.starts_with(stage)) {
            assert_eq!(reached, stages[place].1, "{name}");
            counts[place] += 1;
        }
    }
    assert!(counts.iter().all(|&count| count > 0), "a stage has no seed: {counts:?}");
}
