//! Theorems 2.1 and 3.1 of Wang and Guo without moments: F = H = R = Q = 1 and P(0) = 1, but for what is drawn with heavy tails.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{Mode, RiccatiStep};

use super::models::{number, scalar};

/// The value 2ⁿ has the probability 2⁻ⁿ, n ≥ 1: its mean is infinite. What the values up to 2ᴺ add to the mean of a function.
fn partial_mean(most: u32, of: impl Fn(i64) -> Rational) -> Rational {
    (1..=most).map(|n| of(1 << n) / ratio(1 << n, 1)).sum()
}

/// The first step with this F.
fn step(transition: i64) -> RiccatiStep<Rational> {
    let one = Matrix::identity(1);
    let mode = Mode::new(scalar(ratio(transition, 1)), one.clone(), one.clone(), one.clone()).expect("covariances");
    mode.step(&one)
}

/// |x̃(1)| = |F(1 − LH)x̃(0) + w − FLv|
fn error(transition: i64, start: i64, process: i64, sensor: i64) -> Rational {
    let step = step(transition);
    let read = ratio(transition, 1) * number(&step.gain) * ratio(sensor, 1);
    let value = number(&step.closed_loop) * ratio(start, 1) + ratio(process, 1) - read;
    if value < ratio(0, 1) { -value } else { value }
}

/// WG-T2.1: without moments of F the first factor of the products has no mean of its absolute value, and no bound Mλ.
#[test]
fn stable_products_need_moments_of_the_transition() {
    for most in 1..30 {
        assert_eq!(partial_mean(most, |f| number(&step(f).closed_loop)), ratio(i64::from(most), 2));
    }
}

/// WG-T3.1: without moments of F, of the start, of the noise of the state, or of that of the sensor, x̃(1) has no mean; the others are
/// fixed.
#[test]
fn bounded_errors_need_moments_of_everything() {
    for most in 1..30 {
        let half = ratio(i64::from(most), 2);
        assert_eq!(partial_mean(most, |f| error(f, 1, 0, 0)), half);
        assert_eq!(partial_mean(most, |x| error(1, x, 0, 0)), half);
        assert_eq!(partial_mean(most, |w| error(1, 0, w, 0)), ratio(i64::from(most), 1));
        assert_eq!(partial_mean(most, |v| error(1, 0, 0, v)), half);
    }
}
