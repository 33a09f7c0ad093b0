//! Small and large units, priors that are nearly flat, sensors that are nearly exact.

use super::basic::velocity;
use super::draft::Draft;
use super::draw::Draw;
use crate::protocol::Case;

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    [first(draw), ladder(draw), mixed(draw)].concat()
}

fn first(draw: Draw) -> Vec<Case> {
    vec![
        Draft::new("units/micro", "a random walk in units of 10⁻⁶", &["units"])
            .starting("0", "4e-12")
            .noise("1e-13", "5e-13")
            .reading(draw.powers(71, 20, 3000, -9)),
        Draft::new("units/nano", "a random walk in units of 10⁻⁹", &["units"])
            .starting("0", "4e-18")
            .noise("1e-19", "5e-19")
            .reading(draw.powers(71, 20, 3000, -12)),
        Draft::new(
            "units/tiny",
            "a random walk in units of 10⁻⁹⁰: the determinant of a 2×2 covariance underflows",
            &["units"],
        )
        .starting("0 0", "4e-180 0; 0 4e-180")
        .transition("1 0; 0 1")
        .observation("1 0; 0 1")
        .noise("1e-181 0; 0 1e-181", "5e-181 0; 0 5e-181")
        .reading(draw.powers(72, 10, 3000, -93).zip(draw.powers(73, 10, 3000, -93)).map(|(a, b)| format!("{a} {b}"))),
        Draft::new("units/side-by-side", "one state in units of 10⁹ beside one in units of 10⁻⁹", &["units"])
            .starting("0 0", "4e18 0.5; 0.5 4e-18")
            .transition("1 1e17; 0 1")
            .observation("1 0; 0 1")
            .noise("1e17 0; 0 1e-19", "5e17 0; 0 5e-19")
            .reading(draw.powers(74, 12, 3000, 6).zip(draw.powers(75, 12, 3000, -12)).map(|(a, b)| format!("{a} {b}"))),
        velocity("units/nearly-flat-prior", "initial variances of 10¹² where the noise has 1/2", &["ill-conditioned"])
            .starting("0 0", "1e12 0; 0 1e12")
            .reading(draw.powers(76, 15, 5000, -3)),
        velocity("units/nearly-exact-sensor", "a sensor with noise variance 10⁻¹⁶", &["ill-conditioned"])
            .noise("0.0003 0.005; 0.005 0.1", "1e-16")
            .reading(draw.powers(77, 15, 5000, -3)),
        Draft::new(
            "units/nearly-equal-sensors",
            "two sensors that differ by 2⁻²⁰, with noise of variance 2⁻⁴⁰",
            &["ill-conditioned"],
        )
        .starting("0 0 0", "1 0 0; 0 1 0; 0 0 1")
        .transition("1 0 0; 0 1 0; 0 0 1")
        .observation("1 1 1; 1 1 1.00000095367431640625")
        .noise("0 0 0; 0 0 0; 0 0 0", "9.094947017729282379150390625e-13 0; 0 9.094947017729282379150390625e-13")
        .reading(["3 3", "3 3.000001"]),
    ]
}

/// Two states and one sensor, in one unit after the other.
fn ladder(draw: Draw) -> Vec<Case> {
    let rung = |exponent: i32| {
        let name = if exponent < 0 { format!("1e-{}", -exponent) } else { format!("1e{exponent}") };
        let square = 2 * exponent;
        Draft::new(
            &format!("units/trend-{name}"),
            &format!("a local linear trend in units of 10^{exponent}"),
            &["units"],
        )
        .starting("0 0", &format!("4e{square} 0; 0 1e{square}"))
        .transition("1 0.5; 0 1")
        .observation("1 0")
        .noise(&format!("1e{square} 0; 0 2e{}", square - 1), &format!("5e{}", square - 1))
        .reading(draw.powers(321, 12, 3000, exponent - 3))
    };
    [-90, -30, -9, -6, -5, -3, 3, 9, 30, 90].map(rung).into()
}

/// Units that stand side by side in one model.
fn mixed(draw: Draw) -> Vec<Case> {
    vec![
        Draft::new(
            "units/radians-beside-metres",
            "an angle in radians beside a way in metres, which it bends",
            &["units"],
        )
        .starting("0 0 0", "1e6 0 0; 0 100 0; 0 0 1e-8")
        .transition("1 1 0; 0 1 9.8; 0 0 1")
        .observation("1 0 0")
        .noise("0.01 0 0; 0 0.0001 0; 0 0 1e-12", "25")
        .reading(draw.scatter(322, 12, 5000).map(|value| format!("{value}e-1"))),
        Draft::new("units/farthest-apart", "units of 10^90 and of 10^-90 side by side", &["units"])
            .starting("0 0", "4e180 0; 0 4e-180")
            .transition("1 0; 0 1")
            .observation("1 0; 0 1")
            .noise("1e179 0; 0 1e-181", "5e179 0; 0 5e-181")
            .reading(
                draw.powers(323, 8, 3000, 87).zip(draw.powers(324, 8, 3000, -93)).map(|(a, b)| format!("{a} {b}")),
            ),
        Draft::new("units/kept-by-the-sensor", "an ordinary state whose sensor reads in units of 10^-12", &["units"])
            .starting("0 0", "4 0; 0 1")
            .transition("1 0.5; 0 1")
            .observation("1e-12 0")
            .noise("0.25 0; 0 0.5", "1e-24")
            .reading(draw.powers(325, 12, 3000, -15)),
        Draft::new("units/three-sensors-three-units", "three sensors in units of 10^-6, 1 and 10^6", &["units"])
            .starting("0 1", "2 0.5; 0.5 1")
            .transition("0.75 0.25; -0.25 0.5")
            .observation("1e-6 0; 0 1; 1e6 1e6")
            .noise("0.5 0; 0 0.25", "1e-12 0 0; 0 1 0; 0 0 1e12")
            .reading(
                draw.scatter(326, 8, 2000)
                    .zip(draw.scatter(327, 8, 2000))
                    .map(|(a, b)| format!("{a}e-9 {b}e-3 {}e3", a + b)),
            ),
    ]
}
