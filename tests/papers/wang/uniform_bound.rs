//! Theorem 1.1: a bound on every path, and what happens without each of its hypotheses.

use exact_kalman::gaussian::{Gaussian, Polynomial};
use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{BoundError, CovarianceLaw, Mode, ModeProcess, Window};

use super::{Q, integer_mode, scalar, scalar_mode};

fn two_to_the(k: u32) -> Rational {
    ratio(2_i64.pow(k), 1)
}

/// A state that grows in two directions, and one of two sensors at random.
fn two_sensors() -> ModeProcess<Rational> {
    let transition = Matrix::from_rows(vec![vec![ratio(5, 4), ratio(1, 1)], vec![ratio(0, 1), ratio(11, 10)]]);
    let transition = transition.expect("rows of one length");
    let read = |h: [i64; 2], r| {
        let noise = Matrix::identity(2).scaled(&ratio(1, 2));
        Mode::new(transition.clone(), Matrix::from_integers(&[h]), noise, scalar(ratio(r, 1))).expect("covariances")
    };
    ModeProcess::independent(vec![read([1, 0], 1), read([1, 1], 2)], vec![ratio(1, 2), ratio(1, 2)]).expect("law")
}

/// WG-T1.1, WG-A1, WG-D1.1: two sensors at random on a growing state. A1 holds with h = 2, no path leaves the trace
/// 1905509/10000, all moments stay below its powers, and the largest of 2⁸ paths from P(0) = 1000 I comes near it.
#[test]
fn two_sensors_bound_a_growing_state() {
    let process = two_sensors();
    assert!(!process.modes()[0].transition().spectral_radius_lt(&ratio(5, 4)));
    assert_eq!(process.smallest_window(Window::Shifted, 100).expect("few subspaces").length(), Some(2));
    let bound = process.uniform_bound(2, 100).expect("observable");
    let most = bound.worst().covariance.trace();
    assert_eq!(most, ratio(1_905_509, 10_000));
    let mut law =
        CovarianceLaw::start(&process, Matrix::identity(2).scaled(&ratio(1000, 1)), 1000).expect("covariance");
    let mut worst = ratio(0, 1);
    for k in 1..=8 {
        law.advance().expect("few states");
        if k >= 2 {
            for state in law.states() {
                let above = bound.after(&state.path).expect("two modes");
                state.covariance.loewner_le(above).expect("below the bound");
            }
            worst = worst.max(law.worst().covariance.trace());
            assert!(law.mean().trace() < most && law.mean_power(2).trace() < &most * &most);
        }
    }
    assert_eq!(law.states().len(), 256);
    assert!(worst > ratio(16_918, 100) && worst < ratio(16_920, 100) && worst < most);
}

/// Erratum WG-T1.1: P(k) for F = H = R = 1 with Q(k) between 1 and 5 stays below max Q + R, whatever P(0); with Q(k) = 2ᵏ, which
/// the printed hypotheses allow, P(k+1) ≥ 2ᵏ.
/// WG-QR: so does R(k) = 16ᵏ with F = 2: P(1) = 3, P(2) = 211/19, and P(k) ≥ (3/7)·4ᵏ, as 4ᵏ/P(k) grows by at most 4⁻ᵏ.
#[test]
fn without_upper_bounds_of_the_noise_the_theorem_fails() {
    let step = |f: i64, q: Rational, r: Rational, p: &Q| scalar_mode([ratio(f, 1), ratio(1, 1), q, r]).step(p).next;
    let gramian = |f| {
        let process = ModeProcess::independent(vec![integer_mode([f, 1, 1, 1])], vec![ratio(1, 1)]).expect("law");
        process.gramian_margin(Window::Shifted, 1, 10).expect("G = 1")
    };
    assert_eq!((gramian(1), gramian(2)), (ratio(1, 2), ratio(1, 2)));
    let (mut bounded, mut growing) = (scalar(ratio(1000, 1)), scalar(ratio(1000, 1)));
    for k in 0..20_u32 {
        bounded = step(1, ratio(1 + i64::from(k % 5), 1), ratio(1, 1), &bounded);
        assert!(bounded[(0, 0)] <= ratio(6, 1));
        growing = step(1, two_to_the(k), ratio(1, 1), &growing);
        assert!(growing[(0, 0)] >= two_to_the(k));
    }
    let mut vague = vec![scalar(ratio(1, 1))];
    for k in 0..12_u32 {
        let next = step(2, ratio(1, 1), two_to_the(4 * k), &vague[vague.len() - 1]);
        assert!(next[(0, 0)] >= ratio(3, 7) * two_to_the(2 * (k + 1)));
        vague.push(next);
    }
    assert_eq!(vague[1..3], [scalar(ratio(3, 1)), scalar(ratio(211, 19))]);
}

/// Erratum WG-QR: a random variance makes the noise no Gaussian. With a known one E w⁴ = 3 (E w²)², here at 2; with Q(k) = 1 or
/// 3, each with probability 1/2, E w² is 2 as well and E w⁴ = 15, not 12.
#[test]
fn a_random_variance_makes_no_gaussian() {
    let fourth = |variance: i64| {
        let law = Gaussian::new(scalar(ratio(0, 1)), scalar(ratio(variance, 1))).expect("a variance");
        law.expectation(&Polynomial::term(ratio(1, 1), vec![4])).expect("a variance")
    };
    assert_eq!(fourth(2), ratio(3, 1) * ratio(2 * 2, 1));
    let mixed = (fourth(1) + fourth(3)) * ratio(1, 2);
    assert_eq!(mixed, ratio(15, 1));
    assert_ne!(mixed, ratio(3, 1) * ratio(2 * 2, 1));
}

/// WG-T1.1, WG-A2, WG-A2ii: without moments of F the theorem fails: F(k) = 2ⁿ with probability 2⁻ⁿ, n ≥ 1, and H = Q = R = 1
/// make E P(k+1) infinite: of F up to 2ᴺ alone it is more than 2ᴺ − 1, as P(k) ≥ 1 and so F²P/(P + 1) ≥ F²/2.
#[test]
fn without_moments_of_the_transition_the_mean_is_infinite() {
    let smallest = scalar(ratio(1, 1));
    let mut part = ratio(0, 1);
    for n in 1..20 {
        let mode = scalar_mode([two_to_the(n), ratio(1, 1), ratio(1, 1), ratio(1, 1)]);
        part += mode.step(&smallest).next[(0, 0)].clone() / two_to_the(n);
        assert!(part > two_to_the(n) - ratio(1, 1));
    }
}

/// WG-T1.1, WG-A1: where A1 fails there is no bound but the path that is to blame; where there are too many paths, neither.
#[test]
fn without_a_window_there_is_no_bound() {
    let modes = vec![integer_mode([2, 0, 1, 1]), integer_mode([2, 1, 1, 1])];
    let process = ModeProcess::independent(modes, vec![ratio(1, 4), ratio(3, 4)]).expect("law");
    let Err(BoundError::Unobservable(path)) = process.uniform_bound(3, 100) else { panic!("A1 fails") };
    assert_eq!(path.modes, [0, 0, 0]);
    let too_many = two_sensors().uniform_bound(8, 100);
    assert_eq!(too_many, Err(BoundError::TooManyPaths { length: 8, limit: 100 }));
    assert_eq!(two_sensors().uniform_bound(6, 100).map(|bound| bound.windows.len()), Ok(64));
    assert_eq!(two_sensors().uniform_bound(2, 100).expect("a bound").after(&[1]), None);
}
