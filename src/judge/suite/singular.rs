//! Innovations whose covariance is singular, with data that fit (and two with data that cannot be).

use super::draft::Draft;
use super::draw::Draw;
use crate::protocol::{Case, Expect};

/// Readings that fit are the same with every seed.
pub(super) fn cases(_: Draw) -> Vec<Case> {
    [sensors(), states(), varying()].concat()
}

fn sensors() -> Vec<Case> {
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
        Draft::new("singular/opposite-sensors", "one sensor reads minus what the other reads", &["singular"])
            .starting("1", "2")
            .transition("0.5")
            .observation("1; -1")
            .noise("0.5", "0 0; 0 0")
            .reading(["2 -2", "0.5 -0.5", "1.25 -1.25"]),
        Draft::new("singular/equal-beside-noisy", "two equal sensors without noise beside a noisy one", &["singular"])
            .starting("0 0", "2 1; 1 2")
            .transition("1 0.5; 0 1")
            .observation("1 0; 1 0; 0 1")
            .noise("1 0; 0 1", "0 0 0; 0 0 0; 0 0 1")
            .reading(["1 1 0.5", "2 2 -1", "1.5 1.5 0"]),
        Draft::new("singular/equal-noise", "two sensors with one noise of variance 2 between them", &["singular"])
            .starting("0", "1")
            .observation("1; 1")
            .noise("1", "2 2; 2 2")
            .reading(["1 1", "0.5 0.5", "3 3"]),
        Draft::new("singular/proportional-noise", "the second sensor is twice the first, noise and all", &["singular"])
            .starting("0 1", "1 0; 0 1")
            .transition("1 0.5; 0 1")
            .observation("1 0; 2 0")
            .noise("0.5 0; 0 0.25", "1 2; 2 4")
            .reading(["1 2", "1.5 3", "-0.5 -1"]),
        Draft::new("singular/three-of-one", "three sensors of one state, without noise", &["singular"])
            .starting("0", "4")
            .transition("0.5")
            .observation("1; 2; -0.5")
            .noise("1", "0 0 0; 0 0 0; 0 0 0")
            .reading(["2 4 -1", "1 2 -0.5", "-4 -8 2"]),
        Draft::new("singular/average", "the third sensor reads the mean of the others, noise and all", &["singular"])
            .starting("0 0", "1 0.5; 0.5 1")
            .transition("0.5 0; 0.25 0.5")
            .observation("1 0; 0 1; 0.5 0.5")
            .noise("0.5 0; 0 0.5", "2 0 1; 0 2 1; 1 1 1")
            .reading(["1 3 2", "0 -2 -1", "0.5 1 0.75"]),
        Draft::new("singular/all-blind", "no sensor sees anything, and none has noise", &["singular"])
            .starting("1 2", "1 0; 0 1")
            .transition("0.5 0; 0 0.5")
            .observation("0 0; 0 0")
            .noise("1 0; 0 1", "0 0; 0 0")
            .reading(["0 0", "0 0", "0 0"]),
        Draft::new(
            "singular/difference-of-equal-states",
            "two states that are always equal, and their difference is read",
            &["singular"],
        )
        .starting("1 1", "2 2; 2 2")
        .transition("0.5 0; 0 0.5")
        .observation("1 -1; 1 0")
        .noise("1 1; 1 1", "0 0; 0 0.5")
        .reading(["0 2", "0 1", "0 -0.5"]),
    ]
}

/// Nothing is left to learn of what is read.
fn states() -> Vec<Case> {
    vec![
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
        Draft::new("singular/known-velocity", "two exact readings tell position and velocity for ever", &["singular"])
            .starting("0 0", "4 0; 0 4")
            .transition("1 0.5; 0 1")
            .observation("1 0")
            .noise("0 0; 0 0", "0")
            .reading(["1", "1.5", "2", "2.5", "3"]),
        Draft::new(
            "singular/forgotten-state",
            "a transition of zero without noise: the next state is known",
            &["singular"],
        )
        .starting("3", "2")
        .transitions(["1", "0", "1", ""])
        .varying_noise(["1", "0", "1", ""], ["1", "1", "0", "1"])
        .reading(["2", "4", "0", "1"]),
        Draft::new(
            "singular/noise-cancels-arriving",
            "F = -C D, and the state before is known: y_k is known, too",
            &["singular", "correlated"],
        )
        .arriving()
        .starting("1", "0")
        .transition("0.5")
        .factors("1", "-1")
        .reading(["", "0.5", "0.25"]),
    ]
}

/// Singular at some steps only.
fn varying() -> Vec<Case> {
    vec![
        Draft::new("singular/from-step-two", "two sensors lose their noise at step 2", &["singular"])
            .starting("0", "1")
            .observation("1; 1")
            .varying_noise(["1"; 5], ["1 0; 0 1", "0.5 0; 0 2", "0 0; 0 0", "0 0; 0 0", "0 0; 0 0"])
            .reading(["1 0", "0.5 2", "1.5 1.5", "1 1", "2 2"]),
        Draft::new(
            "singular/at-one-step",
            "only at step 1 both sensors read the same state without noise",
            &["singular"],
        )
        .starting("0 0", "2 1; 1 2")
        .transition("1 0.5; 0 1")
        .observation_matrices(["1 0; 0 1", "1 0; 1 0", "1 1; 0 1", "1 0; 0 1"])
        .noise("1 0; 0 1", "0 0; 0 0")
        .reading(["1 2", "1.5 1.5", "4 1", "2 3"]),
        Draft::new(
            "singular/with-a-gap",
            "two equal sensors, one silent at times: then nothing is singular",
            &["singular"],
        )
        .starting("0", "1")
        .observation("1; 1")
        .noise("1", "0 0; 0 0")
        .reading(["1 1", "- 2", "0.5 -", "", "1.5 1.5"]),
        Draft::new("singular/with-input", "two sensors with different offsets and no noise", &["singular"])
            .starting("0", "1")
            .observation("1; 2")
            .noise("0.5", "0 0; 0 0")
            .observation_input("3 -1")
            .reading(["4 1", "5 3", "2 -3"]),
        Draft::new(
            "singular/correlated",
            "two equal sensors without noise of their own, whose noise is the state's",
            &["singular", "correlated"],
        )
        .starting("0", "1")
        .transition("0.5")
        .observation("1; 1")
        .factors("1 0.5", "1 0; 1 0")
        .reading(["1 1", "0.5 0.5", "-1 -1"]),
        Draft::new(
            "singular/diffuse",
            "two equal sensors without noise, of a state of which nothing is known",
            &["singular"],
        )
        .starting("0", "0")
        .diffuse("1")
        .observation("1; 1")
        .noise("1", "0 0; 0 0")
        .reading(["5 5", "4 4", "6 6"]),
    ]
}
