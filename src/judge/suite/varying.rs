//! Matrices that differ from step to step.

use super::basic::velocity;
use super::draft::{Draft, scatter, thousandths};
use crate::protocol::Case;

pub(super) fn cases() -> Vec<Case> {
    // The transition after the last reading has no matrix: nothing depends on it.
    let factors = ["2", "0.5", "-1", "1.5", "0.25", "3", "1", ""];
    let process = ["1", "0.5", "2", "0.1", "1", "4", "0.25", ""];
    let noises = ["1", "2", "0.5", "1", "4", "0.25", "1", "2"];
    let intervals = [100, 250, 50, 1000, 125, 500, 200, 100, 750, 100];
    let moves: Vec<String> = intervals.iter().map(|&dt| format!("1 {}; 0 1", thousandths(dt))).collect();
    let blinking: Vec<&str> = (0..12)
        .map(|k| {
            if k % 3 == 0 {
                "1 0; 0 0"
            } else if k % 3 == 1 {
                "0 0; 0 1"
            } else {
                "1 0; 0 1"
            }
        })
        .collect();
    vec![
        Draft::new("varying/transition", "every transition is another one", &["time-varying"])
            .transitions(factors)
            .varying_noise(process, noises)
            .reading(scatter(21, 8, 3000).map(thousandths)),
        Draft::new(
            "varying/transition-into",
            "as before, but transition k leads into k",
            &["time-varying", "arriving"],
        )
        .arriving()
        .transitions(factors.into_iter().rev())
        .varying_noise(process.into_iter().rev(), noises.into_iter().rev())
        .reading(scatter(21, 8, 3000).map(thousandths)),
        velocity("varying/irregular-sampling", "the time between readings varies", &["time-varying"])
            .transitions(moves)
            .reading(scatter(22, 10, 5000).map(thousandths)),
        Draft::new("varying/blind-sensors", "rows of the observation matrix vanish and come back", &["time-varying"])
            .starting("0 0", "2 0; 0 2")
            .transition("1 0.1; 0 1")
            .observation_matrices(blinking)
            .noise("0.01 0; 0 0.01", "0.5 0; 0 0.5")
            .reading(super::basic::pairs(23, 12)),
    ]
}
