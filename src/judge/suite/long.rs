//! Many steps.

use super::draft::Draft;
use super::draw::Draw;
use super::table::gaps;
use crate::protocol::Case;

const FLAGS: [&str; 1] = ["long"];

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    let whole = |number: i64, count: i64| draw.scatter(number, count, 9).map(|value| value.to_string());
    vec![
        Draft::new("long/constant", "a constant read five hundred times: the variance is 1/(k + 2)", &FLAGS)
            .reading(whole(291, 500)),
        Draft::new("long/random-walk", "a random walk of eight hundred steps", &FLAGS)
            .noise("1", "2")
            .reading(whole(292, 800)),
        Draft::new("long/nearly-constant", "three hundred steps of a random walk that hardly moves", &FLAGS)
            .noise("0.0009765625", "1")
            .reading(whole(293, 300)),
        Draft::new("long/every-third-missing", "five hundred steps, of which every third has no reading", &FLAGS)
            .noise("1", "4")
            .reading(gaps(whole(294, 500), &(0..500).step_by(3).collect::<Vec<_>>())),
        Draft::new("long/trend", "a line through a hundred and fifty readings, without process noise", &FLAGS)
            .starting("0 0", "64 0; 0 64")
            .transition("1 1; 0 1")
            .observation("1 0")
            .noise("0 0; 0 0", "1")
            .reading(whole(295, 150)),
        Draft::new("long/velocity", "position and velocity, a hundred and twenty steps", &FLAGS)
            .starting("0 0", "1 0; 0 1")
            .transition("1 0.5; 0 1")
            .observation("1 0")
            .noise("0 0; 0 0.25", "1")
            .reading(whole(296, 120)),
        Draft::new("long/regression", "a regression on a square wave of a hundred and twenty steps", &FLAGS)
            .starting("0 0", "4 0; 0 4")
            .transition("1 0; 0 1")
            .observation_matrices((0..120).map(|k| if k % 10 < 5 { "1 1" } else { "1 -1" }))
            .noise("0 0; 0 0", "1")
            .reading(whole(297, 120)),
        Draft::new("long/two-sensors", "a random walk read by two sensors, a hundred and fifty steps", &FLAGS)
            .observation("1; 1")
            .noise("1", "1 0; 0 2")
            .reading(whole(298, 150).zip(whole(299, 150)).map(|(a, b)| format!("{a} {b}"))),
        Draft::new("long/periodic", "three hundred steps of a sensor that is good and poor by turns", &FLAGS)
            .varying_noise(["1"; 300], (0..300).map(|k| if k % 2 == 0 { "1" } else { "16" }))
            .reading(whole(300, 300)),
        Draft::new("long/thousands-of-a-walk", "a random walk of four thousand steps that hardly moves", &FLAGS)
            .noise("0.0009765625", "1")
            .reading(whole(331, 4000)),
        Draft::new("long/thousands-of-a-radar", "position and velocity, two thousand steps, with decimal data", &FLAGS)
            .starting("0 0", "100 0; 0 4")
            .transition("1 0.1; 0 1")
            .observation("1 0")
            .noise("0.000003 0.00005; 0.00005 0.001", "0.25")
            .reading(whole(332, 2000)),
    ]
}
