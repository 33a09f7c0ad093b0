//! What must be refused. Each case has one fault, and its name says which.

use super::basic::velocity;
use super::draft::Draft;
use crate::protocol::{Case, Expect};

pub(super) fn cases() -> Vec<Case> {
    let bad = |id: &str, about: &str| velocity(id, about, &["bad-input"]).expecting(Expect::Refuse);
    let readings = ["1", "2", "3"];
    vec![
        bad("refuse/asymmetric-prior", "the initial covariance is not symmetric")
            .starting("0 0", "10 1; 1.0000001 10")
            .reading(readings),
        bad("refuse/indefinite-prior", "the initial covariance is not positive semidefinite (Hilgert and Vila, P₁)")
            .starting("10 30", "80 500; 500 80")
            .reading(readings),
        bad("refuse/nan-in-prior", "the initial covariance holds a NaN")
            .starting("0 0", "10 0; 0 NaN")
            .reading(readings),
        bad("refuse/asymmetric-process-noise", "the process noise is not symmetric")
            .noise("1 0.5; 0.25 1", "0.5")
            .reading(readings),
        bad("refuse/negative-variance", "the observation noise is negative").noise("1 0; 0 1", "-1").reading(readings),
        Draft::new(
            "refuse/cross-noise-too-large",
            "the joint covariance of the noises is indefinite",
            &["bad-input", "correlated"],
        )
        .expecting(Expect::Refuse)
        .noise("1", "1")
        .cross("1.5")
        .reading(readings),
        bad("refuse/nan-reading", "a reading is NaN, which is not the same as missing").reading(["1", "NaN", "3"]),
        bad("refuse/infinite-reading", "a reading is infinite").reading(["1", "Infinity", "3"]),
        bad("refuse/overflow", "a reading overflows the doubles").reading(["1", "1e999", "3"]),
        bad("refuse/observation-too-wide", "the observation matrix has three columns for two states")
            .observation("1 0 0")
            .reading(readings),
        bad("refuse/ragged-transition", "the rows of the transition differ in length")
            .transition("1 0.1; 1")
            .reading(readings),
        bad("refuse/one-matrix-too-few", "three readings, but only two observation matrices")
            .observation_matrices(["1 0", "0 1"])
            .reading(readings),
    ]
}
