//! Known inputs.

use super::draft::Draft;
use super::draw::Draw;
use crate::protocol::Case;

const PULSES: [&str; 10] = ["0", "0", "4", "0", "0", "0", "-8", "0", "0", "1"];

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    let pair = |id: &str, about: &str| {
        Draft::new(id, about, &["input"])
            .starting("1 -1", "2 0.5; 0.5 1")
            .transition("0.75 0.25; -0.25 0.5")
            .observation("1 0.5")
            .noise("0.25 0; 0 0.5", "0.5")
    };
    vec![
        pair("input/constant", "the same input at every step")
            .constant_input("0.5; 1", "2")
            .reading(draw.singles(141, 10, 2000)),
        pair("input/pulses", "an input that is mostly zero: one step early or late is seen")
            .input("1; 3", PULSES)
            .reading(draw.singles(142, 10, 2000)),
        pair("input/two-inputs", "two inputs that enter by a matrix that is not symmetric")
            .input("1 2; -0.5 0.25", ["1 0", "0 1", "2 -1", "0 0", "1 1", "-3 0", "0 2", "1 -1"])
            .reading(draw.singles(143, 8, 2000)),
        pair("input/varying-matrix", "the matrix of the input differs from step to step")
            .inputs(["1; 0", "0; 1", "2; -1", "0.5; 0.5", "-1; 2", "0; 4", ""], ["1", "2", "-1", "4", "3", "-2", "1"])
            .reading(draw.singles(144, 7, 2000)),
        pair("input/feed-through", "an input that is added to the reading at its own step")
            .feed_through("3", PULSES)
            .reading(draw.singles(145, 10, 2000)),
        pair("input/both", "an input that moves the state, and another that is added to the reading")
            .input("1; -1", PULSES)
            .feed_through("2", PULSES.into_iter().rev())
            .reading(draw.singles(146, 10, 2000)),
        pair("input/arriving", "input k enters by the transition into k; that of step 0 moves nothing")
            .arriving()
            .input("1; 3", ["100", "0", "4", "0", "-2", "0", "1", "8"])
            .reading(draw.singles(147, 8, 2000)),
        pair("input/arriving-before-transition", "with a start before the first transition, input 0 counts")
            .arriving()
            .before_transition()
            .input("1; 3", ["100", "0", "4", "0", "-2", "0", "1", "8"])
            .reading(draw.singles(147, 8, 2000)),
        Draft::new(
            "input/offset-of-two-sensors",
            "two sensors with different known offsets, one silent at times",
            &["input"],
        )
        .observation("1; 1")
        .noise("0.5", "1 0; 0 2")
        .feed_through("1 0; 1 1", ["5 1", "5 2", "-5 1", "0 8", "1 1", "2 0"])
        .reading(super::table::silenced(draw.pairs(148, 6), |k, i| k == 2 && i == 0 || k == 4)),
    ]
}
