//! Poles that are nearly equal, and modes that are nearly told apart by the sensor.

use super::draft::Draft;
use super::draw::Draw;
use crate::protocol::Case;

const FLAGS: [&str; 1] = ["ill-conditioned"];

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    let close = |exponent: i32| format!("{}", 0.75 + 2.0_f64.powi(-exponent));
    let joined = [10, 20, 30, 40].map(|exponent| {
        Draft::new(
            &format!("poles/joined-2-{exponent}"),
            &format!("two poles that differ by 2^-{exponent}, one feeding the other: nearly a Jordan block"),
            &FLAGS,
        )
        .starting("0 0", "1 0; 0 1")
        .transition(&format!("0.75 1; 0 {}", close(exponent)))
        .observation("1 0")
        .noise("0.25 0; 0 0.125", "0.5")
        .reading(draw.singles(261, 12, 2000))
    });
    let apart = [5, 10, 20, 30].map(|exponent| {
        Draft::new(
            &format!("poles/apart-2-{exponent}"),
            &format!("two modes whose poles differ by 2^-{exponent}, of which the sum is read: hardly told apart"),
            &FLAGS,
        )
        .starting("0 0", "1 0; 0 1")
        .transition(&format!("0.75 0; 0 {}", close(exponent)))
        .observation("1 1")
        .noise("0 0; 0 0", "9.094947017729282e-13")
        .reading(["2", "1.5", "1.125", "0.84375"])
    });
    let equal = Draft::new("poles/equal", "two modes with the same pole: only their sum is ever seen", &FLAGS)
        .starting("0 0", "1 0; 0 1")
        .transition("0.75 0; 0 0.75")
        .observation("1 1")
        .noise("0.25 0; 0 0.125", "0.5")
        .reading(draw.singles(262, 12, 2000));
    [Vec::from(joined), apart.into(), vec![equal]].concat()
}
