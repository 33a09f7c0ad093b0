//! (2.1): the estimate of A, and why it is one.

use exact_kalman::identify::{Series, estimates};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::Reading;
use exact_kalman::scalar::{Rational, ratio};

use super::numbers::{Draws, Q, integers, number, pseudo_inverse, total};
use super::world::{World, moment};

pub fn series(readings: &[Q]) -> Series<Rational> {
    let rows = readings.iter().map(|y| y.entries().to_vec()).collect();
    Series::new(rows).unwrap_or_else(|error| panic!("{error}"))
}

/// Â(n) of all the readings.
fn estimate(readings: &[Q]) -> Q {
    let all = estimates(&series(readings), Reading::Printed).unwrap_or_else(|error| panic!("{error}"));
    all[all.len() - 1].transition.clone()
}

/// `Σ_{k=3..n} f(k) yᵀ(k−2)`; y(k) is `readings[k − 1]`.
fn lagged(readings: &[Q], f: impl Fn(usize) -> Q) -> Q {
    let p = readings[0].rows();
    total(p, p, (3..=readings.len()).map(|k| f(k) * readings[k - 3].transpose()))
}

/// AK-2.1-lag: the moments from which (2.1) is taken, for every k ≥ 3; with lag 1 they fail by −AW.
#[test]
fn lagged_moments_determine_the_transition() {
    let mut draws = Draws::seeded(1);
    for p in [1, 1, 2, 3] {
        let world = World::drawn(&mut draws, p, 0, 6);
        for k in 3..=6 {
            let lag = |i: i64, j: i64| moment(&world.y(k - i), &world.y(k - j));
            assert_eq!(lag(0, 2), &world.a * lag(1, 2));
            assert_eq!(lag(0, 1) - &world.a * lag(1, 1), -(&world.a * world.w_covariance()));
        }
        assert!(world.w(0).is_none(), "there is no y(0)");
    }
}

/// AK-z: both forms of z(k) are one combination of sources; z(k) and z(k−1) share −AW; z(k) has no source in common
/// with y(1), …, y(k−2), and has with y(k−1).
#[test]
fn residuals_are_moving_averages() {
    let mut draws = Draws::seeded(2);
    for p in [1, 2, 3] {
        let world = World::drawn(&mut draws, p, 0, 6);
        for k in 2..=6 {
            assert_eq!(world.z(k), world.y(k) - &world.a * world.y(k - 1));
            if k > 2 {
                assert_eq!(moment(&world.z(k), &world.z(k - 1)), -(&world.a * world.w_covariance()));
            }
            let shared = |j: i64| {
                let (z, y) = (world.z(k), world.y(j));
                let touches = |x: &Q, source: usize| (0..p).any(|i| x[(i, source)] != ratio(0, 1));
                (0..world.sources()).any(|source| touches(&z, source) && touches(&y, source))
            };
            assert!((1..=k - 2).all(|j| !shared(j)));
            assert_eq!(shared(k - 1), !(&world.a * &world.w_root).is_zero());
        }
    }
}

/// AK-R.n, AK-R.A: Â(n) = A MM⁺ + R(n) for all readings and every A, hence A + R(n) where the lag sum M is
/// nonsingular; where it is singular the shorter form may fail: y = (1, 0, 2) with A = 9/10.
#[test]
fn error_of_the_estimate() {
    let mut draws = Draws::seeded(3);
    let (mut regular, mut singular) = (0, 0);
    for trial in 0..60 {
        let p = 1 + trial % 3;
        let n = 3 + trial % 5;
        let readings = draws.readings(p, n);
        let a = draws.matrix(p, p);
        let lag_sum = lagged(&readings, |k| readings[k - 2].clone());
        let inverse = pseudo_inverse(&lag_sum);
        let error = lagged(&readings, |k| &readings[k - 1] - &a * &readings[k - 2]) * &inverse;
        assert_eq!(estimate(&readings), &a * &lag_sum * inverse + &error);
        if lag_sum.rank() == p {
            assert_eq!(estimate(&readings), a + error);
            regular += 1;
        } else {
            singular += 1;
        }
    }
    assert!(regular > 20 && singular > 5, "{regular} regular, {singular} singular");
    let readings = [1, 0, 2].map(|y| number(ratio(y, 1)));
    let a = number(ratio(9, 10));
    let lag_sum = lagged(&readings, |k| readings[k - 2].clone());
    let error = lagged(&readings, |k| &readings[k - 1] - &a * &readings[k - 2]) * pseudo_inverse(&lag_sum);
    assert_eq!(estimate(&readings), Matrix::zeros(1, 1));
    assert_eq!(&a + error, a);
}

/// AK-2.1: without noise the estimate is A itself as soon as the lag sum is regular; by hand for y = (1, 2, 3, 5):
/// (3·1 + 5·2)/(2·1 + 3·2).
#[test]
fn noise_free_systems_are_identified_exactly() {
    let mut draws = Draws::seeded(4);
    let mut regular = 0;
    for p in [1, 2, 3, 3, 2] {
        let a = draws.matrix(p, p);
        let mut readings = vec![draws.matrix(p, 1)];
        for k in 0..p + 3 {
            readings.push(&a * &readings[k]);
        }
        if lagged(&readings, |k| readings[k - 2].clone()).rank() == p {
            assert_eq!(estimate(&readings), a);
            regular += 1;
        }
    }
    assert!(regular >= 3, "{regular}");
    assert_eq!(estimate(&[1, 2, 3, 5].map(|y| integers(&[[y]]))), number(ratio(13, 8)));
}
