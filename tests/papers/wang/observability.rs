//! Stochastic observability: what it says, and what the printed window asks beyond it.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{Mode, ModeProcess, Start, TooManySubspaces, Window};

use super::draws::{mode, sizes};
use super::{Q, integer_mode, scalar};
use crate::dice::Dice;

fn alone(mode: Mode<Rational>) -> ModeProcess<Rational> {
    ModeProcess::independent(vec![mode], vec![ratio(1, 1)]).expect("probabilities")
}

fn smallest(process: &ModeProcess<Rational>, window: Window) -> Option<usize> {
    process.smallest_window(window, 10_000).expect("few subspaces").length()
}

/// Erratum WG-A1: F = 0, H = Q = 1: P(k+1) = 1 whatever came before; the printed window sees F(k)x(k) = 0 only and fails
/// for every h, the shifted one holds with h = 1.
#[test]
fn the_printed_window_forbids_a_transition_that_forgets() {
    let process = alone(integer_mode([0, 1, 1, 1]));
    assert_eq!(process.modes()[0].step(&scalar(ratio(1000, 1))).next, scalar(ratio(1, 1)));
    assert_eq!(smallest(&process, Window::Shifted), Some(1));
    for length in 1..10 {
        assert!(process.observability(Window::Shifted, length, 1000).expect("few subspaces").holds());
        assert!(!process.observability(Window::Printed, length, 1000).expect("few subspaces").holds());
    }
    let printed = process.smallest_window(Window::Printed, 1000).expect("few subspaces");
    let [(0, Start::Never(proof))] = printed.starts.as_slice() else { panic!("{printed:?}") };
    assert!(proof.is_valid_for(&process));
}

/// WG-A1: with the shifted window, too, a state that is forgotten at once must be seen at once: F = 0 needs HᵀH > 0.
#[test]
fn what_is_forgotten_must_be_seen_at_once() {
    let nothing = Matrix::zeros(2, 2);
    let read = |h: Q| {
        let noise = Matrix::identity(h.rows());
        alone(Mode::new(nothing.clone(), h, Matrix::identity(2), noise).expect("covariances"))
    };
    assert_eq!(smallest(&read(Matrix::identity(2)), Window::Shifted), Some(1));
    assert_eq!(smallest(&read(Matrix::from_integers(&[[1, 0]])), Window::Shifted), None);
}

/// WG-A1, WG-T1.1: without it P(k) may grow: H = 0, F = Q = 1 gives P(k) = P(0) + k. With a single observation, ever, too.
#[test]
fn without_observations_the_covariance_grows() {
    let process = alone(integer_mode([1, 0, 1, 1]));
    assert_eq!(smallest(&process, Window::Shifted), None);
    let mut covariance = scalar(ratio(5, 2));
    for k in 1..20 {
        covariance = process.modes()[0].step(&covariance).next;
        assert_eq!(covariance, scalar(ratio(5, 2) + ratio(k, 1)));
    }
}

/// WG-A1: the printed condition with h implies the shifted one with h + 1, as G gains HᵀH ≥ 0; not the other way round.
#[test]
fn the_printed_condition_implies_the_shifted_one() {
    let mut dice = Dice(3);
    let (mut implied, mut only_shifted) = (0, 0);
    for _ in 0..200 {
        let (d, m) = sizes(&mut dice);
        let modes: Vec<_> = (0..=dice.size(1)).map(|_| mode(&mut dice, d, m)).collect();
        let count = i64::try_from(modes.len()).expect("small");
        let law = vec![ratio(1, count); modes.len()];
        let process = ModeProcess::independent(modes, law).expect("probabilities");
        for length in 1..4 {
            let holds = |window, length| process.observability(window, length, 10_000).expect("few subspaces").holds();
            let (printed, shifted) = (holds(Window::Printed, length), holds(Window::Shifted, length + 1));
            assert!(shifted || !printed);
            implied += usize::from(printed);
            only_shifted += usize::from(shifted && !printed);
        }
    }
    assert!(implied > 100 && only_shifted > 5, "{implied} {only_shifted}");
}

/// WG-A1: an unobservable line that turns by an angle that is no fraction of a circle takes infinitely many positions, and
/// the answer comes all the same: there is a loop that sees nothing at all.
#[test]
fn a_line_that_turns_for_ever_does_not_turn_the_search() {
    let turn =
        || Matrix::from_rows(vec![vec![ratio(3, 5), ratio(-4, 5)], vec![ratio(4, 5), ratio(3, 5)]]).expect("rows");
    let read = |h: Q| Mode::new(turn(), h, Matrix::identity(2), Matrix::identity(1)).expect("covariances");
    let (seen, unseen) = (read(Matrix::from_integers(&[[1, 0]])), read(Matrix::zeros(1, 2)));
    // Either may come for ever.
    let free =
        ModeProcess::independent(vec![seen.clone(), unseen.clone()], vec![ratio(1, 2), ratio(1, 2)]).expect("law");
    let verdict = free.smallest_window(Window::Shifted, 100).expect("few subspaces");
    assert!(verdict.starts.iter().all(|(_, start)| matches!(start, Start::Never(proof) if proof.is_valid_for(&free))));
    // At most two losses between observations: the turn never brings the line back, so two observations see everything.
    let rows = [[0, 2, 0], [1, 0, 1], [2, 0, 0]];
    let chain = Matrix::from_fn(3, 3, |i, j| ratio(rows[i][j], 2));
    let rare =
        ModeProcess::markov(vec![seen, unseen.clone(), unseen], vec![ratio(1, 1), ratio(0, 1), ratio(0, 1)], chain)
            .expect("law");
    let verdict = rare.smallest_window(Window::Shifted, 100).expect("few subspaces");
    let lengths: Vec<_> = verdict
        .starts
        .iter()
        .map(|(_, start)| if let Start::Observable { length, .. } = start { *length } else { 0 })
        .collect();
    // seen, lost, lost, seen; lost, lost, seen, lost, lost, seen; lost, seen, lost, lost, seen.
    assert_eq!(lengths, [4, 6, 5]);
}

/// WG-A1: a search that is not finished says so, and how far it came.
#[test]
fn a_search_that_is_cut_short_says_so() {
    let process = alone(integer_mode([2, 0, 1, 1]));
    assert_eq!(process.smallest_window(Window::Shifted, 0), Err(TooManySubspaces { limit: 0, length: 0 }));
    assert_eq!(process.observability(Window::Shifted, 5, 3), Err(TooManySubspaces { limit: 3, length: 3 }));
    assert!(process.observability(Window::Shifted, 5, 5).is_ok());
}
