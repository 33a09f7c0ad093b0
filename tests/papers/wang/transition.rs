//! Products of transitions, and what they carry.

use exact_kalman::matrix::Matrix;
use exact_kalman::stability::{inverse_transition_matrix, transition_matrix};

use super::sources::Sources;
use crate::dice::Dice;

/// WG-Phi: Φ(k,i) by its factors written out, its semigroup, and its inverse, which exists exactly if no F(j), i ≤ j < k, is singular;
/// else the latest singular one is named.
#[test]
fn products_and_their_inverses() {
    let (mut dice, mut refused) = (Dice(11), 0);
    for _ in 0..150 {
        let Sources { path, initial_mean, .. } = Sources::random(&mut dice, 4);
        let identity = Matrix::identity(initial_mean.rows());
        let f = |k: usize| path[k].transition();
        assert_eq!(transition_matrix(&path, 4..4), identity);
        assert_eq!(transition_matrix(&path, 2..3), *f(2));
        assert_eq!(transition_matrix(&path, 1..4), f(3) * f(2) * f(1));
        let halves = transition_matrix(&path, 2..4) * transition_matrix(&path, 0..2);
        assert_eq!(transition_matrix(&path, 0..4), halves);
        let singular =
            (1..4).rev().find(|&k| f(k).determinant().expect("a field") == exact_kalman::scalar::ratio(0, 1));
        match (inverse_transition_matrix(&path, 1..4), singular) {
            (Ok(inverse), None) => assert_eq!(inverse * transition_matrix(&path, 1..4), identity),
            (Err(error), Some(time)) => {
                assert_eq!((error.time, error.rank), (time, f(time).rank()));
                refused += 1;
            }
            (found, expected) => panic!("{found:?} where {expected:?} is singular"),
        }
    }
    assert!((20..130).contains(&refused), "{refused}");
}

/// WG-7, WG-8, WG-16, WG-17: the state by that of an earlier time and the noise between, coefficient by coefficient; the readings
/// by the state.
#[test]
fn the_state_by_an_earlier_one() {
    let mut dice = Dice(12);
    for _ in 0..40 {
        let sources = Sources::random(&mut dice, 4);
        let (path, states) = (&sources.path, sources.states());
        for k in 0..=4 {
            for i in k..=4 {
                let carried = transition_matrix(path, k..i) * &states[k];
                let sum = (k + 1..=i).fold(carried, |sum, j| sum + transition_matrix(path, j..i) * sources.w(j));
                assert_eq!(sum, states[i]);
            }
        }
        for (k, reading) in sources.readings().iter().enumerate() {
            assert_eq!(&(path[k].observation() * &states[k] + sources.v(k)), reading);
        }
    }
}
