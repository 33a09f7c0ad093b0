//! Ordinary models.

use super::draft::Draft;
use super::draw::{Draw, scatter, thousandths};
use super::table::{diagonal, multiple, table, zeros};
use crate::protocol::Case;

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    [first(draw), shapes(draw), models(draw)].concat()
}

fn first(draw: Draw) -> Vec<Case> {
    vec![
        Draft::new(
            "basic/constant",
            "a constant read twice; by hand: 1/2 with variance 1/2, then 1 with 1/3",
            &["basic"],
        )
        .reading(["1", "2"]),
        Draft::new("basic/random-walk", "a random walk seen through noise", &["basic"])
            .starting("0", "4")
            .noise("0.1", "0.5")
            .reading(draw.singles(1, 20, 3000)),
        velocity("basic/constant-velocity", "position and velocity, the position is read", &["basic"])
            .reading(draw.singles(2, 20, 5000)),
        Draft::new(
            "basic/constant-acceleration",
            "position, velocity and acceleration, the position is read",
            &["basic"],
        )
        .starting("0 0 0", "10 0 0; 0 10 0; 0 0 10")
        .transition("1 0.5 0.125; 0 1 0.5; 0 0 1")
        .observation("1 0 0")
        .noise("0.01 0.02 0.01; 0.02 0.05 0.04; 0.01 0.04 0.1", "2")
        .reading(draw.singles(3, 20, 9000)),
        Draft::new("basic/two-sensors", "two sensors of unequal noise, which is correlated between them", &["basic"])
            .starting("1 -1", "2 0.5; 0.5 1")
            .transition("0.9 0.1; -0.2 0.8")
            .observation("1 0; 1 1")
            .noise("0.3 0.1; 0.1 0.2", "0.5 0.2; 0.2 1.5")
            .reading(draw.pairs(4, 15)),
        Draft::new("basic/known-input", "a known input moves the state", &["basic", "input"])
            .starting("0 0", "1 0; 0 1")
            .transition("1 0.1; 0 1")
            .observation("1 0")
            .noise("0.001 0; 0 0.01", "0.25")
            .input("0.005; 0.1", scatter(5, 15, 2000).map(thousandths))
            .reading(draw.singles(6, 15, 2000)),
        Draft::new("basic/observation-offset", "a known offset is added to the reading", &["basic", "input"])
            .noise("0.2", "0.3")
            .observation_input("10")
            .reading(draw.scatter(7, 10, 1000).map(|value| thousandths(10_000 + value))),
    ]
}

/// Numbers of states and sensors.
fn shapes(draw: Draw) -> Vec<Case> {
    vec![
        Draft::new(
            "basic/two-sensors-by-hand",
            "two equal sensors of one state, prior variance 1; by hand: 3 with variance 1/3",
            &["basic"],
        )
        .observation("1; 1")
        .noise("0", "1 0; 0 1")
        .reading(["3 6"]),
        Draft::new("basic/one-reading", "a single reading of three states", &["basic"])
            .starting("1 -2 0.5", "4 1 0; 1 3 -1; 0 -1 2")
            .transition("1 0 0; 0 1 0; 0 0 1")
            .observation("1 2 -1")
            .noise("1 0 0; 0 1 0; 0 0 1", "0.75")
            .reading(draw.singles(101, 1, 4000)),
        Draft::new(
            "basic/three-sensors-one-state",
            "more sensors than states, with a full noise covariance",
            &["basic"],
        )
        .starting("2", "3")
        .transition("0.75")
        .observation("1; -2; 0.5")
        .noise("0.4", "1 0.25 0.1; 0.25 2 -0.5; 0.1 -0.5 0.5")
        .reading(draw.several(3, 102, 8, 2000)),
        Draft::new("basic/four-sensors-two-states", "four sensors of unequal noise look at two states", &["basic"])
            .starting("0 1", "2 -0.5; -0.5 1")
            .transition("0.9 0.3; -0.1 0.8")
            .observation("1 0; 0 1; 1 1; 2 -1")
            .noise("0.5 0.1; 0.1 0.25", &diagonal(&["0.5", "1", "2", "4"]))
            .reading(draw.several(4, 103, 8, 2000)),
        Draft::new("basic/three-states-two-sensors", "full covariances everywhere", &["basic"])
            .starting("1 0 -1", "3 1 0.5; 1 2 -0.25; 0.5 -0.25 1")
            .transition("0.8 0.1 0; -0.2 0.9 0.3; 0.1 0 0.7")
            .observation("1 0 0.5; 0 1 -1")
            .noise("0.5 0.1 0; 0.1 0.4 -0.1; 0 -0.1 0.3", "0.6 0.2; 0.2 0.9")
            .reading(draw.pairs(104, 10)),
        Draft::new("basic/chain-of-five", "five states in a chain, of which the first is read", &["basic"])
            .starting(&zeros(5), &multiple(5, "2"))
            .transition(&chain(5, "0.75", "0.25"))
            .observation("1 0 0 0 0")
            .noise(&multiple(5, "0.125"), "0.5")
            .reading(draw.singles(105, 10, 2000)),
        Draft::new("basic/plane-with-acceleration", "position, velocity and acceleration in a plane", &["basic"])
            .starting(&zeros(6), &diagonal(&["9", "9", "9", "4", "4", "4"]))
            .transition("1 0.5 0.125 0 0 0; 0 1 0.5 0 0 0; 0 0 1 0 0 0; 0 0 0 1 0.5 0.125; 0 0 0 0 1 0.5; 0 0 0 0 0 1")
            .observation("1 0 0 0 0 0; 0 0 0 1 0 0")
            .noise(&diagonal(&["0.01", "0.02", "0.1", "0.01", "0.02", "0.1"]), "1 0.25; 0.25 0.5")
            .reading(draw.pairs(106, 7)),
        Draft::new("basic/eight-states", "a chain of eight states and three sensors", &["basic"])
            .starting(&zeros(8), &multiple(8, "1"))
            .transition(&chain(8, "0.5", "0.375"))
            .observation(&table(3, 8, |i, j| if j == 3 * i { "1" } else { "0" }.into()))
            .noise(&multiple(8, "0.25"), &diagonal(&["0.5", "1", "0.25"]))
            .reading(draw.several(3, 107, 4, 2000)),
    ]
}

/// Models that everybody meets.
fn models(draw: Draw) -> Vec<Case> {
    vec![
        Draft::new("basic/damped", "an autoregression of order one, seen through noise", &["basic"])
            .starting("0", "5")
            .transition("0.9")
            .noise("1", "2")
            .reading(draw.singles(111, 20, 3000)),
        Draft::new("basic/alternating", "a transition that changes the sign", &["basic"])
            .starting("3", "2")
            .transition("-0.5")
            .noise("0.5", "0.25")
            .reading(draw.singles(112, 12, 2000)),
        Draft::new("basic/forgetful", "a transition of zero: each state is new", &["basic"])
            .starting("1", "2")
            .transition("0")
            .noise("3", "1")
            .reading(draw.singles(113, 6, 3000)),
        Draft::new("basic/oscillator", "a damped oscillation, read in one coordinate", &["basic"])
            .starting("1 0", "1 0; 0 1")
            .transition("0.95 0.3; -0.3 0.95")
            .observation("1 0")
            .noise("0.01 0; 0 0.02", "0.1")
            .reading(draw.singles(114, 20, 2000)),
        Draft::new("basic/plane", "position and velocity in a plane, both positions are read", &["basic"])
            .starting("0 0 0 0", &multiple(4, "10"))
            .transition("1 0 0.5 0; 0 1 0 0.5; 0 0 1 0; 0 0 0 1")
            .observation("1 0 0 0; 0 1 0 0")
            .noise("0.05 0 0.1 0; 0 0.05 0 0.1; 0.1 0 0.4 0; 0 0.1 0 0.4", "0.5 0.1; 0.1 0.5")
            .reading(draw.pairs(115, 12)),
        Draft::new("basic/quarterly-season", "a level and a season of four quarters", &["basic"])
            .starting("10 0 0 0", &diagonal(&["4", "1", "1", "1"]))
            .transition("1 0 0 0; 0 -1 -1 -1; 0 1 0 0; 0 0 1 0")
            .observation("1 1 0 0")
            .noise(&diagonal(&["0.25", "0.125", "0", "0"]), "0.5")
            .reading(draw.scatter(116, 16, 3000).map(|value| thousandths(10_000 + value))),
        Draft::new(
            "basic/far-mean",
            "the first mean lies far from the readings, and its variance is small",
            &["basic"],
        )
        .starting("1000 -20", "4 1; 1 2")
        .transition("0.5 0; 0.1 0.5")
        .observation("1 1")
        .noise("1 0; 0 1", "3")
        .reading(draw.singles(118, 10, 3000)),
    ]
}

/// Each state keeps a part of itself and hands a part to the one before it.
pub(super) fn chain(n: usize, kept: &str, handed: &str) -> String {
    table(n, n, |i, j| {
        if i == j {
            kept
        } else if j == i + 1 {
            handed
        } else {
            "0"
        }
        .into()
    })
}

/// Position and velocity with a step of one tenth, a case in the making for other categories too.
pub(super) fn velocity(id: &str, about: &str, flags: &[&str]) -> Draft {
    Draft::new(id, about, flags)
        .starting("0 0", "10 0; 0 10")
        .transition("1 0.1; 0 1")
        .observation("1 0")
        .noise("0.0003 0.005; 0.005 0.1", "0.5")
}
