//! Noise shared between state and observation, in both timings, and starts before a transition.

use super::draft::Draft;
use super::draw::Draw;
use crate::protocol::Case;

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    [first(draw), more(draw)].concat()
}

fn first(draw: Draw) -> Vec<Case> {
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
    let readings = || draw.singles(41, 15, 2000);
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
            .reading(draw.pairs(42, 10)),
        factors("correlated/factors-arriving", "D w and F w with a common w, arriving", &["correlated", "arriving"])
            .arriving()
            .reading(draw.pairs(42, 10)),
        factors(
            "correlated/before-transition",
            "the initial law is that of the state before the first transition",
            &["correlated", "arriving", "before-transition"],
        )
        .arriving()
        .before_transition()
        .reading(draw.pairs(43, 10)),
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
    ]
}

fn more(draw: Draw) -> Vec<Case> {
    let wide = |id: &str, about: &str| {
        Draft::new(id, about, &["correlated"])
            .starting("1 0 -1", "2 0.5 0; 0.5 1 0; 0 0 1")
            .transition("0.5 0.5 0; 0 0.75 0.25; -0.25 0 0.5")
            .observation("1 0 0; 0 1 1")
            .noise("1 0.25 0; 0.25 1 0; 0 0 1", "1 0.25; 0.25 0.75")
            .cross("0.5 0; -0.25 0.25; 0 0.5")
    };
    let scalar = |id: &str, about: &str| Draft::new(id, about, &["correlated"]).transition("0.75");
    vec![
        wide("correlated/three-states-departing", "a cross term of three rows and two columns, departing")
            .reading(draw.pairs(211, 8)),
        wide("correlated/three-states-arriving", "the same numbers, arriving").arriving().reading(draw.pairs(211, 8)),
        scalar("correlated/negative", "a negative correlation")
            .noise("1", "0.5")
            .cross("-0.5")
            .reading(draw.singles(212, 12, 2000)),
        scalar("correlated/strong", "a correlation of 63/64")
            .noise("1", "1")
            .cross("0.984375")
            .reading(draw.singles(213, 12, 2000)),
        Draft::new("correlated/whole", "one noise drives the state and the sensor: correlation one", &["correlated"])
            .transition("0.5")
            .factors("1", "0.5")
            .reading(draw.singles(214, 10, 2000)),
        Draft::new(
            "correlated/whole-arriving",
            "the same, shared with the transition that arrives",
            &["correlated", "ill-conditioned"],
        )
        .arriving()
        .transition("0.5")
        .factors("1", "0.5")
        .reading(draw.singles(214, 10, 2000)),
        scalar("correlated/at-one-step", "only the noise of step 2 is shared")
            .noise("1", "0.5")
            .crosses(["0", "0", "0.5", "0", "0", "0"])
            .reading(draw.singles(215, 6, 2000)),
        scalar(
            "correlated/with-input",
            "the correction by shared noise uses the innovation, from which the offset is taken",
        )
        .noise("1", "0.5")
        .cross("0.5")
        .constant_input("1", "3")
        .observation_input("-4")
        .reading(draw.scatter(216, 8, 2000).map(|value| super::draw::thousandths(value - 4000))),
        scalar("correlated/start-before-transition", "arriving, with a start before the transition")
            .noise("1", "0.5")
            .cross("0.5")
            .arriving()
            .before_transition()
            .reading(draw.singles(217, 8, 2000)),
        Draft::new(
            "correlated/moving-average",
            "an autoregression with moving average: the sensor's noise is the state's",
            &["correlated", "ill-conditioned"],
        )
        .starting("0", "1")
        .transition("0.75")
        .factors("1.25", "1")
        .reading(draw.singles(218, 12, 2000)),
    ]
}
