//! Sensors whose noise goes to zero.

use super::basic::velocity;
use super::draft::Draft;
use super::draw::Draw;
use super::table::diagonal;
use crate::protocol::Case;

const FLAGS: [&str; 1] = ["ill-conditioned"];

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    let ladder = [4, 8, 12, 14, 16, 18, 20, 24].map(|exponent| {
        velocity(
            &format!("exact-sensor/velocity-1e-{exponent}"),
            &format!("position and velocity, initial variances of ten, a sensor with noise variance 10^-{exponent}"),
            &FLAGS,
        )
        .noise("0.0003 0.005; 0.005 0.1", &format!("1e-{exponent}"))
        .reading(draw.singles(221, 12, 5000))
    });
    let pair = |exponent: i32| {
        Draft::new(
            &format!("exact-sensor/beside-a-poor-one-1e-{exponent}"),
            &format!("a sensor of variance 1 beside one of variance 10^-{exponent}, which reads a sum of three states"),
            &FLAGS,
        )
        .starting("0 0 0", &diagonal(&["4", "2", "1"]))
        .transition("0.75 0.25 0; 0 0.5 0.25; 0.25 0 0.5")
        .observation("1 1 1; 1 0 -1")
        .noise(&diagonal(&["0.5", "0.25", "0.125"]), &format!("1e-{exponent} 0; 0 1"))
        .reading(draw.pairs(222, 8))
    };
    let still = |exponent: i32| {
        Draft::new(
            &format!("exact-sensor/still-1e-{exponent}"),
            &format!("two constants, read in turn and together with noise variance 10^-{exponent}"),
            &FLAGS,
        )
        .starting("0 0", "1 0; 0 1")
        .transition("1 0; 0 1")
        .observation_matrices(["1 1", "1 2", "1 3", "1 4", "1 5", "1 6"])
        .noise("0 0; 0 0", &format!("1e-{exponent}"))
        .reading(["3", "5", "7", "9", "11", "13"])
    };
    let mut cases = Vec::from(ladder);
    cases.push(
        velocity("exact-sensor/velocity-without-noise", "the last rung: a sensor without noise", &FLAGS)
            .noise("0.0003 0.005; 0.005 0.1", "0")
            .reading(draw.singles(221, 12, 5000)),
    );
    cases.push(
        Draft::new(
            "exact-sensor/moving-average",
            "autoregression of order two with a moving average, without sensor noise: the variance goes to zero",
            &FLAGS,
        )
        .starting("0 0", "2 0; 0 1")
        .transition("1.25 1; -0.5 0")
        .observation("1 0")
        .noise("1 0.5; 0.5 0.25", "0")
        .reading(draw.singles(117, 15, 3000)),
    );
    cases.extend([8, 12, 16, 20].map(pair));
    cases.extend([6, 10, 14].map(still));
    cases
}
