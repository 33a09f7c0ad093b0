//! Missing readings.

use super::basic::{pairs, velocity};
use super::draft::{Draft, scatter, thousandths};
use crate::protocol::Case;

pub(super) fn cases() -> Vec<Case> {
    let gaps = |readings: Vec<String>, missing: &[usize]| -> Vec<String> {
        let keep = |(k, text): (usize, String)| if missing.contains(&k) { String::new() } else { text };
        readings.into_iter().enumerate().map(keep).collect()
    };
    let halves = |readings: Vec<String>| -> Vec<String> {
        let cut = |(k, text): (usize, String)| {
            let (first, second) = text.split_once(' ').unwrap_or((&text, "-"));
            match k % 4 {
                1 => format!("- {second}"),
                2 => format!("{first} -"),
                _ => text,
            }
        };
        readings.into_iter().enumerate().map(cut).collect()
    };
    vec![
        velocity("missing/whole-steps", "some steps have no reading at all", &["missing"])
            .reading(gaps(scatter(11, 20, 5000).map(thousandths).collect(), &[3, 4, 5, 9, 19])),
        velocity("missing/first-reading", "the first steps have no reading", &["missing"])
            .reading(gaps(scatter(12, 12, 5000).map(thousandths).collect(), &[0, 1, 2])),
        Draft::new("missing/one-of-two-sensors", "now one, now the other of two sensors is silent", &["missing"])
            .starting("0 0", "3 1; 1 2")
            .transition("0.95 0.1; 0 0.9")
            .observation("1 0.5; 0 1")
            .noise("0.2 0.05; 0.05 0.1", "0.4 0.1; 0.1 0.3")
            .reading(halves(pairs(13, 16).collect())),
        Draft::new(
            "missing/one-of-two-correlated",
            "one sensor is silent while its noise is correlated with the state's",
            &["missing", "correlated"],
        )
        .starting("0 0", "3 1; 1 2")
        .transition("0.95 0.1; 0 0.9")
        .observation("1 0.5; 0 1")
        .noise("0.4 0.05; 0.05 0.3", "0.4 0.1; 0.1 0.3")
        .cross("0.1 0.05; -0.1 0.1")
        .reading(halves(pairs(14, 12).collect())),
    ]
}
