//! Ordinary models.

use super::draft::{Draft, scatter, thousandths};
use crate::protocol::Case;

pub(super) fn cases() -> Vec<Case> {
    vec![
        Draft::new(
            "basic/constant",
            "a constant read twice; by hand: 1/2 with variance 1/2, then 1 with 1/3",
            &["basic"],
        )
        .reading(["1", "2"]),
        Draft::new("basic/random-walk", "a random walk seen through noise", &["basic"])
            .starting("0", "4")
            .noise("0.1", "0.5")
            .reading(scatter(1, 20, 3000).map(thousandths)),
        velocity("basic/constant-velocity", "position and velocity, the position is read", &["basic"])
            .reading(scatter(2, 20, 5000).map(thousandths)),
        Draft::new(
            "basic/constant-acceleration",
            "position, velocity and acceleration, the position is read",
            &["basic"],
        )
        .starting("0 0 0", "10 0 0; 0 10 0; 0 0 10")
        .transition("1 0.5 0.125; 0 1 0.5; 0 0 1")
        .observation("1 0 0")
        .noise("0.01 0.02 0.01; 0.02 0.05 0.04; 0.01 0.04 0.1", "2")
        .reading(scatter(3, 20, 9000).map(thousandths)),
        Draft::new("basic/two-sensors", "two sensors of unequal noise, which is correlated between them", &["basic"])
            .starting("1 -1", "2 0.5; 0.5 1")
            .transition("0.9 0.1; -0.2 0.8")
            .observation("1 0; 1 1")
            .noise("0.3 0.1; 0.1 0.2", "0.5 0.2; 0.2 1.5")
            .reading(pairs(4, 15)),
        Draft::new("basic/known-input", "a known input moves the state", &["basic", "input"])
            .starting("0 0", "1 0; 0 1")
            .transition("1 0.1; 0 1")
            .observation("1 0")
            .noise("0.001 0; 0 0.01", "0.25")
            .input("0.005; 0.1", scatter(5, 15, 2000).map(thousandths))
            .reading(scatter(6, 15, 2000).map(thousandths)),
        Draft::new("basic/observation-offset", "a known offset is added to the reading", &["basic", "input"])
            .noise("0.2", "0.3")
            .observation_input("10")
            .reading(scatter(7, 10, 1000).map(|value| thousandths(10_000 + value))),
    ]
}

/// Position and velocity with a step of one tenth, a case in the making for other categories too.
pub(super) fn velocity(id: &str, about: &str, flags: &[&str]) -> Draft {
    Draft::new(id, about, flags)
        .starting("0 0", "10 0; 0 10")
        .transition("1 0.1; 0 1")
        .observation("1 0")
        .noise("0.0003 0.005; 0.005 0.1", "0.5")
}

/// Readings of two sensors.
pub(super) fn pairs(seed: i64, count: i64) -> impl Iterator<Item = String> {
    let second = scatter(seed + 1000, count, 2000);
    scatter(seed, count, 2000).zip(second).map(|(a, b)| format!("{} {}", thousandths(a), thousandths(b)))
}
