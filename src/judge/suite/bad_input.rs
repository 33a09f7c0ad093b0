//! What must be refused. Each case has one fault, and its name says which.

use super::basic::velocity;
use super::draft::Draft;
use crate::protocol::{Case, Expect};

pub(super) const READINGS: [&str; 3] = ["1", "2", "3"];

pub(super) fn bad(id: &str, about: &str) -> Draft {
    velocity(id, about, &["bad-input"]).expecting(Expect::Refuse)
}

pub(super) fn cases() -> Vec<Case> {
    [covariances(), numbers(), super::bad_shapes::cases()].concat()
}

/// Covariances that are none.
fn covariances() -> Vec<Case> {
    let pair = |id: &str, about: &str| bad(id, about).observation("1 0; 0 1");
    let pairs = ["1 2", "2 1", "3 0"];
    vec![
        bad("refuse/asymmetric-prior", "the initial covariance is not symmetric")
            .starting("0 0", "10 1; 1.0000001 10")
            .reading(READINGS),
        bad("refuse/indefinite-prior", "the initial covariance is not positive semidefinite (Hilgert and Vila, P₁)")
            .starting("10 30", "80 500; 500 80")
            .reading(READINGS),
        bad("refuse/negative-prior", "an initial variance is negative").starting("0 0", "10 0; 0 -1").reading(READINGS),
        bad("refuse/covariance-without-variance", "a state of variance zero is correlated with another")
            .starting("0 0", "10 1; 1 0")
            .reading(READINGS),
        bad("refuse/asymmetric-process-noise", "the process noise is not symmetric")
            .noise("1 0.5; 0.25 1", "0.5")
            .reading(READINGS),
        bad("refuse/indefinite-process-noise", "the process noise is indefinite, though its diagonal is positive")
            .noise("1 2; 2 1", "0.5")
            .reading(READINGS),
        bad("refuse/negative-process-noise", "a process noise variance is negative")
            .noise("1 0; 0 -0.001", "0.5")
            .reading(READINGS),
        bad("refuse/negative-variance", "the observation noise is negative").noise("1 0; 0 1", "-1").reading(READINGS),
        pair("refuse/one-negative-of-two", "one of two sensors has a negative noise variance")
            .noise("1 0; 0 1", "1 0; 0 -0.5")
            .reading(pairs),
        pair("refuse/indefinite-observation-noise", "the noises of two sensors are more than wholly correlated")
            .noise("1 0; 0 1", "1 1.5; 1.5 1")
            .reading(pairs),
        pair("refuse/asymmetric-observation-noise", "the observation noise is not symmetric")
            .noise("1 0; 0 1", "2 0.5; 0.25 2")
            .reading(pairs),
        Draft::new(
            "refuse/cross-noise-too-large",
            "the joint covariance of the noises is indefinite",
            &["bad-input", "correlated"],
        )
        .expecting(Expect::Refuse)
        .noise("1", "1")
        .cross("1.5")
        .reading(READINGS),
        Draft::new(
            "refuse/cross-noise-without-noise",
            "shared noise where the sensor has none",
            &["bad-input", "correlated"],
        )
        .expecting(Expect::Refuse)
        .noise("1", "0")
        .cross("0.25")
        .reading(READINGS),
        bad("refuse/late-indefinite-noise", "the process noise is indefinite at step 1 only")
            .varying_noise(["1 0; 0 1", "1 2; 2 1", ""], ["0.5"; 3])
            .reading(READINGS),
    ]
}

/// Numbers that are none, or too large.
fn numbers() -> Vec<Case> {
    vec![
        bad("refuse/nan-in-prior", "the initial covariance holds a NaN")
            .starting("0 0", "10 0; 0 NaN")
            .reading(READINGS),
        bad("refuse/infinite-prior", "an initial variance is infinite, where a diffuse start is meant")
            .starting("0 0", "Infinity 0; 0 10")
            .reading(READINGS),
        bad("refuse/nan-in-mean", "the initial mean holds a NaN").starting("0 NaN", "10 0; 0 10").reading(READINGS),
        bad("refuse/nan-in-transition", "the transition holds a NaN").transition("1 NaN; 0 1").reading(READINGS),
        bad("refuse/infinite-transition", "the transition holds an infinity")
            .transition("1 0.1; 0 -Infinity")
            .reading(READINGS),
        bad("refuse/nan-in-observation", "the observation matrix holds a NaN").observation("1 NaN").reading(READINGS),
        bad("refuse/nan-in-process-noise", "the process noise holds a NaN")
            .noise("NaN 0; 0 1", "0.5")
            .reading(READINGS),
        bad("refuse/nan-in-observation-noise", "the observation noise is NaN")
            .noise("1 0; 0 1", "NaN")
            .reading(READINGS),
        bad("refuse/nan-in-input", "an input is NaN").input("0.5; 1", ["1", "NaN", "0"]).reading(READINGS),
        bad("refuse/nan-reading", "a reading is NaN, which is not the same as missing").reading(["1", "NaN", "3"]),
        bad("refuse/infinite-reading", "a reading is infinite").reading(["1", "Infinity", "3"]),
        bad("refuse/overflow", "a reading overflows the doubles").reading(["1", "1e999", "3"]),
        bad("refuse/overflow-of-single", "a reading overflows single precision, which its numbers mean")
            .single()
            .reading(["1", "1e39", "3"]),
        bad("refuse/not-a-number", "a reading is a word").reading(["1", "two", "3"]),
        bad("refuse/decimal-comma", "a reading has a decimal comma").reading(["1", "2,5", "3"]),
    ]
}
