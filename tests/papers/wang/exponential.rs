//! Theorem 2.1 and the end of its proof: products, their means over all paths, and the constants of the proof.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{Contraction, Drift, MomentVerdict};
use num_traits::{One, Zero};

use super::constants::Constants;
use super::window::{Setting, mean, settings};

/// α of WG-L2.1 and β of it, as WG-64 finds them.
fn drift(setting: &Setting, constants: &Constants) -> Drift {
    let rho = constants.rho(setting);
    let new = (constants.beta(setting) + constants.gamma(setting)) / setting.floor();
    Drift::new(rho.clone(), Rational::one() - &rho + new).expect("ρ₁ < 1")
}

/// λ and M of WG-65 for the settings, from WG-L2.1 alone; M for products that begin with a(1) or later.
fn decay(setting: &Setting, root: Rational) -> (Contraction, Rational) {
    let constants = Constants::of(setting, root);
    let drift = drift(setting, &constants);
    let contraction = drift.contraction();
    let first = mean(
        setting
            .paths(setting.h + 1)
            .iter()
            .map(|(path, w)| (w, Rational::one() + &setting.observer_variances(path)[0] / setting.floor())),
    );
    let constant = drift.constant(&contraction, &first);
    (contraction, constant)
}

/// WG-65, WG-67, WG-67-rate: products of 1 − 1/a and of the covariances, their means over all paths.
#[test]
fn products_decay_as_the_drift_says() {
    for (setting, root, last) in settings() {
        let h = setting.h;
        let (contraction, constant) = decay(&setting, root);
        let (rate, floor, one) = (contraction.rate, setting.floor(), Rational::one());
        // M for m ≥ 0.
        let constant = constant / &rate;
        let paths = setting.paths(last * h + 1);
        let walked: Vec<_> = paths
            .iter()
            .map(|(path, w)| (w, setting.observer_variances(path), setting.variances(path), setting.ratios(path)))
            .collect();
        let power = |n: usize| rate.pow(i32::try_from(n).expect("short"));
        for m in 0..=last {
            for n in m..=last {
                let product = |z: &[Rational]| z[m..=n].iter().map(|z| &one - (&one + z / &floor).recip()).product();
                assert!(mean(walked.iter().map(|(w, z, ..)| (*w, product(z)))) <= &constant * power(n - m + 1));
            }
        }
        for k in 0..last * h {
            for t in 1..=(last * h - k) / h {
                let first = k.div_ceil(h);
                let by_ratio = mean(
                    walked
                        .iter()
                        .map(|(w, _, _, x)| (*w, x[k..k + t * h].iter().map(|x| &one - (&one + x).recip()).product())),
                );
                let at = |p: &Rational| &one - (&one + p / &floor).recip();
                let by_covariance =
                    mean(walked.iter().map(|(w, _, p, _)| (*w, (k..k + t * h).map(|i| at(&p[i + 1])).product())));
                let ends = || first + 1..first + t;
                let sparse = mean(walked.iter().map(|(w, _, p, _)| (*w, ends().map(|i| at(&p[i * h + 1])).product())));
                let by_a = mean(walked.iter().map(|(w, z, ..)| (*w, ends().map(|i| at(&z[i])).product())));
                assert!(by_ratio <= by_covariance && by_covariance <= sparse && sparse <= by_a);
                assert!(by_a <= &constant * power(t - 1));
                assert!(by_ratio <= &constant / &rate * power(t));
            }
        }
    }
}

/// WG-L2.4: the class of 1/(1 + ‖Q̄⁻¹P‖), with the rate λ₁ = λ^(1/h) of the settings; h-th powers, so that no root is needed.
///
/// Erratum WG-L2.4: the printed sequence has the rate 1/2 for every model, also where the right one has none.
#[test]
fn the_sequence_of_the_lemma_is_in_the_class() {
    let one = Rational::one();
    for (setting, root, last) in settings() {
        let (contraction, constant) = decay(&setting, root);
        // C = M/λ with M for m ≥ 0, and M of WG-L2.3 is C/λ₁^h = C/λ.
        let constant = constant / contraction.rate.pow(3);
        let h = i32::try_from(setting.h).expect("small");
        let paths = setting.paths(last * setting.h + 1);
        let ratios: Vec<_> = paths.iter().map(|(path, w)| (w, setting.ratios(path))).collect();
        for m in 0..last * setting.h {
            for n in m + 1..=last * setting.h {
                let right =
                    mean(ratios.iter().map(|(w, x)| (*w, x[m..n].iter().map(|x| &one - (&one + x).recip()).product())));
                let steps = i32::try_from(n - m).expect("short");
                assert!(right.pow(h) <= constant.pow(h) * contraction.rate.pow(steps));
                let printed =
                    mean(ratios.iter().map(|(w, x)| (*w, x[m..n].iter().map(|x| (&one + x).recip()).product())));
                assert!(printed <= ratio(1, 2).pow(steps));
            }
        }
    }
    // H = 0, F = Q = 1: A1 fails, P(k) = P(0) + k.
    let p = |k: i64| ratio(3 + k, 1);
    let product = |n: i64, printed: bool| -> Rational {
        let factor = |k: i64| if printed { (&one + p(k + 1)).recip() } else { &one - (&one + p(k + 1)).recip() };
        (0..n).map(factor).product()
    };
    for n in 1..200 {
        assert_eq!(product(n, false), (&one + p(0)) / (&one + p(0) + ratio(n, 1)));
        assert!(product(n, true) <= ratio(1, 2).pow(i32::try_from(n).expect("small")));
    }
    // No M λⁿ: M = 1000, λ = 99/100.
    assert!(product(3000, false) > ratio(1000, 1) * ratio(99, 100).pow(3000));
}

/// WG-T2.1-proof: the r-th power of the norm of products, r = 2, over all paths; m ≥ 1.
///
/// Erratum WG-T2.1-proof: the norm is printed without its power.
#[test]
fn norms_of_products_follow_from_those_of_the_lemma() {
    let one = Rational::one();
    for (setting, _, last) in settings() {
        let length = last * setting.h;
        let paths = setting.paths(length);
        let walked: Vec<_> = paths
            .iter()
            .map(|(path, w)| (w, setting.closed_loop(path), setting.ratios(path), setting.variances(path)))
            .collect();
        for m in 1..length {
            for n in m + 1..=length {
                let left = mean(walked.iter().map(|(w, a, ..)| (*w, a[m..n].iter().product::<Rational>().pow(2))));
                let factors = mean(walked.iter().map(|(w, _, x, _)| {
                    (*w, x[m..n].iter().map(|x| &one - (&one + x).recip()).product::<Rational>().pow(2))
                }));
                let covariance = mean(walked.iter().map(|(w, .., p)| (*w, p[n].pow(2))));
                assert!(left.pow(2) <= factors * covariance / setting.floor().pow(2));
            }
        }
    }
    // H = 0, F = 9/10, Q = 1 at the fixed point P = 100/19; r = 2, n − m = 25.
    let (f, p) = (ratio(9, 10), ratio(100, 19));
    assert_eq!(f.pow(2) * &p + &one, p);
    let bound = (&one - (&one + &p).recip()).pow(25) * &p;
    assert!(f.pow(50) <= bound, "the r-th power");
    assert!(f.pow(25) > bound, "the norm itself");
}

/// WG-T2.1: E|∏ F(1 − LH)|² ≤ M λ₁ⁿ with the constants of the proof, and a bound of E P² with its certificate. Without A1 no rate at all.
#[test]
fn the_closed_loop_is_exponentially_stable() {
    for (setting, root, last) in settings() {
        let (contraction, constant) = decay(&setting, root);
        let second = match setting.process.moment(2, &Matrix::column(vec![setting.start.clone()])) {
            MomentVerdict::Bounded(bound) => bound.bound,
            other => panic!("{other:?}"),
        };
        let length = last * setting.h;
        let paths = setting.paths(length);
        let walked: Vec<_> =
            paths.iter().map(|(path, w)| (w, setting.closed_loop(path), setting.variances(path))).collect();
        let constant = constant / contraction.rate.pow(3) * second.clone() / setting.floor().pow(2);
        let h = i32::try_from(setting.h).expect("small");
        for n in 1..=length {
            assert!(mean(walked.iter().map(|(w, _, p)| (*w, p[n].pow(2)))) <= second);
            for m in 1..n {
                let left = mean(walked.iter().map(|(w, a, _)| (*w, a[m..n].iter().product::<Rational>().pow(2))));
                // left² ≤ M λ^((n−m)/h), to the power h.
                let steps = i32::try_from(n - m).expect("short");
                assert!(left.pow(2 * h) <= constant.pow(h) * contraction.rate.pow(steps));
            }
        }
    }
    // H = 0, F = 1: every factor is 1.
    let blind = super::integer_mode([1, 0, 1, 1]);
    let step = blind.step(&Matrix::identity(1));
    assert_eq!(step.closed_loop, Matrix::identity(1));
}

/// WG-D2.1-aim: L_r-stability of P(k) is not enough.
///
/// Erratum WG-D2.1-aim: announced as a consequence of it; H = 0, Q = 1 and F(k) = f of density 2(1 − f) on (0, 1) for all k.
#[test]
fn stability_of_the_covariance_is_not_enough() {
    // E fⁿ = ∫ fⁿ 2(1 − f) df
    let moment = |n: i64| ratio(2, n + 1) - ratio(2, n + 2);
    // The right aim, A1, fails, and so does its conclusion: the mean product over n steps is bounded by no M λⁿ.
    for n in 0..300 {
        assert_eq!(moment(n), ratio(2, (n + 1) * (n + 2)));
    }
    for (constant, rate) in [(1000, ratio(9, 10)), (1000, ratio(99, 100)), (1, ratio(1, 2))] {
        let fails = |n: i64| moment(n) > ratio(constant, 1) * rate.pow(i32::try_from(n).expect("small"));
        assert!([10, 300, 3000].into_iter().any(fails), "{constant} {rate}");
    }
    // The printed hypothesis holds: E P(k) = E f^(2k) P(0) + ∑[j<k] E f^(2j), whose sum stays below 2 ln 2 < 1.3863.
    let mut sum = Rational::zero();
    for j in 0..300 {
        sum += moment(2 * j);
        // What is left is at most ∑[i>j] 2/((2i+1)(2i+2)) ≤ 1/(2j+1).
        assert!(sum < ratio(13_863, 10_000));
    }
    assert!(sum > ratio(138, 100));
}
