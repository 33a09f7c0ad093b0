//! Sensors that read nearly the same (P. Dyer and S. McReynolds 1969; M. S. Grewal and A. P. Andrews).

use super::draft::Draft;
use super::draw::Draw;
use super::table::multiple;
use crate::protocol::Case;

const FLAGS: [&str; 1] = ["ill-conditioned"];

/// 2 to a power, as the shortest decimal of that double.
fn power_of_two(exponent: i32) -> f64 {
    2.0_f64.powi(exponent)
}

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    let ladder = [5, 10, 15, 18, 22, 24, 26, 30].map(|exponent| {
        Draft::new(
            &format!("collinear/grewal-2-{exponent}"),
            &format!("two sensors that differ by 2^-{exponent}, with noise of variance 2^-{}", 2 * exponent),
            &FLAGS,
        )
        .starting("0 0 0", &multiple(3, "1"))
        .transition(&multiple(3, "1"))
        .observation(&format!("1 1 1; 1 1 {}", 1.0 + power_of_two(-exponent)))
        .noise(&multiple(3, "0"), &multiple(2, &format!("{:e}", power_of_two(-2 * exponent))))
        .reading([format!("3 {}", 3.0 + power_of_two(-exponent)), format!("3 {}", 3.0 + power_of_two(-exponent))])
    });
    let noisy = [10, 20, 30].map(|exponent| {
        Draft::new(
            &format!("collinear/moving-2-{exponent}"),
            &format!(
                "a state that moves, and sensors that differ by 2^-{exponent} with noise of variance 2^-{exponent}"
            ),
            &FLAGS,
        )
        .starting("0 0", "4 0; 0 4")
        .transition("1 0.5; 0 1")
        .observation(&format!("1 1; 1 {}", 1.0 + power_of_two(-exponent)))
        .noise("0.25 0; 0 0.25", &multiple(2, &format!("{:e}", power_of_two(-exponent))))
        .reading(draw.scatter(271, 8, 2000).map(|value| {
            // Two sensors that nearly agree read nearly the same.
            format!("{} {}", super::draw::thousandths(value), super::draw::thousandths(value + 1))
        }))
    });
    let nearly = Draft::new("collinear/noise-1e-14", "two equal sensors with noise of variance 10^-14", &FLAGS)
        .starting("0", "1")
        .observation("1; 1")
        .noise("1", "1e-14 0; 0 1e-14")
        .reading(["1 1", "1.5 1.5", "3 3", "2 2"]);
    [Vec::from(ladder), noisy.into(), vec![nearly]].concat()
}
