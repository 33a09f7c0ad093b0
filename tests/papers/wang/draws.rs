//! Random modes with small entries.

use exact_kalman::scalar::Rational;
use exact_kalman::stability::Mode;

use crate::dice::Dice;

/// d ≤ 3 and m ≤ 2.
pub fn sizes(dice: &mut Dice) -> (usize, usize) {
    (1 + dice.size(2), 1 + dice.size(1))
}

/// d×d and m×d, Q > 0 and R > 0.
pub fn mode(dice: &mut Dice, d: usize, m: usize) -> Mode<Rational> {
    let (transition, observation) = (dice.matrix(d, d), dice.matrix(m, d));
    Mode::new(transition, observation, dice.positive_definite(d), dice.positive_definite(m))
        .expect("shapes fit and covariances are some")
}
