//! Shapes and lengths that do not fit.

use super::bad_input::{READINGS, bad};
use super::draft::Draft;
use crate::protocol::{Case, Expect};

pub(super) fn cases() -> Vec<Case> {
    vec![
        bad("refuse/observation-too-wide", "the observation matrix has three columns for two states")
            .observation("1 0 0")
            .reading(READINGS),
        bad("refuse/ragged-transition", "the rows of the transition differ in length")
            .transition("1 0.1; 1")
            .reading(READINGS),
        bad("refuse/transition-not-square", "the transition has two rows and three columns")
            .transition("1 0.1 0; 0 1 0")
            .reading(READINGS),
        bad("refuse/mean-too-long", "the initial mean has three entries for two states")
            .starting("0 0 0", "10 0; 0 10")
            .reading(READINGS),
        bad("refuse/prior-too-small", "the initial covariance has one state of two")
            .starting("0 0", "10")
            .reading(READINGS),
        bad("refuse/process-noise-too-small", "the process noise has one state of two")
            .noise("1", "0.5")
            .reading(READINGS),
        bad("refuse/observation-noise-too-large", "the observation noise has two sensors where one is read")
            .noise("1 0; 0 1", "0.5 0; 0 0.5")
            .reading(READINGS),
        Draft::new("refuse/cross-noise-transposed", "the cross covariance stands on its side", &["bad-input"])
            .expecting(Expect::Refuse)
            .starting("0 0", "1 0; 0 1")
            .transition("1 0; 0 1")
            .observation("1 0")
            .noise("1 0; 0 1", "1")
            .cross("0.25 0.25")
            .reading(READINGS),
        bad("refuse/too-many-readings", "step 1 has two readings where one sensor is").reading(["1", "2 2", "3"]),
        bad("refuse/rows-without-sensor", "the observation matrix has two rows where one sensor is read")
            .observation("1 0; 0 1")
            .reading(READINGS),
        bad("refuse/input-too-short", "an input vector has one entry where its matrix has two columns")
            .input("0.5 0; 1 1", ["1 1", "1", "0 1"])
            .reading(READINGS),
        bad("refuse/one-matrix-too-few", "three readings, but only two observation matrices")
            .observation_matrices(["1 0", "0 1"])
            .reading(READINGS),
        bad("refuse/one-noise-too-many", "three readings, but four observation noises")
            .varying_noise(["1 0; 0 1"; 3], ["1", "1", "1", "1"])
            .reading(READINGS),
        bad("refuse/matrix-left-out", "a transition that an observation depends on is null")
            .transitions(["1 0.1; 0 1", "", "1 0.1; 0 1"])
            .reading(READINGS),
        Draft::new("refuse/no-state", "the initial mean is empty: there is no state", &["bad-input"])
            .expecting(Expect::Refuse)
            .starting("", "1")
            .reading(READINGS),
        bad("refuse/no-reading", "there is no observation at all").reading([""; 0]),
        bad("refuse/before-transition-departing", "departing transitions have none before the first observation")
            .before_transition()
            .reading(READINGS),
        bad("refuse/diffuse-indefinite", "the diffuse part of the initial covariance is indefinite")
            .diffuse("1 2; 2 1")
            .reading(READINGS),
    ]
}
