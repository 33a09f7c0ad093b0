//! Process noises that go to zero: integrated random walks and slow drifts.

use super::draft::Draft;
use super::draw::Draw;
use super::table::diagonal;
use crate::protocol::Case;

const FLAGS: [&str; 1] = ["ill-conditioned"];

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    let thrice = [10, 14, 18].map(|exponent| {
        Draft::new(
            &format!("still/thrice-integrated-1e-{exponent}"),
            &format!("a random walk of variance 10^-{exponent}, integrated three times"),
            &FLAGS,
        )
        .starting("0 0 0", &diagonal(&["10", "10", "10"]))
        .transition("1 1 0.5; 0 1 1; 0 0 1")
        .observation("1 0 0")
        .noise(&diagonal(&["0", "0", &format!("1e-{exponent}")]), "1")
        .reading(draw.singles(241, 25, 4000))
    });
    let trend = [6, 10, 14].map(|exponent| {
        Draft::new(
            &format!("still/trend-1e-{exponent}"),
            &format!("a local linear trend whose noises have variance 10^-{exponent}"),
            &FLAGS,
        )
        .starting("0 0", "100 0; 0 100")
        .transition("1 1; 0 1")
        .observation("1 0")
        .noise(&diagonal(&[format!("1e-{exponent}"), format!("1e-{exponent}")]), "1")
        .reading(draw.singles(242, 25, 4000))
    });
    let walk = [10, 18].map(|exponent| {
        Draft::new(
            &format!("still/walk-1e-{exponent}"),
            &format!("a random walk with steps of variance 10^-{exponent}"),
            &FLAGS,
        )
        .starting("0", "1")
        .noise(&format!("1e-{exponent}"), "1")
        .reading(draw.singles(243, 40, 3000))
    });
    let none = Draft::new("still/trend-without-noise", "the last rung: a line through readings", &FLAGS)
        .starting("0 0", "100 0; 0 100")
        .transition("1 1; 0 1")
        .observation("1 0")
        .noise("0 0; 0 0", "1")
        .reading(draw.singles(242, 25, 4000));
    [Vec::from(thrice), trend.into(), vec![none], walk.into()].concat()
}
