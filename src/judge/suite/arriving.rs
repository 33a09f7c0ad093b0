//! Transitions that lead into their step, and starts before them.

use super::draft::Draft;
use super::draw::Draw;
use crate::protocol::Case;

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    let pair = |id: &str, about: &str| {
        Draft::new(id, about, &["arriving"])
            .arriving()
            .starting("1 0", "1 0.5; 0.5 2")
            .transition("0.75 0.5; -0.25 0.5")
            .observation("1 0.5")
            .noise("0.5 0.125; 0.125 0.25", "0.5")
    };
    let start = Draft::new(
        "arriving/start-before-transition",
        "a random walk whose initial law is one step older",
        &["arriving", "before-transition"],
    );
    vec![
        start.arriving().before_transition().transition("0.5").noise("2", "1").reading(draw.singles(44, 8, 2000)),
        pair("arriving/start-at-observation", "the initial law is that of x_0, and transition 0 is not used")
            .reading(draw.singles(191, 8, 2000)),
        pair("arriving/with-input-before-transition", "the input of transition 0 moves the first state")
            .before_transition()
            .input("1; -2", ["3", "0", "-1", "2", "0", "1"])
            .reading(draw.singles(192, 6, 2000)),
        pair("arriving/missing-first", "a start before transition 0, and no reading at step 0")
            .before_transition()
            .reading(super::table::gaps(draw.singles(193, 8, 2000), &[0, 1, 5])),
        Draft::new("arriving/known-before-transition", "the state before transition 0 is known exactly", &["arriving"])
            .arriving()
            .before_transition()
            .starting("2", "0")
            .transition("0.5")
            .noise("1", "0.5")
            .reading(draw.singles(194, 6, 2000)),
        Draft::new(
            "arriving/diffuse-before-transition",
            "nothing is known of the state before transition 0",
            &["arriving", "diffuse"],
        )
        .arriving()
        .before_transition()
        .starting("0 0", "0 0; 0 0")
        .diffuse("1 0; 0 1")
        .transition("1 0.5; 0 1")
        .observation("1 0")
        .noise("0.25 0; 0 0.25", "0.5")
        .reading(draw.singles(195, 8, 2000)),
    ]
}
