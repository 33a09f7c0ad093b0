//! (2.2) and (3.10): the covariances of residuals, their estimates, and V and W from them.

use exact_kalman::identify::{NoiseCovariances, ResidualCovariances, estimates, noise_covariances};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::Reading;
use exact_kalman::scalar::{Rational, ratio};

use super::estimates::series;
use super::numbers::{Draws, Q, count, integers, modulus, number, power, total};
use super::world::{World, moment};

/// y(k) − F y(k−i)
fn residual(readings: &[Q], k: usize, i: usize, f: &Q) -> Q {
    &readings[k - 1] - f * &readings[k - 1 - i]
}

/// AK-B.1, AK-B.2: second moments of the residuals from the sources, for every k; AK-Bbar: the mean of B̄(n,i) is
/// B(i)(n − 2)/n, since 1/n stands before n − 2 terms, and 1/(n − 2) would make it B(i).
#[test]
fn residual_covariances_of_a_system() {
    let mut draws = Draws::seeded(11);
    for p in [1, 2, 3] {
        let world = World::drawn(&mut draws, p, 0, 6);
        let ResidualCovariances { one_step, two_step } =
            ResidualCovariances::of_system(&world.a, &world.v_covariance(), &world.w_covariance());
        let second = |k: i64, i: i64| {
            let residual = world.y(k) - power(&world.a, usize::try_from(i).unwrap_or(0)) * world.y(k - i);
            moment(&residual, &residual)
        };
        for k in 2..=6 {
            assert_eq!(second(k, 1), one_step);
        }
        for k in 3..=6 {
            assert_eq!(second(k, 2), two_step);
        }
        for (i, b) in [(1, &one_step), (2, &two_step)] {
            let sum = total(p, p, (3..=6).map(|k| second(k, i)));
            assert_eq!(sum.scaled(&ratio(1, 6)), b.scaled(&ratio(4, 6)));
        }
    }
}

/// AK-B.W, AK-B.V: (A, V, W) → (B(1), B(2)) → (V, W) is the identity where A is regular. Where it is not, kernel vectors
/// say so, and two systems have the same B(1), B(2).
#[test]
fn noise_covariances_are_recovered() {
    let mut draws = Draws::seeded(12);
    let mut regular = 0;
    for trial in 0..40 {
        let p = 1 + trial % 3;
        // Symmetry is all that is needed of V and W.
        let [v, w] = [(); 2].map(|()| {
            let half = draws.matrix(p, p);
            &half + half.transpose()
        });
        let a = draws.matrix(p, p);
        match noise_covariances(&a, &ResidualCovariances::of_system(&a, &v, &w)) {
            Ok(found) => {
                assert_eq!(found, NoiseCovariances { process: v, observation: w });
                regular += 1;
            }
            Err(singular) => {
                assert!(!singular.kernel.is_zero());
                assert!((a * singular.kernel).is_zero());
            }
        }
    }
    assert!(regular > 25, "{regular}");
    let zero = Matrix::zeros(1, 1);
    let of = |v: i64, w: i64| ResidualCovariances::of_system(&zero, &integers(&[[v]]), &integers(&[[w]]));
    assert_eq!(of(4, 1), of(2, 3));
    assert!(noise_covariances(&zero, &of(4, 1)).is_err());
}

/// AK-B.hat: neither V̂(n) > 0 nor Ŵ(n) ≥ 0 is assured. By hand: y = (4, 2, 3) has Â = 3/2, residuals 0 and −6, so
/// B(3,1) = 0, B(3,2) = 12, Ŵ = −8/3 and V̂ = 26/3; and among y(1), …, y(4) in {−2, …, 2} there are some with V̂ < 0.
#[test]
fn estimated_noise_may_be_negative() {
    let noise = |y: &[i64]| {
        let readings: Vec<Q> = y.iter().map(|&y| integers(&[[y]])).collect();
        let all = estimates(&series(&readings), Reading::Printed).unwrap_or_else(|error| panic!("{error}"));
        all[all.len() - 1].noise().ok().map(|noise| [noise.process, noise.observation].map(|m| m[(0, 0)].clone()))
    };
    assert_eq!(noise(&[4, 2, 3]), Some([ratio(26, 3), ratio(-8, 3)]));
    let digit = |code: i64, place: u32| code / 5_i64.pow(place) % 5 - 2;
    let all: Vec<_> = (0..625).filter_map(|code| noise(&[0, 1, 2, 3].map(|place| digit(code, place)))).collect();
    let negative = |place: usize| all.iter().filter(|noise| noise[place] < ratio(0, 1)).count();
    assert!(negative(0) > 0 && negative(1) > 0 && all.len() > 300, "{} {} {}", negative(0), negative(1), all.len());
}

/// AK-B.hat, AK-2.1: for n < p + 2 the lag sum has only n − 2 terms of rank one, so Â(n) is singular and there are no V̂(n)
/// and Ŵ(n); from n = p + 2 on there usually are.
#[test]
fn few_readings_give_a_singular_estimate() {
    let mut draws = Draws::seeded(16);
    for p in [2, 3] {
        let all =
            estimates(&series(&draws.readings(p, p + 3)), Reading::Printed).unwrap_or_else(|error| panic!("{error}"));
        for one in &all {
            assert!(one.transition.rank() <= one.count - 2);
            assert!(one.count >= p + 2 || one.noise().is_err());
        }
        assert!(all.iter().any(|one| one.noise().is_ok()), "p = {p}");
    }
}

/// AK-2.2: for p = 1 the term k = 3 of B(n,1) vanishes whenever y(2)y(1) ≠ 0, as Â(3) = y(3)/y(2). AK-Rem2.2: with the
/// last estimate throughout it does not, and the two estimates differ.
#[test]
fn the_first_one_step_residual_vanishes() {
    let mut draws = Draws::seeded(13);
    for _ in 0..50 {
        let readings = draws.readings(1, 4);
        if readings[..2].iter().any(Matrix::is_zero) {
            continue;
        }
        let all = estimates(&series(&readings), Reading::Printed).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(all[0].residuals.one_step, Matrix::zeros(1, 1));
    }
    let readings = [1, 2, 3, 5].map(|y| integers(&[[y]]));
    let [printed, last] = [Reading::Printed, Reading::Last].map(|reading| {
        let all = estimates(&series(&readings), reading).unwrap_or_else(|error| panic!("{error}"));
        all[1].residuals.one_step[(0, 0)].clone()
    });
    // Â(4) = 13/8: residuals 3 − 26/8 and 5 − 39/8, the first of which (2.2) replaces by 0.
    assert_eq!(last, ratio(4 + 1, 64 * 4));
    assert_eq!(printed, ratio(1, 64 * 4));
}

/// The four sums of (3.10), divided by n, with `power(k)` for what stands where Â(k)ⁱ is right and `a` where Aⁱ is.
fn four_sums(readings: &[Q], i: usize, a: &Q, estimate: impl Fn(usize) -> Q) -> Q {
    let (n, p) = (readings.len(), readings[0].rows());
    let term = |k: usize| {
        let (y, x, f) = (&readings[k - 1], &readings[k - 1 - i], estimate(k));
        let h = a - &f;
        let (ht, xt) = (h.transpose(), x.transpose());
        y * &xt * &ht + &h * x * y.transpose() - &h * x * &xt * a.transpose() - f * x * xt * ht
    };
    total(p, p, (3..=n).map(term)).scaled(&(ratio(1, 1) / count(n)))
}

/// B̄(n,i), with the true A.
fn bbar(readings: &[Q], i: usize, a: &Q) -> Q {
    let p = readings[0].rows();
    let square = |k: usize| {
        let r = residual(readings, k, i, &power(a, i));
        &r * r.transpose()
    };
    total(p, p, (3..=readings.len()).map(square)).scaled(&(ratio(1, 1) / count(readings.len())))
}

/// AK-3.10, AK-Bbar: B(n,i) − B̄(n,i) for the estimates themselves, at random rationals of several sizes.
#[test]
fn effect_of_the_estimated_transition() {
    let mut draws = Draws::seeded(14);
    for trial in 0..24 {
        let p = 1 + trial % 3;
        let readings = draws.readings(p, 3 + trial % 4);
        let a = draws.matrix(p, p);
        let all = estimates(&series(&readings), Reading::Printed).unwrap_or_else(|error| panic!("{error}"));
        let last = &all[all.len() - 1].residuals;
        for (i, b) in [(1, &last.one_step), (2, &last.two_step)] {
            let sums = four_sums(&readings, i, &power(&a, i), |k| power(&all[k - 3].transition, i));
            assert_eq!(b - bbar(&readings, i, &a), sums);
        }
    }
}

/// Erratum AK-3.10: one term with i = 2, A = 9/10, Â = 1/2, y(k) = 3, y(k−2) = 5 is 49/25 on the left. With powers it is
/// that on the right as well; with A and Â as printed it is −2.
#[test]
fn powers_are_needed_in_the_four_sums() {
    let [a, f, y, x] = [ratio(9, 10), ratio(1, 2), ratio(3, 1), ratio(5, 1)];
    let square = |factor: &Rational| (&y - factor * &x) * (&y - factor * &x);
    let left = square(&(&f * &f)) - square(&(&a * &a));
    let right = |a: &Rational, f: &Rational| {
        let h = a - f;
        ratio(2, 1) * &h * &y * &x - &h * &x * &x * a - f * &x * &x * &h
    };
    assert_eq!(left, ratio(49, 25));
    assert_eq!(right(&(&a * &a), &(&f * &f)), left);
    assert_eq!(right(&a, &f), ratio(-2, 1));
}

/// AK-3.10-bound: for finite n and p = 1, with |·| as the norm, the sum from m on is at most sup|Aⁱ − Â(k)ⁱ| times the
/// average of |y(k)y(k−i)|.
#[test]
fn bound_of_one_sum() {
    let mut draws = Draws::seeded(15);
    for _ in 0..40 {
        let (n, m, i) = (9, 4, 1 + usize::from(draws.integer(1) > 0));
        let readings: Vec<Rational> = (0..n).map(|_| draws.number()).collect();
        let a = draws.number();
        let estimates: Vec<Rational> = (0..=n).map(|_| &a + draws.number() / ratio(10, 1)).collect();
        let gap = |k: usize| a.pow(i32::try_from(i).unwrap_or(0)) - estimates[k].pow(i32::try_from(i).unwrap_or(0));
        let product = |k: usize| &readings[k - 1] * &readings[k - 1 - i];
        let sum: Rational = (m..=n).map(|k| product(k) * gap(k)).sum();
        let largest = (m..=n).map(|k| modulus(&gap(k))).max().unwrap_or_default();
        let average: Rational = (m..=n).map(|k| modulus(&product(k))).sum();
        assert!(modulus(&sum) <= largest * average);
    }
}

/// Erratum AK-3.10-bound: i = 2, A = 9/10, Â(k) = 1/2, y(k) = 1 for all k: the sum that (3.10) has is 14/25 on average.
/// The bound with Aⁱ − Âⁱ is 14/25, the printed one with A − Â only 2/5.
#[test]
fn powers_are_needed_in_the_bound() {
    let (a, f, n) = (ratio(9, 10), ratio(1, 2), 50);
    let average: Rational = (1..=n).map(|_| (&a * &a - &f * &f) / ratio(n, 1)).sum();
    let bound = |gap: Rational| modulus(&gap);
    assert!(average <= bound(&a * &a - &f * &f));
    assert!(average > bound(&a - &f));
    assert_eq!((average, &a - &f), (ratio(14, 25), ratio(2, 5)));
    assert_eq!(number(bound(a - f)), number(ratio(2, 5)));
}
