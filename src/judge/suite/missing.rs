//! Missing readings.

use super::basic::velocity;
use super::draft::Draft;
use super::draw::Draw;
use super::table::{gaps, silenced};
use crate::protocol::Case;

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    [first(draw), more(draw)].concat()
}

fn first(draw: Draw) -> Vec<Case> {
    let halves = |readings: Vec<String>| silenced(readings, |k, i| k % 4 == i + 1);
    vec![
        velocity("missing/whole-steps", "some steps have no reading at all", &["missing"])
            .reading(gaps(draw.singles(11, 20, 5000), &[3, 4, 5, 9, 19])),
        velocity("missing/first-reading", "the first steps have no reading", &["missing"])
            .reading(gaps(draw.singles(12, 12, 5000), &[0, 1, 2])),
        Draft::new("missing/one-of-two-sensors", "now one, now the other of two sensors is silent", &["missing"])
            .starting("0 0", "3 1; 1 2")
            .transition("0.95 0.1; 0 0.9")
            .observation("1 0.5; 0 1")
            .noise("0.2 0.05; 0.05 0.1", "0.4 0.1; 0.1 0.3")
            .reading(halves(draw.pairs(13, 16).collect())),
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
        .reading(halves(draw.pairs(14, 12).collect())),
    ]
}

fn more(draw: Draw) -> Vec<Case> {
    let pair = |id: &str, about: &str| {
        Draft::new(id, about, &["missing"])
            .starting("1 0", "3 1; 1 2")
            .transition("0.9 0.25; 0 0.75")
            .observation("1 0; 1 1")
            .noise("0.25 0.1; 0.1 0.5", "0.5 0.25; 0.25 1")
    };
    vec![
        Draft::new("missing/all", "no reading at all: the answer is the prior, carried on", &["missing", "ahead"])
            .starting("2 1", "3 1; 1 2")
            .transition("0.5 0.25; 0 0.75")
            .observation("1 0")
            .noise("0.25 0; 0 0.5", "1")
            .reading([""; 6]),
        Draft::new("missing/last-readings", "the last steps have no reading", &["missing"])
            .starting("0", "2")
            .noise("0.25", "0.5")
            .reading(gaps(draw.singles(121, 12, 3000), &[9, 10, 11])),
        velocity("missing/long-gap", "ten steps in a row without a reading", &["missing"])
            .reading(gaps(draw.singles(122, 20, 5000), &[5, 6, 7, 8, 9, 10, 11, 12, 13, 14])),
        velocity("missing/every-other", "every second reading is missing", &["missing"])
            .reading(gaps(draw.singles(123, 16, 5000), &[1, 3, 5, 7, 9, 11, 13, 15])),
        pair("missing/first-in-part", "one sensor begins late")
            .reading(silenced(draw.pairs(124, 10), |k, i| k < 4 && i == 1)),
        pair("missing/last-in-part", "one sensor falls silent for good")
            .reading(silenced(draw.pairs(125, 10), |k, i| k > 5 && i == 0)),
        pair("missing/in-turn", "the sensors take turns, so none is ever read beside the other")
            .reading(silenced(draw.pairs(126, 12), |k, i| k % 2 == i)),
        pair("missing/null-entries", "at some steps each entry is null, which is the same as no reading")
            .reading(silenced(draw.pairs(127, 8), |k, _| k == 0 || k == 3)),
        Draft::new(
            "missing/two-of-three",
            "three sensors with full noise, of which now these, now those are silent",
            &["missing"],
        )
        .starting("0 0", "2 0.5; 0.5 2")
        .transition("0.75 0.25; -0.25 0.75")
        .observation("1 0; 0 1; 1 -1")
        .noise("0.5 0; 0 0.25", "1 0.5 0.25; 0.5 1 0.5; 0.25 0.5 1")
        .reading(silenced(draw.several(3, 128, 12, 2000), |k, i| (k * (i + 2)) % 5 < 2)),
        Draft::new(
            "missing/varying-noise",
            "gaps where the noises vary: a noise belongs to its step, not to its reading",
            &["missing"],
        )
        .varying_noise(["1", "0.5", "2", "0.125", "4", "0.25", "1", ""], ["1", "2", "0.5", "3", "0.25", "4", "1", "2"])
        .reading(gaps(draw.singles(129, 8, 3000), &[0, 3, 4])),
        Draft::new("missing/with-input", "the input goes on while the reading is missing", &["missing"])
            .starting("0", "2")
            .transition("0.75")
            .noise("0.5", "1")
            .input("2", ["1", "-1", "0.5", "3", "0", "-2", "1", "4", "1", "1"])
            .reading(gaps(draw.singles(130, 10, 3000), &[2, 3, 7])),
        Draft::new(
            "missing/correlated-arriving",
            "a silent sensor whose noise is correlated with the transition that led here",
            &["missing"],
        )
        .arriving()
        .starting("0 0", "3 1; 1 2")
        .transition("0.95 0.1; 0 0.9")
        .observation("1 0.5; 0 1")
        .noise("0.4 0.05; 0.05 0.3", "0.4 0.1; 0.1 0.3")
        .cross("0.1 0.05; -0.1 0.1")
        .reading(silenced(draw.pairs(131, 10), |k, i| k % 3 == 1 || k % 3 == 2 && i == 0)),
        Draft::new("missing/whole-correlated", "whole steps without a reading, with correlated noise", &["missing"])
            .transition("0.75")
            .noise("1", "0.5")
            .cross("0.5")
            .reading(gaps(draw.singles(132, 12, 2000), &[0, 4, 5, 11])),
    ]
}
