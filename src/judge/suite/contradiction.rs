//! Data that the model says are impossible. Each sentence names the first step whose data have probability zero.

use super::draft::Draft;
use super::draw::Draw;
use super::table::multiple;
use crate::protocol::{Case, Expect};

/// Readings that contradict each other are the same with every seed.
pub(super) fn cases(_: Draw) -> Vec<Case> {
    let draft = |id: &str, about: &str| Draft::new(id, about, &["singular", "contradiction"]).expecting(Expect::Flag);
    vec![
        draft("contradiction/at-once", "a state that is known to be 2 is read as 3, without noise, at step 0")
            .starting("2", "0")
            .noise("1", "0")
            .reading(["3", "2", "2"]),
        draft("contradiction/last-bit", "two equal sensors without noise differ by one part in 2^50 at step 1")
            .starting("0", "1")
            .observation("1; 1")
            .noise("1", "0 0; 0 0")
            .reading(["1 1", "1 1.0000000000000008882", "2 2"]),
        draft("contradiction/late", "a constant read without noise, until it is something else at step 12")
            .starting("0", "1")
            .noise("0", "0")
            .reading(["0.5"; 12].into_iter().chain(["0.5625", "0.5"])),
        draft("contradiction/sum-of-sensors", "the third sensor does not read the sum of the others at step 2")
            .starting("0 0", "2 1; 1 2")
            .transition("1 0.5; 0 1")
            .observation("1 0; 0 1; 1 1")
            .noise("1 0; 0 1", &multiple(3, "0"))
            .reading(["1 2 3", "2 2.5 4.5", "3 3 5", "1 1 2"]),
        draft("contradiction/velocity", "exact readings of a line, which bends at step 3")
            .starting("0 0", "4 0; 0 4")
            .transition("1 0.5; 0 1")
            .observation("1 0")
            .noise("0 0; 0 0", "0")
            .reading(["1", "1.5", "2", "2.75", "3"]),
        draft("contradiction/blind-sensor", "a sensor that sees nothing and has no noise reads 1 at step 1")
            .starting("0", "1")
            .observation("1; 0")
            .noise("0.5", "1 0; 0 0")
            .reading(["1 0", "2 1", "1.5 0"]),
        draft("contradiction/after-a-gap", "a constant read without noise, a gap, and another value at step 4")
            .starting("0", "1")
            .noise("0", "0")
            .reading(["1", "1", "", "", "2"]),
        draft("contradiction/common-noise", "two sensors with one noise between them disagree at step 1")
            .starting("0", "1")
            .observation("1; 1")
            .noise("1", "2 2; 2 2")
            .reading(["1 1", "0.5 0.75", "3 3"]),
        draft(
            "contradiction/input-forgotten",
            "the readings fit if the offset of 5 is forgotten, so they contradict it at step 0",
        )
        .starting("2", "0")
        .noise("0", "0")
        .observation_input("5")
        .reading(["2", "2", "2"]),
        draft(
            "contradiction/noisy-beside",
            "two equal sensors without noise disagree at step 2, beside a third with noise",
        )
        .starting("0 0", "1 0; 0 1")
        .transition("1 0.5; 0 1")
        .observation("1 0; 1 0; 0 1")
        .noise("1 0; 0 1", "0 0 0; 0 0 0; 0 0 4")
        .reading(["1 1 3", "2 2 -1", "0 0.125 1", "1 1 1"]),
    ]
}
