//! The critical probability of arrival.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::Mode;
use num_traits::One;

use super::{Q, scalar_mode};

fn mode(f: Q, h: Q) -> Mode<Rational> {
    let (d, m) = (f.rows(), h.rows());
    Mode::new(f, h, Matrix::identity(d).scaled(&ratio(20, 1)), Matrix::identity(m).scaled(&ratio(5, 2)))
        .expect("a mode")
}

/// The two ends of what is proved.
fn ends(mode: &Mode<Rational>, width: &Rational) -> (Rational, Rational) {
    let found = mode.critical_arrival(width).expect("a positive width");
    let gap = found.gap();
    let ends = (found.unbounded.expect("unstable").0, found.bounded.expect("observable").0);
    assert_eq!(gap, Some(&ends.1 - &ends.0));
    ends
}

/// WG-E1.1, WG-49: one state: the bracket holds 1 − 1/f², to its width.
#[test]
fn one_state_has_the_threshold_of_its_growth() {
    let width = ratio(1, 256);
    for f in [ratio(3, 2), ratio(-2, 1), ratio(11, 10), ratio(7, 1)] {
        let mode = scalar_mode([f.clone(), ratio(1, 2), ratio(1, 1), ratio(3, 1)]);
        let exact = mode.scalar_critical_arrival().expect("one state, observed");
        assert_eq!(exact, Rational::one() - f.pow(-2));
        let (lower, upper) = ends(&mode, &width);
        assert!(lower <= exact && exact <= upper && &upper - &lower <= &width * ratio(2, 1), "{f}: {lower} {upper}");
    }
    let stable = scalar_mode([ratio(1, 2), ratio(1, 1), ratio(1, 1), ratio(1, 1)]);
    assert_eq!(stable.scalar_critical_arrival(), Some(ratio(0, 1)));
    let found = stable.critical_arrival(&width).expect("a positive width");
    assert!(found.unbounded.is_none() && found.bounded.expect("stable").0 == ratio(0, 1));
    let blind = scalar_mode([ratio(2, 1), ratio(0, 1), ratio(1, 1), ratio(1, 1)]);
    let found = blind.critical_arrival(&width).expect("a positive width");
    assert!(found.bounded.is_none() && found.unbounded.expect("never observed").0 == ratio(1, 1));
    assert_eq!(stable.critical_arrival(&ratio(0, 1)), None);
}

/// WG-E1.1: if H is invertible the proofs meet at 1 − 1/ρ(F)².
#[test]
fn with_an_invertible_observation_both_sides_meet() {
    let width = ratio(1, 128);
    // Eigenvalues 3/2 and 5/4; then 1 ± i, of modulus √2.
    for (f, squared) in [
        (vec![vec![ratio(3, 2), ratio(1, 1)], vec![ratio(0, 1), ratio(5, 4)]], ratio(9, 4)),
        (vec![vec![ratio(1, 1), ratio(1, 1)], vec![ratio(-1, 1), ratio(1, 1)]], ratio(2, 1)),
    ] {
        let mode = mode(Matrix::from_rows(f).expect("square"), Matrix::from_integers(&[[1, 2], [0, 1]]));
        let exact = Rational::one() - squared.recip();
        let (lower, upper) = ends(&mode, &width);
        assert!(lower <= exact && exact <= upper && &upper - &lower <= &width * ratio(2, 1), "{lower} {upper}");
    }
}

/// WG-E1.1: F = [[5/4, 0], [1, 11/10]], H = [1, 1] (Sinopoli and others 2004): unbounded up to 1 − (4/5)² = 9/25, bounded from
/// 1 − (5/4 · 11/10)⁻² = 57/121 on, the least that constant gains for one sensor can do (Elia 2005); between them no proof.
#[test]
fn the_example_of_two_states_has_a_gap() {
    let mode = mode(
        Matrix::from_rows(vec![vec![ratio(5, 4), ratio(0, 1)], vec![ratio(1, 1), ratio(11, 10)]]).expect("square"),
        Matrix::from_integers(&[[1, 1]]),
    );
    let width = ratio(1, 128);
    let (lower, upper) = ends(&mode, &width);
    assert!(lower <= ratio(9, 25) && ratio(9, 25) <= &lower + &width, "{lower}");
    assert!(ratio(57, 121) <= upper && &upper - &width <= ratio(57, 121), "{upper}");
}

/// WG-E1.1: an unstable direction that is never observed leaves no threshold; a stable one does not matter.
#[test]
fn only_unstable_directions_must_be_observed() {
    let width = ratio(1, 128);
    let diagonal = |a: Rational, b: Rational| mode(Matrix::diagonal(&[a, b]), Matrix::from_integers(&[[1, 0]]));
    let hidden = diagonal(ratio(3, 2), ratio(5, 4)).critical_arrival(&width).expect("a positive width");
    assert!(hidden.bounded.is_none() && hidden.gap().is_none());
    assert_eq!(hidden.unbounded.expect("never observed").0, ratio(1, 1));
    let (lower, upper) = ends(&diagonal(ratio(3, 2), ratio(1, 2)), &width);
    assert!(lower <= ratio(5, 9) && ratio(5, 9) <= upper && upper - lower <= width * ratio(2, 1));
}
