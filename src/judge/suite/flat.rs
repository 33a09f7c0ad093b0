//! Initial variances that go to infinity.

use super::basic::velocity;
use super::draft::Draft;
use super::draw::Draw;
use super::table::multiple;
use crate::protocol::Case;

const FLAGS: [&str; 1] = ["ill-conditioned"];

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    let ladder = [6, 9, 12, 15, 18].map(|exponent| {
        velocity(
            &format!("flat-prior/velocity-1e{exponent}"),
            &format!("position and velocity with initial variances of 10^{exponent}"),
            &FLAGS,
        )
        .starting("0 0", &multiple(2, &format!("1e{exponent}")))
        .reading(draw.singles(231, 12, 5000))
    });
    let walk = [7, 14].map(|exponent| {
        Draft::new(
            &format!("flat-prior/walk-1e{exponent}"),
            &format!("a random walk with an initial variance of 10^{exponent}"),
            &FLAGS,
        )
        .starting("0", &format!("1e{exponent}"))
        .noise("0.5", "1")
        .reading(draw.singles(232, 12, 3000))
    });
    let three = [6, 12, 18].map(|exponent| {
        Draft::new(
            &format!("flat-prior/acceleration-1e{exponent}"),
            &format!("three states with initial variances of 10^{exponent}: three readings resolve them"),
            &FLAGS,
        )
        .starting("0 0 0", &multiple(3, &format!("1e{exponent}")))
        .transition("1 0.5 0.125; 0 1 0.5; 0 0 1")
        .observation("1 0 0")
        .noise(&multiple(3, "0.0625"), "0.5")
        .reading(draw.singles(233, 10, 4000))
    });
    let mixed = Draft::new("flat-prior/one-of-two", "one state of variance 10^12 beside one of variance 10^-4", &FLAGS)
        .starting("0 1", "1e12 0; 0 1e-4")
        .transition("1 0; 0 1")
        .observation("1 1")
        .noise("0.25 0; 0 1e-6", "0.5")
        .reading(draw.singles(234, 10, 4000));
    [Vec::from(ladder), walk.into(), three.into(), vec![mixed]].concat()
}
