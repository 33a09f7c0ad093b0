//! Random processes off a tape.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{Mode, ModeProcess};
use proptest::collection::vec;
use proptest::prelude::*;

use super::super::systems::{Q, Tape};
use super::Process;

/// A process and a P(0).
#[derive(Clone, Debug)]
pub struct Draw {
    pub process: Process,
    pub start: Q,
}

/// At most so many modes and states; at most two sensors.
pub fn draws(modes: usize, states: usize) -> impl Strategy<Value = Draw> {
    vec(any::<i8>(), 200).prop_map(move |tape| draw(modes, states, Tape::new(tape)))
}

fn draw(modes: usize, states: usize, mut tape: Tape) -> Draw {
    let (count, d, m) = (1 + tape.choice(modes), 1 + tape.choice(states), 1 + tape.choice(2));
    let modes: Vec<_> = (0..count).map(|_| mode(&mut tape, d, m)).collect();
    let initial = law(&mut tape, count);
    let independent = tape.rarely(3);
    let rows = (0..count).map(|_| if independent { initial.clone() } else { law(&mut tape, count) }).collect();
    let transition = Matrix::from_rows(rows).expect("rows of one length");
    let process = ModeProcess::markov(modes, initial, transition).expect("probabilities");
    Draw { process, start: covariance(&mut tape, d) }
}

/// Half of the observations see one entry or nothing: else all would be observable at once.
fn mode(tape: &mut Tape, d: usize, m: usize) -> Mode<Rational> {
    let observation = match tape.choice(4) {
        0 => Matrix::zeros(m, d),
        1 => {
            let seen = tape.choice(d);
            Matrix::from_fn(m, d, |_, column| ratio(i64::from(column == seen), 1))
        }
        _ => tape.matrix(m, d),
    };
    let transition = if tape.rarely(3) { permutation(tape, d) } else { tape.matrix(d, d) };
    Mode::new(transition, observation, covariance(tape, d), covariance(tape, m)).expect("covariances")
}

/// Moves entries about, and forgets some: the unobservable part of such modes wanders.
fn permutation(tape: &mut Tape, d: usize) -> Q {
    let shift = tape.choice(d);
    let kept: Vec<bool> = (0..d).map(|_| !tape.rarely(5)).collect();
    Matrix::from_fn(d, d, |i, j| ratio(i64::from(kept[i] && (i + shift) % d == j), 1))
}

/// LLᵀ, often singular.
fn covariance(tape: &mut Tape, n: usize) -> Q {
    let rank = tape.choice(n + 1);
    let factor = tape.matrix(n, rank);
    &factor * factor.transpose()
}

/// Probabilities, about half of them zero.
fn law(tape: &mut Tape, count: usize) -> Vec<Rational> {
    let mut weights: Vec<i64> = (0..count).map(|_| [0, 0, 1, 2][tape.choice(4)]).collect();
    if weights.iter().sum::<i64>() == 0 {
        weights[tape.choice(count)] = 1;
    }
    let sum = weights.iter().sum();
    weights.into_iter().map(|weight| ratio(weight, sum)).collect()
}
