//! The proof of Lemma 2.4 up to its drift, step by step: conditional expectations on every path.

use exact_kalman::scalar::{Rational, ratio};
use num_traits::{One, Zero};

use super::constants::Constants;
use super::window::{Numbers, Setting, begin, mean, settings, windows};

/// α, β and γ of WG-57 on a path of 𝒟(k−1), without C₁ and 1/δ.
fn parts(setting: &Setting, whole: &[(Vec<usize>, Rational)], k: usize, before: &Rational) -> [Rational; 3] {
    let (begin, end) = (begin(setting, k), k * setting.h + 1);
    let squared = |path: &[usize]| setting.phi(path, end, begin).pow(2);
    let alpha =
        mean(whole.iter().filter(|(path, _)| !setting.good(path, begin)).map(|(path, w)| (w, squared(path) * before)));
    let noise = |path: &[usize], j: usize| setting.phi(path, end, j).pow(2) * setting.at(path, j - 1).q;
    let beta = mean(whole.iter().map(|(path, w)| (w, (begin + 1..=end).map(|j| noise(path, j)).sum())));
    let xi = |path: &[usize]| (begin..end).map(|m| setting.xi_variance(path, begin, m)).sum::<Rational>();
    let gamma = mean(whole.iter().map(|(path, w)| (w, squared(path) * xi(path))));
    [alpha, beta, gamma]
}

/// WG-56: the first member has a finite mean.
///
/// Erratum WG-56: printed without the outer expectation, so that a random variable stands for a number.
#[test]
fn the_first_member_has_a_mean() {
    for (setting, ..) in settings() {
        let floor = setting.floor().recip();
        let paths = setting.paths(setting.h.max(1) + 1);
        let a = |path: &[usize]| Rational::one() + &floor * &setting.observer_variances(path)[0];
        let first = mean(paths.iter().map(|(path, w)| (w, a(path))));
        let outer = Rational::one()
            + &floor * mean(paths.iter().map(|(path, w)| (w, setting.observer_variances(path)[0].clone())));
        assert_eq!(first, outer);
    }
    // F(0) is 0 or 2, h = 2, P(0) = Q = 1: E‖x(1) − x*(1)‖² given 𝒢(0) is 1 or 5.
    let given = [ratio(0, 1), ratio(2, 1)].map(|f| f.pow(2) + ratio(1, 1));
    let mean = given.iter().sum::<Rational>() / ratio(2, 1);
    assert_eq!(mean, ratio(3, 1));
    assert!(given.iter().all(|printed| *printed != mean));
}

/// WG-L2.4-setting: what is 𝒟′(k)-measurable is fixed by its generators.
///
/// Erratum WG-L2.4-setting: printed without v.
#[test]
fn the_observer_depends_on_the_observation_noise() {
    // F = H = 1, h = 1, x(0) = x̂(0) = 0, small δ: x*(1) = y(0) = x(0) + v(0), x(1) = x(0) + w(1).
    let z = |x0: i64, w1: i64, v0: i64| (x0 + w1 - (x0 + v0)).pow(2);
    let printed: Vec<i64> = [0, 1].map(|v0| z(0, 0, v0)).to_vec();
    assert_eq!(printed, [0, 1], "the same coefficients, x(0) and w(1), and two values");
    // With the printed window x*(1) = y(1) = H(1)x(1) + v(1) over H(1): it depends on H(1), and 𝒟(0) knows H(0) only.
    let with_printed_window = |h1: i64, v1: i64| ratio(v1, h1).pow(2);
    assert_ne!(with_printed_window(1, 1), with_printed_window(2, 1));
    // With the shifted window the modes 0, …, kh are enough.
    for (setting, _, last) in settings() {
        for (path, _) in setting.paths(last * setting.h + 1) {
            let known = &path[..=(last - 1) * setting.h];
            assert_eq!(setting.observer_variances(known), setting.observer_variances(&path)[..last]);
        }
    }
}

/// WG-57: on every path of 𝒟(k−1), with E z(k) by coefficients and the bound by its three terms.
///
/// Erratum WG-57: 1/δ² is printed for 1/δ.
#[test]
fn the_recursive_bound_holds_on_every_path() {
    let mut contracting = 0;
    for (setting, _, last) in settings() {
        let c1 = Constants::c1(&setting);
        for k in 1..=last {
            for (path, whole) in windows(&setting, k) {
                let before = setting.observer_variances(&path).pop().expect("z(k−1)");
                let z =
                    mean(whole.iter().map(|(path, w)| (w, setting.window_variance(path, begin(&setting, k), &before))));
                let [alpha, beta, gamma] = parts(&setting, &whole, k, &before);
                contracting += usize::from(alpha > Rational::zero());
                assert!(z <= &c1 * (alpha + beta + gamma / &setting.delta));
            }
        }
    }
    assert!(contracting > 20, "{contracting}");
    // F = 1, H = 3, Q = 1, R = 100, δ = 8, h = 1.
    let [q, r, h, delta] = [1, 100, 3, 8].map(|n| ratio(n, 1));
    let z = &q + &r / h.pow(2);
    let bound = |delta: Rational| ratio(3, 1) * &q + ratio(3, 1) / delta * &r;
    assert_eq!(z, ratio(109, 9));
    assert!(z <= bound(delta.clone()));
    assert!(z > bound(delta.pow(2)));
}

/// WG-58: the step is right for any coefficients with 𝒟′ inside, and with 𝒟 inside, as printed, for independent ones only.
#[test]
fn the_noise_is_kept_apart_by_the_larger_field() {
    // w takes the values 0 and 1, z(k−1) = w², F = 1, 𝒟 is trivial. The event A_δᶜ is {H = 0}.
    let half = ratio(1, 2);
    let alpha = |missed: &dyn Fn(i64, i64) -> bool| {
        // (direct, with 𝒟′ inside, with 𝒟 inside); the second coin is free.
        let outcomes = [(0, 0), (0, 1), (1, 0), (1, 1)];
        let of = |(w, coin): (i64, i64)| ratio(i64::from(missed(w, coin)), 1);
        let direct: Rational = outcomes.iter().map(|&(w, coin)| of((w, coin)) * ratio(w * w, 4)).sum();
        let given_w = |w: i64| (of((w, 0)) + of((w, 1))) * &half;
        let inner: Rational = [0, 1].map(|w| given_w(w) * ratio(w * w, 2)).into_iter().sum();
        let all: Rational = outcomes.iter().map(|&outcome| of(outcome) * ratio(1, 4)).sum();
        (direct, inner, all * &half)
    };
    let (direct, larger, smaller) = alpha(&|_, coin| coin == 1);
    assert!(direct == larger && direct == smaller);
    let (direct, larger, smaller) = alpha(&|w, _| w == 1);
    assert!(direct == larger && direct != smaller);
}

/// WG-59, WG-60: the first two terms; N₂^(2/(8+κ)) with κ = 8. The printed exponent (8 + ε)/2 bounds too, N₂ being above 1 as Φ(i, i) = I: it is
/// much larger.
#[test]
fn the_first_two_terms_are_bounded() {
    for (setting, root, last) in settings() {
        let (c1, constants) = (Constants::c1(&setting), Constants::of(&setting, root));
        assert!(constants.rho(&setting) < Rational::one());
        // N₂ = c¹⁶, and the printed N₂^((8+ε)/2) is above c⁶⁴.
        assert!(constants.c.pow(64) > constants.c.pow(2));
        for k in 1..=last {
            let (begin, end) = (begin(&setting, k), k * setting.h + 1);
            for (path, whole) in windows(&setting, k) {
                let before = setting.observer_variances(&path).pop().expect("z(k−1)");
                let [alpha, beta, _] = parts(&setting, &whole, k, &before);
                let fourth = |j: usize| mean(whole.iter().map(|(path, w)| (w, setting.phi(path, end, j).pow(4))));
                let missed: Rational =
                    whole.iter().filter(|(path, _)| !setting.good(path, begin)).map(|(_, w)| w).sum();
                assert!(missed < constants.root.pow(2), "A1 with this ε and δ");
                assert!(alpha.pow(2) <= fourth(begin) * missed * before.pow(2));
                assert!(&c1 * alpha <= constants.rho(&setting) * &before);
                assert!(fourth(begin).pow(4) <= constants.c.pow(16));
                // E w⁴ = 3Q², mode by mode; a sum of roots is compared through the largest.
                let squared = |j: usize| {
                    fourth(j) * mean(whole.iter().map(|(path, w)| (w, ratio(3, 1) * setting.at(path, j - 1).q.pow(2))))
                };
                let largest = (begin + 1..=end).map(squared).max().expect("a term");
                assert!(beta.pow(2) <= Constants::h(&setting).pow(2) * &largest);
                assert!((&c1 * &beta).pow(2) <= constants.beta(&setting).pow(2));
                assert!(largest <= constants.c.pow(4) * ratio(49, 16) * constants.q.pow(2));
            }
        }
    }
}

/// WG-61, WG-62, WG-63: the third term.
///
/// Erratum WG-61: 1/δ² and √ε are printed; either alone makes the bound wrong.
#[test]
fn the_third_term_is_bounded() {
    for (setting, root, last) in settings() {
        let (c1, constants) = (Constants::c1(&setting), Constants::of(&setting, root));
        let h = Constants::h(&setting);
        for k in 1..=last {
            let (begin, end) = (begin(&setting, k), k * setting.h + 1);
            for (path, whole) in windows(&setting, k) {
                let [.., gamma] = parts(&setting, &whole, k, &Rational::zero());
                let gamma = &c1 / &setting.delta * gamma;
                let xi = |path: &[usize], m: usize| setting.xi_variance(path, begin, m);
                // E (∑ξ²)² ≤ h ∑ E ξ⁴ = 3h ∑ (Var ξ)².
                let fourth = |m: usize| mean(whole.iter().map(|(path, w)| (w, ratio(3, 1) * xi(path, m).pow(2))));
                let sum: Rational = (begin..end).map(fourth).sum();
                assert!(gamma.pow(2) <= (&c1 / &setting.delta * constants.c.pow(2)).pow(2) * (&h + ratio(1, 1)) * &sum);
                for m in begin..end {
                    let carried = |path: &[usize]| setting.carried_variance(path, begin, m);
                    let part = mean(
                        whole
                            .iter()
                            .map(|(path, w)| (w, ratio(3, 1) * (setting.at(path, m).h.pow(2) * carried(path)).pow(2))),
                    );
                    let noise = mean(whole.iter().map(|(path, w)| (w, ratio(3, 1) * setting.at(path, m).r.pow(2))));
                    assert!(fourth(m) <= ratio(8, 1) * &part + ratio(8, 1) * noise);
                    let of_h = mean(whole.iter().map(|(path, w)| (w, setting.at(path, m).h.pow(8))));
                    let eighth = mean(whole.iter().map(|(path, w)| (w, ratio(105, 1) * carried(path).pow(4))));
                    assert!(part.pow(2) <= &of_h * &eighth && of_h < constants.g.pow(8));
                    let terms = |path: &[usize]| {
                        (begin + 1..=m)
                            .map(|j| setting.phi(path, m, j).pow(8) * setting.at(path, j - 1).q.pow(4))
                            .sum::<Rational>()
                    };
                    let bound = mean(whole.iter().map(|(path, w)| (w, ratio(105, 1) * terms(path))));
                    assert!(eighth <= h.pow(7) * bound);
                    assert!(fourth(m) <= constants.fourth_moment(&setting));
                }
                assert!(
                    gamma.pow(2) <= constants.squared_gamma(&setting) && gamma <= constants.gamma(&setting),
                    "{path:?}"
                );
            }
        }
    }
    // The model of WG-57: γ = (3/8)·100; E ξ⁴ = 3·100², h = 1; N₂ = 2 bounds the powers of Φ = 1, and every ε may be had with δ = 8.
    let gamma = ratio(300, 8);
    let squared = |over: Rational, power: Rational, epsilon: Rational| {
        (ratio(3, 1) / over).pow(2) * power * epsilon * ratio(2 * 3 * 10_000, 1)
    };
    let [one, small] = [ratio(1, 1), ratio(1, 10_000)];
    assert!(gamma.pow(2) <= squared(ratio(8, 1), one.clone(), one.clone()));
    // √(N₂^(8+ε)) is below N₂⁵.
    let printed = ratio(2, 1).pow(10);
    assert!(gamma.pow(2) > squared(ratio(64, 1), printed.clone(), small.clone()));
    assert!(gamma.pow(2) > squared(ratio(8, 1), printed, small));
    // Without √ε, with N₂ near 1 and 1/δ².
    assert!(gamma.pow(2) > squared(ratio(64, 1), one.clone(), one));
}

/// WG-63-recursion, WG-64, WG-66: the recursion of E z(k) and of a(k) on every path, and a(k) above the covariance.
///
/// Erratum WG-66: false with the printed window.
#[test]
fn a_drifts_back_and_bounds_the_covariance() {
    for (setting, root, last) in settings() {
        let constants = Constants::of(&setting, root);
        let (rho, new) = (constants.rho(&setting), constants.beta(&setting) + constants.gamma(&setting));
        let floor = setting.floor();
        let a = |z: &Rational| Rational::one() + z / &floor;
        for k in 1..=last {
            for (path, whole) in windows(&setting, k) {
                let before = setting.observer_variances(&path).pop().expect("z(k−1)");
                let z = mean(whole.iter().map(|(path, w)| (w, setting.observer_variances(path).pop().expect("z(k)"))));
                assert!(z <= &rho * &before + &new);
                assert!(a(&z) <= &rho * a(&before) + Rational::one() - &rho + &new / &floor);
                for (path, _) in &whole {
                    let covariance = setting.variances(path).pop().expect("P(kh+1)");
                    assert!(setting.observer_variances(path).pop().expect("z(k)") >= covariance);
                }
            }
        }
    }
    // F = H = 1, h = 1, Q = 1, R = 1/10, P(0) = 1: with the printed window x*(1) = y(1).
    let model = Numbers { f: ratio(1, 1), h: ratio(1, 1), q: ratio(1, 1), r: ratio(1, 10) };
    let covariance = &model.f * &model.r / (ratio(1, 1) + &model.r) + &model.q;
    assert_eq!(covariance, ratio(12, 11));
    let (shifted, printed) = (&model.q + &model.r / model.h.pow(2), &model.r / model.h.pow(2));
    assert!(ratio(1, 1) + shifted >= ratio(1, 1) + &covariance);
    assert!(ratio(1, 1) + printed < ratio(1, 1) + &covariance);
}
