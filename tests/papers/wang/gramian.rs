//! The Gramian of a window, and whether it is good.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::ratio;
use exact_kalman::stability::{Window, excites, gramian};
use num_traits::Signed;

use super::draws::mode;
use super::sources::Sources;
use super::{Q, integer_mode};
use crate::dice::Dice;

const WINDOWS: [Window; 2] = [Window::Shifted, Window::Printed];

/// WG-6: by the definition, for both windows and every start; and the backward form `G(k+h,k) = HᵀH + Fᵀ G(k+h,k+1) F` of the shifted
/// one, which is that of the printed one between the two transitions.
#[test]
fn sums_over_both_windows() {
    let mut dice = Dice(21);
    for _ in 0..100 {
        let Sources { path, .. } = Sources::random(&mut dice, 5);
        let f = |k: usize| path[k].transition();
        let square = |h: Q| h.transpose() * &h;
        let h = |k: usize| path[k].observation();
        let shifted = square(h(1).clone()) + square(h(2) * f(1)) + square(h(3) * f(2) * f(1));
        assert_eq!(gramian(&path, Window::Shifted, 1, 3), shifted);
        let printed = square(h(2) * f(1)) + square(h(3) * f(2) * f(1)) + square(h(4) * f(3) * f(2) * f(1));
        assert_eq!(gramian(&path, Window::Printed, 1, 3), printed);
        let inner = gramian(&path, Window::Shifted, 2, 3);
        assert_eq!(gramian(&path, Window::Printed, 1, 3), f(1).transpose() * &inner * f(1));
        assert_eq!(gramian(&path, Window::Shifted, 1, 4), square(h(1).clone()) + f(1).transpose() * inner * f(1));
    }
}

/// WG-A-delta: λ_min(G) > δ by the signs of the characteristic polynomial of G − δI, whose roots are real: all are positive exactly if
/// its signs alternate strictly. Where it is false the direction proves it.
#[test]
fn good_windows() {
    let (mut dice, mut good, mut met) = (Dice(22), 0, 0);
    for _ in 0..100 {
        let Sources { path, .. } = Sources::random(&mut dice, 4);
        for window in WINDOWS {
            let found = gramian(&path, window, 0, 3);
            for threshold in [ratio(0, 1), ratio(1, 2), ratio(7, 1), found[(0, 0)].clone()] {
                let shifted = &found - Matrix::identity(found.rows()).scaled(&threshold);
                let polynomial = shifted.characteristic_polynomial();
                let alternates = polynomial.windows(2).all(|pair| (&pair[0] * &pair[1]).is_negative());
                match excites(&found, &threshold) {
                    Ok(()) => good += 1,
                    Err(unseen) => {
                        let form = |middle: &Q| unseen.direction.transpose().congruence(middle)[(0, 0)].clone();
                        assert_eq!(form(&found), unseen.value);
                        assert!(!unseen.direction.is_zero() && !form(&shifted).is_positive());
                        met += usize::from(form(&shifted) == ratio(0, 1));
                    }
                }
                assert_eq!(excites(&found, &threshold).is_ok(), alternates);
            }
        }
    }
    assert!(good > 100 && met > 50, "{good} {met}");
}

/// WG-A-delta: with the shifted window the event is known at time k+h−1, and F(k+h−1) does not matter; with the printed one it depends
/// on H(k+h).
#[test]
fn what_the_event_depends_on() {
    let path = |last: i64| [integer_mode([1, 1, 1, 1]), integer_mode([2, 0, 1, 1]), integer_mode([1, last, 1, 1])];
    let at = |window, last| excites(&gramian(&path(last), window, 0, 2), &ratio(2, 1)).is_ok();
    assert_eq!([0, 3].map(|last| at(Window::Shifted, last)), [false, false]);
    assert_eq!([0, 3].map(|last| at(Window::Printed, last)), [false, true]);
    let mut dice = Dice(23);
    for _ in 0..50 {
        let (d, m) = super::draws::sizes(&mut dice);
        let mut path: Vec<_> = (0..3).map(|_| mode(&mut dice, d, m)).collect();
        let before = gramian(&path, Window::Shifted, 0, 2);
        path[2] = mode(&mut dice, d, m);
        path[1] = exact_kalman::stability::Mode::new(
            dice.matrix(d, d),
            path[1].observation().clone(),
            path[1].process_noise().clone(),
            path[1].observation_noise().clone(),
        )
        .expect("as before");
        assert_eq!(gramian(&path, Window::Shifted, 0, 2), before);
    }
}
