//! Noise shared between state and observation, in both timings, and starts before a transition.

use super::basic::pairs;
use super::draft::{Draft, scatter, thousandths};
use crate::protocol::Case;

pub(super) fn cases() -> Vec<Case> {
    let scalar = |id: &str, about: &str, flags: &[&str]| {
        Draft::new(id, about, flags).starting("0", "1").transition("0.8").noise("1", "0.5").cross("0.4")
    };
    let factors = |id: &str, about: &str, flags: &[&str]| {
        Draft::new(id, about, flags)
            .starting("1 0", "1 0.5; 0.5 2")
            .transition("0.9 0.2; -0.1 0.7")
            .observation("1 0; 0.5 1")
            .factors("1 0.5 0; 0.2 0 1", "0.5 0 0.5; 0.25 1 0")
    };
    let readings = || scatter(41, 15, 2000).map(thousandths);
    vec![
        scalar(
            "correlated/departing",
            "the noise of y_k is correlated with that of the transition out of k",
            &["correlated"],
        )
        .reading(readings()),
        scalar(
            "correlated/arriving",
            "the same numbers, but the correlation is with the transition into k: another model",
            &["correlated", "arriving"],
        )
        .arriving()
        .reading(readings()),
        factors("correlated/factors-departing", "D w and F w with a common w, departing", &["correlated"])
            .reading(pairs(42, 10)),
        factors("correlated/factors-arriving", "D w and F w with a common w, arriving", &["correlated", "arriving"])
            .arriving()
            .reading(pairs(42, 10)),
        factors(
            "correlated/before-transition",
            "the initial law is that of the state before the first transition",
            &["correlated", "arriving", "before-transition"],
        )
        .arriving()
        .before_transition()
        .reading(pairs(43, 10)),
        Draft::new(
            "correlated/noise-cancels",
            "F = -C D: the noise of the transition into k cancels in y_k",
            &["correlated", "arriving"],
        )
        .arriving()
        .starting("0 0", "1 0; 0 1")
        .transition("1 1; 0 1")
        .observation("1 0")
        .factors("0.5 0; 0 0.25", "-0.5 0")
        .reading(["0.5", "1.25", "1.75", "2.5"]),
        Draft::new(
            "arriving/start-before-transition",
            "a random walk whose initial law is one step older",
            &["arriving", "before-transition"],
        )
        .arriving()
        .before_transition()
        .transition("0.5")
        .noise("2", "1")
        .reading(scatter(44, 8, 2000).map(thousandths)),
    ]
}
