//! The conditions B1, C1 and C2 on moments.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use num_traits::One;

use super::constants::Constants;
use super::window::{begin, mean, settings, windows};

/// WG-B1, WG-B1i, WG-B1ii: with finitely many modes all conditional moments have one bound; here on every path, window by window. Moments
/// that are bounded on average only, as WG-A2 asks, are not enough for it: a value drawn once and kept.
#[test]
fn conditional_moments_have_one_bound() {
    for (setting, root, last) in settings() {
        let constants = Constants::of(&setting, root);
        for k in 1..=last {
            for (_, whole) in windows(&setting, k) {
                let (begin, end) = (begin(&setting, k), k * setting.h + 1);
                for i in begin..end {
                    let moment = mean(whole.iter().map(|(path, w)| (w, setting.at(path, i).h.pow(8))));
                    assert!(moment < constants.g.pow(8));
                    for j in begin..=i {
                        assert!(
                            mean(whole.iter().map(|(path, w)| (w, setting.phi(path, i, j).pow(16))))
                                < constants.c.pow(16)
                        );
                    }
                }
            }
        }
    }
    // H(k) = H(0) = 2ⁿ with probability proportional to 2^(−20n): E H¹⁶ is a convergent series, and given 𝒢(0) E H⁸ = 2^(8n).
    let moment = |n: i32| ratio(2, 1).pow(-20 * n) * ratio(2, 1).pow(16 * n);
    assert!((0..40).map(moment).sum::<Rational>() < ratio(16, 15));
}

/// WG-C1, WG-C1i, WG-C1ii, WG-C1ii-conditional: with finitely many modes all hold; each implies its half (Jensen), on all paths of the settings.
#[test]
fn the_conditions_of_section_3_are_those_of_section_1_with_2r() {
    let r = 1;
    for (setting, root, last) in settings() {
        let constants = Constants::of(&setting, root);
        let paths = setting.paths(last * setting.h + 1);
        let moment = |of: &dyn Fn(&[usize]) -> Rational, power: i32| {
            mean(paths.iter().map(|(path, w)| (w, of(path).pow(power))))
        };
        for k in 0..=(last - 1) * setting.h {
            let of_h = |power| moment(&|path| setting.at(path, k).h.clone(), power);
            assert!(of_h(32 * r) < constants.g.pow(32 * r) && of_h(16 * r).pow(2) <= of_h(32 * r));
            for i in k..=k + setting.h {
                for j in k..=i {
                    let of_phi = |power| moment(&|path| setting.phi(path, i, j), power);
                    // κ = 2 in WG-C1, 1 in WG-A2.
                    assert!(of_phi(32 * r + 2) <= Rational::one() && of_phi(16 * r).pow(2) <= of_phi(32 * r));
                }
            }
            for (path, _) in setting.paths(k) {
                let conditional = |power: i32| {
                    let rest = setting.continuations(&path, setting.h);
                    let phi = |rest: &[usize]| setting.phi(rest, setting.h, 0).pow(power);
                    mean(rest.iter().map(|(rest, w)| (w, phi(rest))))
                };
                assert!(conditional(16 * r) <= Rational::one() && conditional(8 * r).pow(2) <= conditional(16 * r));
            }
        }
    }
}

/// WG-C2: E‖w‖²ʳ bounds tr Q(k) and E‖v‖⁴ʳ bounds tr R(k), for noise that takes any few values.
#[test]
fn moments_of_the_noise_bound_its_covariance() {
    let mut dice = crate::dice::Dice(7);
    for _ in 0..100 {
        let (values, count) = (1 + dice.size(3), 1 + dice.size(2));
        let points: Vec<Matrix<Rational>> = (0..values).map(|_| dice.matrix(count, 1)).collect();
        // The law is uniform on the points and their negatives, so the mean is zero.
        let share = ratio(1, i64::try_from(values).expect("small"));
        let zero = Matrix::zeros(count, count);
        let covariance = points.iter().fold(zero, |sum, w| sum + (w * w.transpose()).scaled(&share));
        let trace: Rational = (0..count).map(|i| covariance[(i, i)].clone()).sum();
        let moment = |half: i32| points.iter().map(|w| w.squared_norm().pow(half) * &share).sum::<Rational>();
        assert_eq!(moment(1), trace);
        for r in 1..=3 {
            assert!(trace.pow(r) <= moment(r) && trace.pow(2 * r) <= moment(2 * r));
        }
    }
}
