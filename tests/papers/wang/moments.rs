//! Norms of random matrices, and the conditions on moments.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{CovarianceLaw, ModeProcess};

use super::draws::{mode, sizes};
use super::{Q, integer_mode, scalar_mode};
use crate::dice::Dice;

fn power(base: &Rational, exponent: u32) -> Rational {
    (0..exponent).fold(ratio(1, 1), |power, _| power * base)
}

/// WG-D1.1: `‖P‖ˢ ≤ tr Pˢ ≤ d‖P‖ˢ` for P with the eigenvalues 4 and 1, turned by an angle with sine 4/5.
#[test]
fn the_trace_of_a_power_stands_for_the_power_of_the_norm() {
    let turn = Matrix::from_rows(vec![vec![ratio(3, 5), ratio(-4, 5)], vec![ratio(4, 5), ratio(3, 5)]]).expect("rows");
    let start = turn.congruence(&Matrix::diagonal(&[ratio(4, 1), ratio(1, 1)]));
    let mode = mode(&mut Dice(1), 2, 1);
    let process = ModeProcess::independent(vec![mode], vec![ratio(1, 1)]).expect("law");
    let law = CovarianceLaw::start(&process, start, 1).expect("a covariance");
    for s in 1..5 {
        assert_eq!(law.mean_power(s).trace(), power(&ratio(4, 1), s) + ratio(1, 1));
    }
}

/// WG-5: for r = 1/2 the triangle inequality fails: the indicators of two halves have norm 1/4 each, and their sum has norm 1. For r = 1 and
/// r = 2 it holds for the covariances that a process takes (for r = 2 it is (E xy)² ≤ E x² E y²), whose means the law computes.
#[test]
fn the_norm_is_one_from_order_one_on() {
    let modes = [integer_mode([2, 0, 1, 1]), integer_mode([1, 3, 2, 1])];
    let process = ModeProcess::independent(modes.to_vec(), vec![ratio(1, 3), ratio(2, 3)]).expect("a process");
    let mut law = CovarianceLaw::start(&process, Matrix::identity(1), 100).expect("a start");
    for _ in 0..3 {
        law.advance().expect("few");
        let of = |exponent| law.mean_power(exponent)[(0, 0)].clone();
        assert!(&of(1) * &of(1) < of(2), "Schwarz, strictly, as p takes several values");
        assert!(&of(2) * &of(2) < &of(1) * &of(3));
        let shifted = law.expectation(|p| (&p[(0, 0)] + ratio(1, 1)) * (&p[(0, 0)] + ratio(1, 1)));
        // ‖p + 1‖₂ ≤ ‖p‖₂ + 1, squared twice: the rest is 2 E p ≤ 2 ‖p‖₂.
        let rest = shifted - of(2) - ratio(1, 1);
        assert!(&rest * &rest <= of(2) * ratio(4, 1));
    }
    // Roots of 0 and 1 are 0 and 1; {E √x}² for r = 1/2.
    let half_norm = |values: [i64; 2]| power(&values.iter().map(|value| ratio(*value, 2)).sum(), 2);
    let [one, other, sum] = [[1, 0], [0, 1], [1, 1]].map(half_norm);
    assert_eq!((&one, &other, &sum), (&ratio(1, 4), &ratio(1, 4), &ratio(1, 1)));
    assert!(sum > one + other);
}

/// E[F(k+h−1)^e ⋯ F(k)^e | mode of k−1], by all paths.
fn conditional(process: &ModeProcess<Rational>, last: usize, steps: usize, exponent: u32) -> Rational {
    if steps == 0 {
        return ratio(1, 1);
    }
    process
        .successors(last)
        .map(|next| {
            let factor = power(&process.modes()[next].transition()[(0, 0)], exponent);
            &process.transition()[(last, next)] * factor * conditional(process, next, steps - 1, exponent)
        })
        .sum()
}

/// WG-A2, WG-A2i, WG-A2ii, WG-A2ii-conditional, WG-A2-remark: with finitely many modes all three hold with any r and κ: the moments
/// of Φ over two steps, given any mode, are (P·diag(Fᵉ))²·1, at most max Fᵉ squared; and those of H at most the largest of
/// its powers.
#[test]
fn finitely_many_modes_have_all_moments() {
    let modes = [[3, 1], [-1, 2], [0, 0]].map(|[f, h]| integer_mode([f, h, 1, 1]));
    let rows = [[1, 2, 1], [0, 2, 2], [4, 0, 0]];
    let chain = Matrix::from_fn(3, 3, |i, j| ratio(rows[i][j], 4));
    let first = vec![ratio(1, 2), ratio(1, 4), ratio(1, 4)];
    let process = ModeProcess::markov(modes.to_vec(), first.clone(), chain.clone()).expect("law");
    for exponent in [8, 16, 17] {
        let factors: Vec<Rational> = modes.iter().map(|mode| power(&mode.transition()[(0, 0)], exponent)).collect();
        let once = &chain * Matrix::diagonal(&factors);
        let ones = Matrix::column(vec![ratio(1, 1); 3]);
        let given: Q = &once * (&once * ones);
        let most = power(&ratio(3, 1), 2 * exponent);
        for last in 0..3 {
            let moment = conditional(&process, last, 2, exponent);
            assert_eq!(moment, given[(last, 0)]);
            assert!(moment <= most);
        }
        let mut law = first.clone();
        for _ in 0..5 {
            let of_h: Rational =
                law.iter().zip(&modes).map(|(p, mode)| p * power(&mode.observation()[(0, 0)], exponent)).sum();
            assert!(of_h <= power(&ratio(2, 1), exponent));
            law = (0..3).map(|to| (0..3).map(|from| &law[from] * &chain[(from, to)]).sum()).collect();
        }
    }
}

/// WG-A2i: a large H(k) does no harm: made smaller by a factor, it never makes P(k+1) smaller.
#[test]
fn a_larger_observation_matrix_only_helps() {
    let mut dice = Dice(61);
    for _ in 0..100 {
        let (d, m) = sizes(&mut dice);
        let (mode, covariance) = (mode(&mut dice, d, m), dice.semidefinite(d));
        let smaller = exact_kalman::stability::Mode::new(
            mode.transition().clone(),
            mode.observation().scaled(&ratio(1, 2)),
            mode.process_noise().clone(),
            mode.observation_noise().clone(),
        )
        .expect("covariances");
        mode.step(&covariance).next.loewner_le(&smaller.step(&covariance).next).expect("less is known");
    }
}

/// WG-A2ii-conditional: a bound in the mean is not enough for products to shrink: a factor that is 1/2 for ever, or, with
/// probability 1/100, 2 for ever, has the mean 103/200 < 1, and the mean of its products grows like 2ⁿ/100.
#[test]
fn a_bound_that_depends_on_the_path_is_not_enough() {
    let modes = vec![scalar_mode([ratio(1, 2), ratio(0, 1), ratio(1, 1), ratio(1, 1)]), integer_mode([2, 0, 1, 1])];
    let process = ModeProcess::markov(modes, vec![ratio(99, 100), ratio(1, 100)], Matrix::identity(2)).expect("law");
    let mean = |steps: usize| -> Rational {
        // From the first mode on, which is that of every later time.
        process.initial().iter().enumerate().map(|(mode, p)| p * conditional(&process, mode, steps, 1)).sum()
    };
    assert_eq!(mean(1), ratio(103, 200));
    for n in 1..20 {
        assert!(mean(n) > power(&ratio(2, 1), u32::try_from(n).expect("small")) / ratio(100, 1));
    }
    // Given the mode that shrinks it does.
    assert_eq!(conditional(&process, 0, 3, 1), ratio(1, 8));
}
