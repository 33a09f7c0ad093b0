//! Sampling intervals that go to zero.

use super::draft::Draft;
use super::draw::Draw;
use crate::protocol::Case;

const FLAGS: [&str; 1] = ["ill-conditioned"];

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    // Noise of intensity 3 between readings that are dt apart: dt³, 3/2 dt², 3 dt.
    let velocity = [1, 2, 3, 4, 6].map(|exponent: i32| {
        Draft::new(
            &format!("sampling/velocity-1e-{exponent}"),
            &format!("position and velocity, read every 10^-{exponent} s"),
            &FLAGS,
        )
        .starting("0 0", "1 0; 0 1")
        .transition(&format!("1 1e-{exponent}; 0 1"))
        .observation("1 0")
        .noise(&format!("1e-{} 1.5e-{}; 1.5e-{} 3e-{exponent}", 3 * exponent, 2 * exponent, 2 * exponent), "0.01")
        .reading(draw.singles(251, 20, 2000))
    });
    let acceleration = [2, 4].map(|exponent: i32| {
        Draft::new(
            &format!("sampling/acceleration-1e-{exponent}"),
            &format!("position, velocity and acceleration, read every 10^-{exponent} s; the jerk is noise"),
            &FLAGS,
        )
        .starting("0 0 0", "1 0 0; 0 1 0; 0 0 1")
        .transition(&format!("1 1e-{exponent} 5e-{}; 0 1 1e-{exponent}; 0 0 1", 2 * exponent + 1))
        .observation("1 0 0")
        .noise(&format!("0 0 0; 0 0 0; 0 0 1e-{exponent}"), "0.01")
        .reading(draw.singles(252, 15, 2000))
    });
    [Vec::from(velocity), acceleration.into()].concat()
}
