//! Matrices and inputs that depend on past readings, frozen at their values along the path (CKS-A3).

use super::draft::{Draft, scatter, thousandths};
use crate::protocol::Case;

pub(super) fn cases() -> Vec<Case> {
    vec![regression(), cubic(), transition()]
}

/// Readings in thousandths.
fn readings(seed: i64, count: i64) -> Vec<i64> {
    scatter(seed, count, 2000).collect()
}

fn texts(values: &[i64]) -> impl Iterator<Item = String> {
    values.iter().copied().map(thousandths)
}

/// y_k = a y_{k−1} + b u_{k−1} + w_k with u = −y/2 + a fixed excitation; the state is (a, b).
fn regression() -> Case {
    let y = readings(31, 15);
    let excitation: Vec<i64> = scatter(32, 15, 500).collect();
    // −y/2 in thousandths, cut to whole ones: the data are what they are.
    let u: Vec<i64> = y.iter().zip(&excitation).map(|(y, e)| e - y / 2).collect();
    let past = |k: usize| k.checked_sub(1).map_or((0, 0), |last| (y[last], u[last]));
    let rows = (0..15).map(|k| format!("{} {}", thousandths(past(k).0), thousandths(past(k).1)));
    Draft::new(
        "adapted/regression-with-feedback",
        "recursive least squares for y_k = a y_{k-1} + b u_{k-1} + w_k, with u by feedback",
        &["adapted", "time-varying", "input"],
    )
    .starting("0 0", "4 0; 0 4")
    .transition("1 0; 0 1")
    .observation_matrices(rows)
    .noise("0 0; 0 0", "1")
    .rule(
        "observation",
        "row k is (y_{k-1}, u_{k-1}) with u_k = excitation_k - y_k / 2; zeros before the first reading",
    )
    .reading(texts(&y))
}

/// The regressor y³ has no second moment to speak of; almost sure finiteness is enough.
fn cubic() -> Case {
    let y = readings(33, 10);
    let cube = |k: usize| {
        k.checked_sub(1).map_or(0.0, |last| {
            #[expect(clippy::cast_precision_loss, reason = "at most four digits")]
            let value = y[last] as f64 / 1000.0;
            value * value * value
        })
    };
    Draft::new(
        "adapted/cubic-feedback",
        "the observation matrix is the cube of the last reading",
        &["adapted", "time-varying"],
    )
    .starting("0", "2")
    .noise("0", "1")
    .observation_matrices((0..10).map(|k| crate::protocol::shortest_double(cube(k))))
    .rule("observation", "the double nearest to y_{k-1}^3, evaluated in doubles; zero before the first reading")
    .reading(texts(&y))
}

/// The transition out of k depends on y_k.
fn transition() -> Case {
    let y = readings(34, 12);
    let matrices: Vec<String> =
        (0..12).map(|k| if k == 11 { String::new() } else { thousandths(500 + y[k] / 8) }).collect();
    Draft::new(
        "adapted/transition-follows-data",
        "the transition out of k is 1/2 + y_k/8",
        &["adapted", "time-varying"],
    )
    .starting("1", "1")
    .noise("0.3", "0.5")
    .transitions(matrices)
    .rule("transition", "0.5 + y_k / 8, cut to thousandths")
    .reading(texts(&y))
}
