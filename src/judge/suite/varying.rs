//! Matrices that differ from step to step.

use super::basic::velocity;
use super::draft::Draft;
use super::draw::{Draw, thousandths};
use super::table::silenced;
use crate::protocol::Case;

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    [first(draw), more(draw)].concat()
}

fn first(draw: Draw) -> Vec<Case> {
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
            .reading(draw.singles(21, 8, 3000)),
        Draft::new(
            "varying/transition-into",
            "as before, but transition k leads into k",
            &["time-varying", "arriving"],
        )
        .arriving()
        .transitions(factors.into_iter().rev())
        .varying_noise(process.into_iter().rev(), noises.into_iter().rev())
        .reading(draw.singles(21, 8, 3000)),
        velocity("varying/irregular-sampling", "the time between readings varies", &["time-varying"])
            .transitions(moves)
            .reading(draw.singles(22, 10, 5000)),
        Draft::new("varying/blind-sensors", "rows of the observation matrix vanish and come back", &["time-varying"])
            .starting("0 0", "2 0; 0 2")
            .transition("1 0.1; 0 1")
            .observation_matrices(blinking)
            .noise("0.01 0; 0 0.01", "0.5 0; 0 0.5")
            .reading(draw.pairs(23, 12)),
    ]
}

fn more(draw: Draw) -> Vec<Case> {
    let regressors = |number: i64| super::draw::scatter(number, 12, 2000).map(thousandths);
    vec![
        Draft::new("varying/sensor-noise", "only the noise of the sensor varies, by powers of four", &["time-varying"])
            .varying_noise(["0.5"; 10], ["1", "4", "0.25", "16", "0.0625", "1", "64", "1", "0.25", "4"])
            .reading(draw.singles(161, 10, 3000)),
        Draft::new("varying/process-noise", "only the process noise varies, and is zero at times", &["time-varying"])
            .varying_noise(["1", "0", "4", "0", "0", "16", "0.25", "0", "1", ""], ["1"; 10])
            .reading(draw.singles(162, 10, 3000)),
        Draft::new(
            "varying/regressors",
            "a regression whose coefficients drift: the regressors are the rows",
            &["time-varying"],
        )
        .starting("0 0", "4 0; 0 4")
        .transition("1 0; 0 1")
        .noise("0.0625 0; 0 0.125", "0.5")
        .observation_matrices(regressors(163).zip(regressors(164)).map(|(a, b)| format!("{a} {b}")))
        .reading(draw.singles(165, 12, 3000)),
        Draft::new(
            "varying/switching",
            "two regimes by turns, as a chain of Markov would choose them",
            &["time-varying"],
        )
        .starting("0 0", "1 0; 0 1")
        .transitions(
            [0, 0, 1, 1, 1, 0, 1, 0, 0, 0, 1, 2].map(|regime| ["0.75 0.5; -0.5 0.75", "0.5 0; 0.25 1.25", ""][regime]),
        )
        .observation("1 0")
        .noise("0.25 0; 0 0.125", "0.5")
        .reading(draw.singles(166, 12, 2000)),
        Draft::new("varying/everything", "every matrix differs at every step", &["time-varying"])
            .starting("1 -1", "2 1; 1 3")
            .transitions(["1 0.5; 0 1", "0.5 -1; 0.25 1", "2 0; 1 0.5", "0 1; -1 0", "1 1; 0 2", ""])
            .observation_matrices(["1 0", "0 1", "1 1", "1 -1", "2 1", "0.5 0"])
            .varying_noise(
                ["1 0; 0 2", "0.5 0.25; 0.25 0.5", "0 0; 0 1", "3 1; 1 1", "0.25 0; 0 0", ""],
                ["1", "0.5", "2", "0.25", "4", "1"],
            )
            .reading(draw.singles(167, 6, 3000)),
        Draft::new(
            "varying/two-sensors",
            "two sensors whose matrix and noise vary, one silent at times",
            &["time-varying"],
        )
        .starting("0 0", "2 0; 0 2")
        .transition("0.75 0.25; 0 0.5")
        .observation_matrices(["1 0; 0 1", "1 1; 0 1", "2 0; 1 1", "0 1; 1 0", "1 -1; 1 1", "1 0; 0 2"])
        .varying_noise(
            ["0.5 0; 0 0.25"; 6],
            ["1 0.5; 0.5 1", "2 0; 0 1", "0.5 0.25; 0.25 2", "1 0; 0 4", "1 -0.5; -0.5 1", "3 1; 1 1"],
        )
        .reading(silenced(draw.pairs(168, 6), |k, i| k == 2 && i == 1 || k == 4 && i == 0)),
        Draft::new("varying/singular-transition", "some transitions forget a state", &["time-varying"])
            .starting("1 2", "2 1; 1 2")
            .transitions(["1 0; 0 0", "1 1; 0 1", "0 0; 0 0", "1 0.5; 0 1", "1 1; 1 1", ""])
            .observation("1 1")
            .noise("0.5 0; 0 0.25", "1")
            .reading(draw.singles(169, 6, 3000)),
        velocity(
            "varying/changing-interval-and-noise",
            "process noise that fits each sampling interval",
            &["time-varying"],
        )
        .transitions(["1 0.5; 0 1", "1 2; 0 1", "1 0.125; 0 1", "1 4; 0 1", "1 0.25; 0 1", "1 1; 0 1", ""])
        .varying_noise(
            [
                "0.046875 0.125; 0.125 0.5",
                "3 2; 2 2",
                "0.000732421875 0.0078125; 0.0078125 0.125",
                "24 8; 8 4",
                "0.005859375 0.03125; 0.03125 0.25",
                "0.375 0.5; 0.5 1",
                "",
            ],
            ["1"; 7],
        )
        .reading(draw.singles(170, 7, 5000)),
    ]
}
