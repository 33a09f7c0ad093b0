//! Lemmas 3.1 and 3.2: lagged products of the stationary part, and their difference from those of the readings.

use std::collections::BTreeMap;

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};

use super::numbers::{Draws, Q, count, integers, modulus, number, power, squared_norm, stein, trace};
use super::world::{World, moment};

/// A world with nilpotent A and a past that is long enough, so that u(k) is complete.
fn nilpotent(draws: &mut Draws, p: usize) -> World {
    let mut world = World::drawn(draws, p, p, 5);
    world.a = Matrix::from_fn(p, p, |i, j| if i < j { draws.number() } else { ratio(0, 1) });
    world
}

/// AK-L3.1ii: E[u(k)u(k−i)ᵀ] = Aⁱ(Φ − W) + δW from the sources, for nilpotent A with Φ by linear equations; and for any
/// A with a past cut off, where Φ − W is the sum that is left.
#[test]
fn lagged_moments_of_the_stationary_part() {
    let mut draws = Draws::seeded(41);
    for p in [1, 2, 3] {
        let world = nilpotent(&mut draws, p);
        let (w, x) = (world.w_covariance(), stein(&world.a, &world.v_covariance()));
        for k in 1..=5_i64 {
            for i in 0..k {
                let lagged = moment(&world.u(k), &world.u(k - i));
                let white = if i == 0 { w.clone() } else { Matrix::zeros(p, p) };
                assert_eq!(lagged, power(&world.a, usize::try_from(i).unwrap_or(0)) * &x + white);
            }
        }
        let cut = World::drawn(&mut draws, p, 2, 5);
        for (k, i) in [(3_i64, 1_i64), (5, 2), (4, 3)] {
            let past = usize::try_from(k - i).unwrap_or(0) + cut.past;
            let sum =
                (0..past).fold(Matrix::zeros(p, p), |sum, j| sum + power(&cut.a, j).congruence(&cut.v_covariance()));
            assert_eq!(moment(&cut.u(k), &cut.u(k - i)), power(&cut.a, usize::try_from(i).unwrap_or(0)) * sum);
        }
    }
}

/// AK-L3.1-nonsingular: for regular A and V > 0; V of rank one may do as well; A = 0 does not at i = 1.
#[test]
fn lagged_moments_are_nonsingular() {
    let mut draws = Draws::seeded(42);
    let lagged = |a: &Q, v: &Q, w: &Q, i: usize| {
        let white = if i == 0 { w.clone() } else { Matrix::zeros(a.rows(), a.rows()) };
        power(a, i) * stein(a, v) + white
    };
    let mut regular = 0;
    for trial in 0..20 {
        let p = 1 + trial % 3;
        let (a, v, w) = (draws.contraction(p), draws.definite(p), draws.semidefinite(p, 1));
        if a.rank() < p {
            continue;
        }
        assert!((0..4).all(|i| lagged(&a, &v, &w, i).rank() == p));
        regular += 1;
    }
    assert!(regular > 12, "{regular}");
    let turn = Matrix::from_integers(&[[0, 1], [-1, 0]]).scaled(&ratio(1, 2));
    let one = Matrix::from_integers(&[[1, 0], [0, 0]]);
    assert!((0..4).all(|i| lagged(&turn, &one, &Matrix::zeros(2, 2), i).rank() == 2));
    let identity = Matrix::identity(2);
    assert!(lagged(&Matrix::zeros(2, 2), &identity, &identity, 1).is_zero());
}

/// The law of p = 1, A = 1/2, each source ±1, with three terms of the past: E|u(k)u(k−i)| by enumeration.
fn mean_modulus(i: i64) -> Rational {
    let half = number(ratio(1, 2));
    let one = number(ratio(1, 1));
    let zero = Matrix::zeros(1, 1);
    let world =
        World { a: half, v_root: one.clone(), w_root: one, x_root: zero.clone(), x_mean: zero, past: 1, last: 4 };
    let (u, lagged) = (world.u(4), world.u(4 - i));
    let free: Vec<usize> = (1..world.sources())
        .filter(|&source| u[(0, source)] != ratio(0, 1) || lagged[(0, source)] != ratio(0, 1))
        .collect();
    let value = |x: &Q, outcome: usize| -> Rational {
        let signed = |(place, &source): (usize, &usize)| {
            if outcome >> place & 1 == 1 { x[(0, source)].clone() } else { -x[(0, source)].clone() }
        };
        free.iter().enumerate().map(signed).sum()
    };
    let outcomes = 1_usize << free.len();
    let product = |outcome: usize| modulus(&(value(&u, outcome) * value(&lagged, outcome)));
    (0..outcomes).map(product).sum::<Rational>() / count(outcomes)
}

/// AK-L3.1i: ‖abᵀ‖ = |a||b| (squares are compared), and E|u(k)u(k−i)| ≤ tr Φ on a finite law, with equality at i = 0 in
/// the limit only.
#[test]
fn lagged_products_are_integrable() {
    let mut draws = Draws::seeded(43);
    for p in [1, 2, 3] {
        let (a, b) = (draws.matrix(p, 1), draws.matrix(p, 1));
        assert_eq!(squared_norm(&(&a * b.transpose())), squared_norm(&a) * squared_norm(&b));
    }
    // Φ = 1 + 1/(1 − 1/4)
    let phi = trace(&(stein(&number(ratio(1, 2)), &number(ratio(1, 1))) + number(ratio(1, 1))));
    assert_eq!(phi, ratio(7, 3));
    for i in 0..=3 {
        let mean = mean_modulus(i);
        assert!(mean < phi && mean > ratio(1, 2), "{i}: {mean}");
    }
}

/// AK-u: the joint law of (u(k), u(k+1), u(k+2)) is the same for every k: by enumeration of all signs, for nilpotent A.
/// That of the readings is not: they carry the transient.
#[test]
fn the_stationary_part_is_strictly_stationary() {
    let zero = Matrix::zeros(2, 1);
    let world = World {
        a: integers(&[[0, 1], [0, 0]]),
        v_root: integers(&[[1], [2]]),
        w_root: integers(&[[1], [-3]]),
        x_root: zero,
        x_mean: integers(&[[5], [1]]),
        past: 2,
        last: 4,
    };
    let law = |parts: [Q; 3]| {
        let free: Vec<usize> = (1..world.sources())
            .filter(|&source| parts.iter().any(|part| (0..2).any(|i| part[(i, source)] != ratio(0, 1))))
            .collect();
        let mut law: BTreeMap<Vec<Rational>, usize> = BTreeMap::new();
        for outcome in 0..1_usize << free.len() {
            let signs = Matrix::from_fn(world.sources(), 1, |source, _| match free.iter().position(|&s| s == source) {
                _ if source == 0 => ratio(1, 1),
                Some(place) if outcome >> place & 1 == 1 => ratio(-1, 1),
                Some(_) => ratio(1, 1),
                None => ratio(0, 1),
            });
            let values = parts.iter().flat_map(|part| (part * &signs).entries().to_vec()).collect();
            *law.entry(values).or_default() += 1 << (20 - free.len());
        }
        law
    };
    let of_u = |k: i64| law([world.u(k), world.u(k + 1), world.u(k + 2)]);
    assert_eq!(of_u(1), of_u(2));
    assert_ne!(law([world.y(1), world.y(2), world.y(3)]), law([world.y(2), world.y(3), world.y(4)]));
}

/// AK-3.9: with y = u − q, at random vectors.
#[test]
fn difference_of_lagged_products() {
    let mut draws = Draws::seeded(44);
    for p in [1, 2, 3] {
        let [u, q, lagged_u, lagged_q] = [(); 4].map(|()| draws.matrix(p, 1));
        let (y, lagged_y) = (&u - &q, &lagged_u - &lagged_q);
        let left = &u * lagged_u.transpose() - y * lagged_y.transpose();
        let right = &u * lagged_q.transpose() + &q * lagged_u.transpose() - &q * lagged_q.transpose();
        assert_eq!(left, right);
    }
}

/// Erratum AK-3.9: u = q = 1, y = 0 has 1 on the left; the right form has 1 + 1 − 1, the printed one 1 + 1 + 1.
#[test]
fn the_last_product_is_subtracted() {
    let [u, q] = [ratio(1, 1), ratio(1, 1)];
    let y = &u - &q;
    let left = &u * &u - &y * &y;
    let cross = &u * &q + &q * &u;
    assert_eq!(left, &cross - &q * &q);
    assert_ne!(left, cross + &q * &q);
}

/// AK-3.9-bound: |u(k)|/k is at most the largest average of |u(1)|, …, |u(N)|, for any sequence.
#[test]
fn terms_grow_no_faster_than_averages() {
    let mut draws = Draws::seeded(45);
    for _ in 0..50 {
        let u: Vec<Rational> = (0..12).map(|_| modulus(&draws.number())).collect();
        let share = |k: usize| &u[k - 1] / count(k);
        let average = |n: usize| u[..n].iter().sum::<Rational>() / count(n);
        let largest = (1..=12).map(average).max();
        assert!((1..=12).map(share).max() <= largest);
    }
}
