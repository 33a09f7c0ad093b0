//! Matrices and inputs that depend on past readings, frozen at their values along the path (CKS-A3).

use super::draft::Draft;
use super::draw::{Draw, scatter, thousandths};
use super::table::multiple;
use crate::protocol::Case;

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    vec![
        regression(draw),
        cubic(draw),
        transition(draw),
        arx(draw),
        forgetting(draw),
        variance(draw),
        switching(draw),
        feedback(draw),
        offset(draw),
    ]
}

/// Readings in thousandths.
fn readings(draw: Draw, number: i64, count: i64) -> Vec<i64> {
    draw.scatter(number, count, 2000).collect()
}

fn texts(values: &[i64]) -> impl Iterator<Item = String> {
    values.iter().copied().map(thousandths)
}

/// y_k = a y_{k−1} + b u_{k−1} + w_k with u = −y/2 + a fixed excitation; the state is (a, b).
fn regression(draw: Draw) -> Case {
    let y = readings(draw, 31, 15);
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
fn cubic(draw: Draw) -> Case {
    let y = readings(draw, 33, 10);
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
fn transition(draw: Draw) -> Case {
    let y = readings(draw, 34, 12);
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

/// y_k = a y_{k−1} + b y_{k−2} + c u_{k−1} + w_k; the state is (a, b, c).
fn arx(draw: Draw) -> Case {
    let y = readings(draw, 35, 12);
    let u: Vec<i64> = scatter(36, 12, 1000).collect();
    let past = |values: &[i64], k: usize, lag: usize| thousandths(k.checked_sub(lag).map_or(0, |past| values[past]));
    let rows = (0..12).map(|k| [past(&y, k, 1), past(&y, k, 2), past(&u, k, 1)].join(" "));
    Draft::new("adapted/two-lags-and-input", "three coefficients by recursive least squares", &["adapted"])
        .starting("0 0 0", &multiple(3, "10"))
        .transition(&multiple(3, "1"))
        .observation_matrices(rows)
        .noise(&multiple(3, "0"), "1")
        .rule("observation", "row k is (y_{k-1}, y_{k-2}, u_{k-1}); zeros before the first reading")
        .reading(texts(&y))
}

/// Recursive least squares that forgets: multiplying the transition by 5/4 does that.
fn forgetting(draw: Draw) -> Case {
    let y = readings(draw, 37, 12);
    let rows = (0..12).map(|k: usize| thousandths(k.checked_sub(1).map_or(1000, |last| y[last])));
    Draft::new("adapted/forgetting", "recursive least squares that forgets", &["adapted"])
        .starting("0", "4")
        .transition("1.25")
        .observation_matrices(rows)
        .noise("0", "1")
        .rule("observation", "y_{k-1}; one before the first reading")
        .reading(texts(&y))
}

/// The variance of the sensor follows the last reading.
fn variance(draw: Draw) -> Case {
    let y = readings(draw, 38, 12);
    let variances = (0..12).map(|k: usize| thousandths(k.checked_sub(1).map_or(250, |last| 250 + y[last].abs() / 2)));
    Draft::new("adapted/noise-follows-data", "the noise of the sensor grows with the last reading", &["adapted"])
        .starting("0", "2")
        .varying_noise(["0.5"; 12].map(str::to_owned), variances)
        .rule("noise.observation", "0.25 + |y_{k-1}| / 2, cut to thousandths; 0.25 before the first reading")
        .reading(texts(&y))
}

/// The sign of the last reading chooses the regime.
fn switching(draw: Draw) -> Case {
    let y = readings(draw, 39, 12);
    let matrix = |k: usize| {
        if k == 11 {
            ""
        } else if y[k] >= 0 {
            "0.5 0.25; 0 0.75"
        } else {
            "1 -0.5; 0.5 0.5"
        }
    };
    Draft::new("adapted/switching-by-sign", "the transition out of k depends on the sign of y_k", &["adapted"])
        .starting("0 0", "1 0; 0 1")
        .transitions((0..12).map(matrix))
        .observation("1 0.5")
        .noise("0.25 0; 0 0.25", "0.5")
        .rule("transition", "one matrix where y_k >= 0, another where y_k < 0")
        .reading(texts(&y))
}

/// The controller answers each reading.
fn feedback(draw: Draw) -> Case {
    let y = readings(draw, 40, 12);
    Draft::new("adapted/input-by-feedback", "an unstable state that is held by u_k = -y_k", &["adapted", "unstable"])
        .starting("1", "1")
        .transition("1.5")
        .noise("0.25", "0.5")
        .input("1", y.iter().map(|&y| thousandths(-y)))
        .rule("input.vector", "-y_k")
        .reading(texts(&y))
}

/// The offset of the reading is the last reading.
fn offset(draw: Draw) -> Case {
    let y = readings(draw, 44, 10);
    let last = (0..10).map(|k: usize| thousandths(k.checked_sub(1).map_or(0, |last| y[last])));
    Draft::new("adapted/offset-follows-data", "y_k - y_{k-1}/2 is what the sensor says of the state", &["adapted"])
        .starting("0", "2")
        .transition("0.75")
        .noise("0.5", "0.5")
        .feed_through("0.5", last)
        .rule("observation_input.vector", "y_{k-1}; zero before the first reading")
        .reading(texts(&y))
}
