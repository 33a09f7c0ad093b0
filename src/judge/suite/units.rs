//! Small and large units, priors that are nearly flat, sensors that are nearly exact.

use super::basic::velocity;
use super::draft::{Draft, scatter};
use crate::protocol::Case;

/// Whole numbers with an exponent: `3e-9`.
fn powers(seed: i64, count: i64, range: i64, exponent: i32) -> impl Iterator<Item = String> {
    scatter(seed, count, range).map(move |value| format!("{value}e{exponent}"))
}

pub(super) fn cases() -> Vec<Case> {
    vec![
        Draft::new("units/micro", "a random walk in units of 10⁻⁶", &["units"])
            .starting("0", "4e-12")
            .noise("1e-13", "5e-13")
            .reading(powers(71, 20, 3000, -9)),
        Draft::new("units/nano", "a random walk in units of 10⁻⁹", &["units"])
            .starting("0", "4e-18")
            .noise("1e-19", "5e-19")
            .reading(powers(71, 20, 3000, -12)),
        Draft::new(
            "units/tiny",
            "a random walk in units of 10⁻⁹⁰: the determinant of a 2×2 covariance underflows",
            &["units"],
        )
        .starting("0 0", "4e-180 0; 0 4e-180")
        .transition("1 0; 0 1")
        .observation("1 0; 0 1")
        .noise("1e-181 0; 0 1e-181", "5e-181 0; 0 5e-181")
        .reading(powers(72, 10, 3000, -93).zip(powers(73, 10, 3000, -93)).map(|(a, b)| format!("{a} {b}"))),
        Draft::new("units/side-by-side", "one state in units of 10⁹ beside one in units of 10⁻⁹", &["units"])
            .starting("0 0", "4e18 0.5; 0.5 4e-18")
            .transition("1 1e17; 0 1")
            .observation("1 0; 0 1")
            .noise("1e17 0; 0 1e-19", "5e17 0; 0 5e-19")
            .reading(powers(74, 12, 3000, 6).zip(powers(75, 12, 3000, -12)).map(|(a, b)| format!("{a} {b}"))),
        velocity("units/nearly-flat-prior", "initial variances of 10¹² where the noise has 1/2", &["ill-conditioned"])
            .starting("0 0", "1e12 0; 0 1e12")
            .reading(powers(76, 15, 5000, -3)),
        velocity("units/nearly-exact-sensor", "a sensor with noise variance 10⁻¹⁶", &["ill-conditioned"])
            .noise("0.0003 0.005; 0.005 0.1", "1e-16")
            .reading(powers(77, 15, 5000, -3)),
        Draft::new(
            "units/nearly-equal-sensors",
            "two sensors that differ by 2⁻²⁰, with noise of variance 2⁻⁴⁰",
            &["ill-conditioned"],
        )
        .starting("0 0 0", "1 0 0; 0 1 0; 0 0 1")
        .transition("1 0 0; 0 1 0; 0 0 1")
        .observation("1 1 1; 1 1 1.00000095367431640625")
        .noise("0 0 0; 0 0 0; 0 0 0", "9.094947017729282379150390625e-13 0; 0 9.094947017729282379150390625e-13")
        .reading(["3 3", "3 3.000001"]),
    ]
}
