//! Initial covariances that are nearly singular, or of low rank.

use super::draft::Draft;
use super::draw::Draw;
use super::table::{multiple, table, zeros};
use crate::protocol::{Case, shortest_double};

const FLAGS: [&str; 1] = ["ill-conditioned"];

/// D. Hilbert's matrix, entries rounded to doubles: 1/(i + j + 1).
fn hilbert(n: usize) -> String {
    table(n, n, |i, j| {
        let sum = u32::try_from(i + j + 1).unwrap_or(u32::MAX);
        shortest_double(1.0 / f64::from(sum))
    })
}

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    let n = |n: i64| usize::try_from(n).unwrap_or(0);
    let ladder = [3, 5, 8].map(|states: i64| {
        Draft::new(
            &format!("prior/hilbert-{states}"),
            &format!("Hilbert's matrix of order {states} as the initial covariance, read by two sums"),
            &FLAGS,
        )
        .starting(&zeros(n(states)), &hilbert(n(states)))
        .transition(&multiple(n(states), "1"))
        .observation(&table(2, n(states), |i, j| if i == 0 || j % 2 == 0 { "1" } else { "0" }.into()))
        .noise(&multiple(n(states), "0"), "1 0; 0 1")
        .reading(draw.pairs(281, 3))
    });
    // One state after the other, with a sharp sensor.
    let scan = [4, 6].map(|states: i64| {
        Draft::new(
            &format!("prior/hilbert-{states}-scanned"),
            &format!(
                "Hilbert's matrix of order {states}, whose states are read one after the other with variance 10^-6"
            ),
            &FLAGS,
        )
        .starting(&zeros(n(states)), &hilbert(n(states)))
        .transition(&multiple(n(states), "1"))
        .observation_matrices((0..n(states)).map(|k| table(1, n(states), |_, j| if j == k { "1" } else { "0" }.into())))
        .noise(&multiple(n(states), "0"), "1e-6")
        .reading(draw.singles(282, states, 1000))
    });
    let near = [10, 20, 30, 40, 50].map(|exponent: i32| {
        let close = shortest_double(1.0 - 2.0_f64.powi(-exponent));
        Draft::new(
            &format!("prior/correlated-2-{exponent}"),
            &format!("two states whose correlation is 1 - 2^-{exponent}; their difference is read, too"),
            &FLAGS,
        )
        .starting("0 0", &format!("1 {close}; {close} 1"))
        .transition("1 0; 0 1")
        .observation("1 0; 1 -1")
        .noise("0 0; 0 0", &format!("1 0; 0 {}", shortest_double(2.0_f64.powi(-exponent))))
        .reading(["1 0", "0.5 0", "1 0"])
    });
    let ranks = vec![
        Draft::new("prior/rank-one-of-four", "an initial covariance of rank one: four states with one unknown", &FLAGS)
            .starting("0 0 0 0", &table(4, 4, |i, j| ((i + 1) * (j + 1)).to_string()))
            .transition(&multiple(4, "1"))
            .observation("1 0 0 0; 0 0 0 1")
            .noise(&multiple(4, "0"), "1 0; 0 2")
            .reading(draw.pairs(283, 4)),
        Draft::new("prior/rank-two-of-four", "two unknowns in four states, and noise in one of them", &FLAGS)
            .starting("0 0 0 0", "2 1 1 3; 1 1 0 1; 1 0 1 2; 3 1 2 5")
            .transition("1 0.5 0 0; 0 1 0 0; 0 0 1 0.5; 0 0 0 1")
            .observation("1 0 1 0")
            .noise("0 0 0 0; 0 0.25 0 0; 0 0 0 0; 0 0 0 0", "0.5")
            .reading(draw.singles(284, 6, 3000)),
        Draft::new("prior/one-state-known", "one of two states is known exactly at first", &FLAGS)
            .starting("1 2", "0 0; 0 3")
            .transition("1 0.5; 0 1")
            .observation("1 0")
            .noise("0 0; 0 0.25", "1")
            .reading(draw.singles(285, 8, 3000)),
        Draft::new("prior/constant-known", "a constant that is known exactly: no reading moves it", &FLAGS)
            .starting("1", "0")
            .noise("0", "1")
            .reading(["1.5", "2", "9"]),
    ];
    [Vec::from(ladder), scan.into(), near.into(), ranks].concat()
}
