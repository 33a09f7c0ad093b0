//! Numbers that tell conventions apart: start, timing, index, order of a product, variance and deviation.

use super::draft::Draft;
use super::draw::Draw;
use crate::protocol::Case;

const FLAGS: [&str; 1] = ["convention"];

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    [starts(draw), indices(draw), orders(draw)].concat()
}

/// The same numbers, begun at two places.
fn starts(draw: Draw) -> Vec<Case> {
    let start = |id: &str, about: &str| {
        Draft::new(id, about, &FLAGS)
            .starting("4 -1", "1 0.25; 0.25 2")
            .transition("0.5 1; 0 0.75")
            .observation("1 0")
            .noise("2 0.5; 0.5 1", "0.5")
    };
    vec![
        start("conventions/start-at-the-reading", "the initial law is that of the state that is read first")
            .reading(draw.singles(181, 6, 3000)),
        start(
            "conventions/start-before-the-transition",
            "the initial law is one transition older than the first reading",
        )
        .arriving()
        .before_transition()
        .reading(draw.singles(181, 6, 3000)),
        start(
            "conventions/first-reading-counts",
            "a sharp first reading of a vague state: to skip it, or use it twice, shows",
        )
        .starting("0 0", "100 0; 0 1")
        .reading(draw.singles(182, 5, 3000)),
        start("conventions/one-step", "one reading and nothing else: no transition is needed at all")
            .reading(draw.singles(183, 1, 3000)),
    ]
}

/// Everything differs from step to step, so each shifted index shows.
fn indices(draw: Draw) -> Vec<Case> {
    let transitions = ["0.5 1; 0 0.75", "2 0; 1 0.25", "1 -1; 0.5 0", "0.25 3; -1 1", "1 0.5; 0 1.5", "0.125 1; 1 0"];
    let observations = ["1 0", "0.5 1", "2 -1", "0 1", "3 0.5", "1 1"];
    let process = ["1 0; 0 2", "3 1; 1 1", "0.5 0; 0 0.25", "4 -1; -1 2", "1 0.5; 0.5 1", "2 0; 0 8"];
    let noises = ["1", "0.25", "4", "2", "0.5", "8"];
    let inputs = ["1", "-2", "4", "0.5", "-8", "16"];
    let all = |id: &str, about: &str| {
        Draft::new(id, about, &FLAGS)
            .starting("1 2", "2 0.5; 0.5 1")
            .transitions(transitions)
            .observation_matrices(observations)
            .varying_noise(process, noises)
            .input("1; -1", inputs)
            .feed_through("2", inputs.into_iter().rev())
    };
    vec![
        all("conventions/every-index-departing", "everything varies; transition k leads out of k")
            .reading(draw.singles(184, 6, 3000)),
        all(
            "conventions/every-index-arriving",
            "the same numbers; transition k leads into k, and number 0 is not used",
        )
        .arriving()
        .reading(draw.singles(184, 6, 3000)),
        all("conventions/every-index-before", "the same numbers; the start comes before transition 0")
            .arriving()
            .before_transition()
            .reading(draw.singles(184, 6, 3000)),
        all("conventions/every-cross-departing", "the noise shared by transition k and reading k varies, too")
            .crosses(["0.5; 0", "0; 0.25", "1; -0.5", "-1; 1", "0.5; 0.25", "2; 1"])
            .reading(draw.singles(185, 6, 3000)),
        all("conventions/every-cross-arriving", "the same numbers, shared with the transition into k")
            .crosses(["0.5; 0", "0; 0.25", "1; -0.5", "-1; 1", "0.5; 0.25", "2; 1"])
            .arriving()
            .reading(draw.singles(185, 6, 3000)),
    ]
}

/// Matrices that are far from symmetric, and numbers far from one.
fn orders(draw: Draw) -> Vec<Case> {
    vec![
        Draft::new(
            "conventions/transposed-transition",
            "a transition far from symmetric: transposed, it is another model",
            &FLAGS,
        )
        .starting("1 0 -1", "1 0 0; 0 2 0; 0 0 3")
        .transition("0.5 2 0; 0 0.5 1; 0.25 0 0.5")
        .observation("1 0 0")
        .noise("0.25 0 0; 0 0.5 0; 0 0 1", "1")
        .reading(draw.singles(186, 8, 3000)),
        Draft::new(
            "conventions/transposed-observation",
            "as many sensors as states, and a matrix far from symmetric",
            &FLAGS,
        )
        .starting("1 -1", "2 0.5; 0.5 1")
        .transition("0.75 0; 0.5 0.5")
        .observation("1 4; 0 1")
        .noise("0.5 0; 0 0.25", "1 0; 0 0.25")
        .reading(draw.pairs(187, 8)),
        Draft::new(
            "conventions/order-of-sensors",
            "three sensors of two states, and noises in another order than the rows",
            &FLAGS,
        )
        .starting("0 0", "4 0; 0 1")
        .transition("0.5 0.5; 0 0.5")
        .observation("2 1; 0 1; 1 -3")
        .noise("1 0; 0 1", "0.25 0 0.5; 0 4 0; 0.5 0 2")
        .reading(draw.several(3, 188, 6, 3000)),
        Draft::new(
            "conventions/variance-not-deviation",
            "variances 9, 16 and 25: their roots are other numbers",
            &FLAGS,
        )
        .starting("0", "25")
        .noise("9", "16")
        .reading(draw.singles(189, 8, 9000)),
        Draft::new(
            "conventions/row-order",
            "full covariances with negative entries: reading them by columns shows nothing, by blocks does",
            &FLAGS,
        )
        .starting("1 2 3", "4 -1 0.5; -1 3 -0.25; 0.5 -0.25 2")
        .transition("0 1 0; 0 0 1; 0.25 -0.5 0.75")
        .observation("1 2 3; -1 0 0.5")
        .noise("1 -0.5 0.25; -0.5 2 0; 0.25 0 0.5", "1 -0.75; -0.75 2")
        .reading(draw.pairs(190, 6)),
    ]
}
