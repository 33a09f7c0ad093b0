//! Data whose log likelihood is easy to get wrong.

use super::draft::Draft;
use super::draw::Draw;
use super::table::{gaps, silenced};
use crate::protocol::Case;

const FLAGS: [&str; 1] = ["likelihood"];

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    let walk = |id: &str, about: &str| Draft::new(id, about, &FLAGS).starting("0", "4").noise("0.5", "1");
    let three = |id: &str, about: &str| {
        Draft::new(id, about, &FLAGS)
            .starting("0 1", "2 0.5; 0.5 1")
            .transition("0.75 0.25; -0.25 0.5")
            .observation("1 0; 0 1; 1 1")
            .noise("0.5 0; 0 0.25", "1 0.5 0; 0.5 2 0.25; 0 0.25 0.5")
    };
    vec![
        walk("likelihood/one-reading", "one reading of variance 5: -(log 2 pi + log 5 + y^2/5)/2").reading(["2"]),
        walk("likelihood/gaps", "a missing reading adds nothing, not even log 2 pi")
            .reading(gaps(draw.singles(201, 12, 3000), &[0, 3, 4, 11])),
        walk("likelihood/nothing-read", "no reading at all: the likelihood is one").reading([""; 4]),
        three("likelihood/three-sensors", "the constant is three times log 2 pi")
            .reading(draw.several(3, 202, 6, 2000)),
        three("likelihood/partial-gaps", "the constant counts the sensors that were read")
            .reading(silenced(draw.several(3, 203, 8, 2000), |k, i| (k + i) % 3 == 0 || k == 5)),
        walk(
            "likelihood/unlikely",
            "a reading thousands of deviations away: the density underflows, its logarithm does not",
        )
        .reading(["1", "5000", "-3"]),
        Draft::new(
            "likelihood/tiny-variance",
            "deviations of 10⁻⁹: the densities are huge, and their logarithm positive",
            &FLAGS,
        )
        .starting("0", "4e-18")
        .noise("5e-19", "1e-18")
        .reading(draw.powers(204, 10, 3000, -12)),
        Draft::new(
            "likelihood/underflowing-determinant",
            "three sensors with variances of 10⁻¹²⁰: their product is no double",
            &FLAGS,
        )
        .starting("0 0", "4e-120 0; 0 1e-120")
        .transition("1 0; 0 1")
        .observation("1 0; 0 1; 1 1")
        .noise("1e-121 0; 0 1e-121", "1e-120 0 0; 0 2e-120 0; 0 0 5e-121")
        .reading(
            draw.scatter(205, 5, 3000)
                .zip(draw.scatter(206, 5, 3000))
                .map(|(a, b)| format!("{a}e-63 {b}e-63 {}e-63", a - b)),
        ),
        Draft::new("likelihood/varying-noise", "each reading has a variance of its own", &FLAGS)
            .varying_noise(["0.5"; 8], ["1", "100", "0.0625", "2", "1e-6", "1e6", "1", "4"])
            .reading(draw.singles(207, 8, 3000)),
        Draft::new("likelihood/correlated", "shared noise changes the likelihood as well as the estimate", &FLAGS)
            .transition("0.5")
            .noise("1", "0.5")
            .cross("-0.5")
            .reading(draw.singles(208, 8, 2000)),
        Draft::new("likelihood/with-offset", "the offset is part of what was expected", &FLAGS)
            .noise("0.25", "0.5")
            .observation_input("10")
            .reading(draw.scatter(209, 8, 2000).map(|value| super::draw::thousandths(10_000 + value))),
    ]
}
