//! Known inputs that are left out, or come with the other sign.

use super::{Change, each_step};
use crate::matrix::Matrix;
use crate::model::Step;
use crate::scalar::Rational;

fn on_input(of_state: bool, change: fn(&Matrix<Rational>) -> Matrix<Rational>) -> Change {
    Box::new(move |path| {
        Some(each_step(path, |step: &mut Step<Rational>| {
            let input = match &mut step.transition {
                Some(transition) if of_state => Some(&mut transition.input),
                _ if of_state => None,
                _ => Some(&mut step.observation_input),
            };
            if let Some(input) = input {
                *input = change(input);
            }
        }))
    })
}

/// Without the input of the state, or that of the observation.
pub(in super::super) fn without(of_state: bool) -> Change {
    on_input(of_state, |input| Matrix::zeros(input.rows(), input.columns()))
}

/// With the other sign of the one or the other.
pub(in super::super) fn negated(of_state: bool) -> Change {
    on_input(of_state, |input| -input)
}
