//! One step of the equation, and its Lyapunov form.

use exact_kalman::matrix::Matrix;

use super::draws::{mode, sizes};
use super::integer_mode;
use crate::dice::Dice;

/// WG-1, WG-52, WG-53: the Riccati step is the Lyapunov form at the gain of the filter, and no more than it at any other gain.
#[test]
fn the_lyapunov_form_is_least_at_the_gain_of_the_filter() {
    let mut dice = Dice(1);
    let mut larger = 0;
    for _ in 0..200 {
        let (d, m) = sizes(&mut dice);
        let (mode, covariance) = (mode(&mut dice, d, m), dice.semidefinite(d));
        let step = mode.step(&covariance);
        assert_eq!(mode.lyapunov(&covariance, &step.gain), step.next);
        assert_eq!(step.closed_loop.congruence(&covariance) + &step.noise, step.next);
        let other = mode.lyapunov(&covariance, &dice.matrix(d, m));
        step.next.loewner_le(&other).expect("any gain bounds from above");
        larger += usize::from(step.next != other);
    }
    assert!(larger > 100, "{larger}");
}

/// WG-1: where H P Hᵀ + R is singular the pseudo-inverse stands: a state that is known without noise stays known.
#[test]
fn without_noise_the_bracket_may_be_singular() {
    let mode = integer_mode([2, 1, 0, 0]);
    assert_eq!(mode.step(&Matrix::zeros(1, 1)).next, Matrix::zeros(1, 1));
    assert_eq!(mode.step(&Matrix::identity(1)).next, Matrix::zeros(1, 1));
}
