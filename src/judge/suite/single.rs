//! Numbers that mean single-precision numbers: what embedded filters compute with.

use super::basic::velocity;
use super::draft::Draft;
use super::draw::Draw;
use super::table::{and_ahead, gaps, multiple, silenced};
use crate::protocol::Case;

const FLAGS: [&str; 1] = ["binary32"];

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    let exact = [4, 8].map(|exponent| {
        velocity(
            &format!("single/exact-sensor-1e-{exponent}"),
            &format!("position and velocity, a sensor with noise variance 10^-{exponent}"),
            &["binary32", "ill-conditioned"],
        )
        .single()
        .noise("0.0003 0.005; 0.005 0.1", &format!("1e-{exponent}"))
        .reading(draw.singles(311, 12, 5000))
    });
    let flat = [4, 8].map(|exponent| {
        velocity(
            &format!("single/flat-prior-1e{exponent}"),
            &format!("position and velocity with initial variances of 10^{exponent}"),
            &["binary32", "ill-conditioned"],
        )
        .single()
        .starting("0 0", &multiple(2, &format!("1e{exponent}")))
        .reading(draw.singles(312, 12, 5000))
    });
    let ordinary = vec![
        Draft::new("single/random-walk", "a random walk", &FLAGS)
            .single()
            .starting("0", "4")
            .noise("0.1", "0.5")
            .reading(draw.singles(313, 20, 3000)),
        velocity("single/constant-velocity", "position and velocity with a step of one tenth", &FLAGS)
            .single()
            .reading(draw.singles(314, 20, 5000)),
        Draft::new("single/two-sensors", "two sensors of unequal noise, one silent at times", &FLAGS)
            .single()
            .starting("1 -1", "2 0.5; 0.5 1")
            .transition("0.9 0.1; -0.2 0.8")
            .observation("1 0; 1 1")
            .noise("0.3 0.1; 0.1 0.2", "0.5 0.2; 0.2 1.5")
            .reading(silenced(draw.pairs(315, 12), |k, i| k % 4 == i + 1)),
        velocity("single/gaps-and-ahead", "gaps, then five steps ahead", &["binary32", "ahead"])
            .single()
            .reading(and_ahead(gaps(draw.singles(316, 10, 5000), &[2, 5]), 5)),
        Draft::new("single/unstable", "a mode that doubles and is read", &["binary32", "unstable"])
            .single()
            .transition("2")
            .noise("0.1", "1")
            .reading(draw.singles(317, 20, 4000)),
        Draft::new("single/correlated", "noise shared with the transition that leads out", &FLAGS)
            .single()
            .transition("0.8")
            .noise("1", "0.5")
            .cross("0.4")
            .reading(draw.singles(318, 12, 2000)),
        Draft::new("single/units", "a random walk in units of 10^-6", &["binary32", "units"])
            .single()
            .starting("0", "4e-12")
            .noise("1e-13", "5e-13")
            .reading(draw.powers(319, 12, 3000, -9)),
        Draft::new("single/equal-sensors", "two sensors without noise that read the same", &["binary32", "singular"])
            .single()
            .starting("0", "1")
            .observation("1; 1")
            .noise("1", "0 0; 0 0")
            .reading(["1 1", "0.5 0.5", "2 2"]),
    ];
    [ordinary, exact.into(), flat.into()].concat()
}
