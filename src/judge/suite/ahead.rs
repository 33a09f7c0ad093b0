//! Prediction: what is known of steps that have no reading.

use super::basic::velocity;
use super::draft::Draft;
use super::draw::Draw;
use super::table::{and_ahead, gaps, silenced};
use crate::protocol::Case;

const FLAGS: [&str; 2] = ["ahead", "missing"];

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    vec![
        Draft::new("ahead/random-walk", "ten readings of a random walk, then six steps ahead", &FLAGS)
            .starting("0", "4")
            .noise("0.5", "1")
            .reading(and_ahead(draw.singles(151, 10, 3000), 6)),
        velocity("ahead/constant-velocity", "eight readings, then twelve steps ahead", &FLAGS)
            .reading(and_ahead(draw.singles(152, 8, 5000), 12)),
        Draft::new("ahead/oscillator", "the prediction turns with the state, and so does its covariance", &FLAGS)
            .starting("1 0", "1 0; 0 2")
            .transition("0.75 0.5; -0.5 0.75")
            .observation("1 0")
            .noise("0.125 0; 0 0.5", "0.25")
            .reading(and_ahead(draw.singles(153, 8, 2000), 8)),
        Draft::new("ahead/with-input", "the inputs of the steps ahead are known", &FLAGS)
            .starting("0", "2")
            .transition("0.75")
            .noise("0.5", "1")
            .input("1", ["1", "0", "-1", "2", "0", "4", "0", "-8", "1", "0"])
            .reading(and_ahead(draw.singles(154, 5, 2000), 5)),
        Draft::new("ahead/time-varying", "each step ahead has a transition and a noise of its own", &FLAGS)
            .transitions(["2", "0.5", "-1", "1.5", "0.25", "3", "-0.5", "1", "2", ""])
            .varying_noise(
                ["1", "0.5", "2", "0.125", "1", "4", "0.25", "8", "1", ""],
                ["1", "2", "0.5", "1", "4", "0.25", "1", "2", "1", "0.5"],
            )
            .reading(and_ahead(draw.singles(155, 5, 3000), 5)),
        velocity("ahead/with-gaps", "gaps among the readings, then five steps ahead", &FLAGS)
            .reading(and_ahead(gaps(draw.singles(156, 12, 5000), &[2, 3, 8]), 5)),
        Draft::new("ahead/two-sensors", "two sensors, one of them silent at times, then five steps ahead", &FLAGS)
            .starting("0 1", "3 1; 1 2")
            .transition("0.9 0.25; 0 0.75")
            .observation("1 0; 1 1")
            .noise("0.25 0.1; 0.1 0.5", "0.5 0.25; 0.25 1")
            .reading(and_ahead(silenced(draw.pairs(157, 8), |k, i| k % 3 == i), 5)),
        Draft::new("ahead/correlated", "noise shared with the last reading is part of the first step ahead", &FLAGS)
            .transition("0.75")
            .noise("1", "0.5")
            .cross("0.5")
            .reading(and_ahead(draw.singles(158, 6, 2000), 5)),
        Draft::new("ahead/arriving", "transition k leads into k: five steps ahead", &FLAGS)
            .arriving()
            .transitions(["", "0.5", "-1", "1.5", "0.25", "3", "-0.5", "1", "2", "0.75"])
            .noise("0.5", "1")
            .reading(and_ahead(draw.singles(159, 5, 3000), 5)),
        Draft::new("ahead/unstable", "a mode that doubles, twenty steps ahead", &["ahead", "missing", "unstable"])
            .transition("2")
            .noise("0.125", "1")
            .reading(and_ahead(draw.singles(160, 5, 3000), 20)),
    ]
}
