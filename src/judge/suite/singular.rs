//! Innovations whose covariance is singular, with data that fit and data that cannot be.

use super::draft::Draft;
use crate::protocol::{Case, Expect};

pub(super) fn cases() -> Vec<Case> {
    let twins = |id: &str, about: &str, flags: &[&str]| {
        Draft::new(id, about, flags).starting("0", "1").observation("1; 1").noise("1", "0 0; 0 0")
    };
    let plane = |id: &str, about: &str| {
        Draft::new(id, about, &["singular"])
            .starting("0 0", "2 1; 1 2")
            .transition("1 0.5; 0 1")
            .noise("1 0; 0 1", "0 0 0; 0 0 0; 0 0 0")
    };
    vec![
        twins("singular/equal-sensors", "two sensors without noise that read the same", &["singular"])
            .reading(["1 1", "1.5 1.5", "3 3"]),
        twins(
            "singular/equal-sensors-disagree",
            "two sensors without noise that read differently at step 1",
            &["singular", "contradiction"],
        )
        .expecting(Expect::Flag)
        .reading(["1 1", "1 1.5", "3 3"]),
        Draft::new("singular/proportional-sensors", "one sensor reads three times what the other reads", &["singular"])
            .starting("0", "1")
            .observation("1; 3")
            .noise("0.5", "0 0; 0 0")
            .reading(["1 3", "2.5 7.5", "-1 -3"]),
        plane("singular/sum-of-sensors", "the third sensor reads the sum of the other two")
            .observation("1 0; 0 1; 1 1")
            .reading(["1 2 3", "2 2.5 4.5", "3 3 6"]),
        Draft::new(
            "singular/common-noise",
            "two sensors that share one noise: their difference has none",
            &["singular"],
        )
        .starting("0 0", "1 0; 0 1")
        .transition("1 0; 0 1")
        .observation("1 0; 1 0")
        .factors("0 1 0; 0 0 1", "1 0 0; 1 0 0")
        .reading(["1 1", "0.5 0.5", "2 2"]),
        Draft::new("singular/known-state", "the state is known exactly and the sensor has no noise", &["singular"])
            .starting("2", "0")
            .noise("0", "0")
            .reading(["2", "2", "2"]),
        Draft::new(
            "singular/known-state-contradicted",
            "as before, but step 2 reads something else",
            &["singular", "contradiction"],
        )
        .starting("2", "0")
        .noise("0", "0")
        .expecting(Expect::Flag)
        .reading(["2", "2", "2.125", "2"]),
        Draft::new("singular/blind-sensor", "one of two sensors sees nothing, without noise", &["singular"])
            .starting("0", "1")
            .observation("1; 0")
            .noise("0.5", "1 0; 0 0")
            .reading(["1 0", "2 0", "1.5 0"]),
        Draft::new(
            "singular/settled-after-one",
            "a constant read without noise: after step 0 nothing is left to learn",
            &["singular"],
        )
        .starting("0", "1")
        .noise("0", "0")
        .reading(["0.75", "0.75", "0.75"]),
        Draft::new("singular/noise-free", "sensors without noise, but regular innovations", &["ill-conditioned"])
            .starting("0 0", "1 0; 0 1")
            .transition("1 0.1; 0 1")
            .observation("1 0")
            .noise("0.01 0; 0 0.01", "0")
            .reading(["0.5", "0.625", "0.75", "0.5"]),
        Draft::new("singular/prior-of-rank-one", "an initial covariance of rank one", &["ill-conditioned"])
            .starting("0 0", "1 2; 2 4")
            .transition("1 0; 0 1")
            .observation("1 0; 0 1")
            .noise("0.1 0; 0 0", "1 0; 0 1")
            .reading(["1 2", "0.5 1.5", "1 2.5"]),
    ]
}
