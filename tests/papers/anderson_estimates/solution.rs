//! (3.3)–(3.7): the readings as moving averages, their moments, and the transient.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::ratio;

use super::numbers::{Draws, Q, integers, number, power, squared_norm, stein, total, trace};
use super::world::{World, covariance, mean, moment};

fn index(k: i64) -> usize {
    usize::try_from(k).unwrap_or(0)
}

/// AK-3.3: the solution is the recursion, source by source.
#[test]
fn solution_eq_recursion() {
    let mut draws = Draws::seeded(21);
    for p in [1, 2, 3] {
        let world = World::drawn(&mut draws, p, 0, 5);
        for k in 1..=5 {
            let sum = (0..k).fold(world.zero(), |sum, j| sum + power(&world.a, index(j)) * world.noise(k - j - 1));
            let solved = world.observation_noise(k) + sum + power(&world.a, index(k)) * world.x0();
            assert_eq!(solved, world.y(k));
        }
    }
}

/// AK-3.4a, AK-3.4b: mean and covariance of y(k) from the sources. AK-3.4b-limit: Φ(k) − Φ = Aᵏ(cov x(0) − X)(Aᵏ)ᵀ
/// exactly, with X = AXAᵀ + V solved as linear equations and Φ = X + W.
#[test]
fn moments_of_the_readings() {
    let mut draws = Draws::seeded(22);
    for p in [1, 2, 3] {
        let mut world = World::drawn(&mut draws, p, 0, 6);
        world.a = draws.contraction(p);
        let (v, w, start) = (world.v_covariance(), world.w_covariance(), &world.x_root * world.x_root.transpose());
        let x = stein(&world.a, &v);
        assert_eq!(x, world.a.congruence(&x) + &v);
        for k in 1..=6 {
            let y = world.y(k);
            let k = index(k);
            assert_eq!(mean(&y), power(&world.a, k) * &world.x_mean);
            let sum = total(p, p, (0..k).map(|j| power(&world.a, j).congruence(&v)));
            let phi = covariance(&y, &y);
            assert_eq!(phi, &w + sum + power(&world.a, k).congruence(&start));
            assert_eq!(phi - (&x + &w), power(&world.a, k).congruence(&(&start - &x)));
        }
        assert!(squared_norm(&power(&world.a, 120)) < ratio(1, 1_000_000));
    }
    // Without ρ(A) < 1 there is no limit: A = V = 1 has Φ(k) = W + k + cov x(0).
    let one = number(ratio(1, 1));
    let x_mean = Matrix::zeros(1, 1);
    let walk =
        World { a: one.clone(), v_root: one.clone(), w_root: one.clone(), x_root: one, x_mean, past: 0, last: 9 };
    for k in 1..=9 {
        assert_eq!(covariance(&walk.y(k), &walk.y(k))[(0, 0)], ratio(k + 2, 1));
    }
}

/// AK-3.5, AK-3.6, AK-3.7: y(k) = u(k) − q(k) and q(k) = Aᵏq(0), with a past of any length; complete for nilpotent A.
#[test]
fn stationary_part_and_transient() {
    let mut draws = Draws::seeded(23);
    for past in [0, 1, 3] {
        for p in [1, 2, 3] {
            let mut world = World::drawn(&mut draws, p, past, 4);
            for nilpotent in [false, true] {
                if nilpotent {
                    world.a = Matrix::from_fn(p, p, |i, j| if i < j { world.a[(i, j)].clone() } else { ratio(0, 1) });
                }
                for k in 1..=4 {
                    assert_eq!(world.y(k), world.u(k) - world.q(index(k)));
                    assert_eq!(world.q(index(k)), power(&world.a, index(k)) * world.q(0));
                }
            }
        }
    }
}

/// AK-q: E|q(k)|² = tr(Aᵏ M (Aᵏ)ᵀ) with M = E[q(0)q(0)ᵀ], and the sum over all k is tr(Y M), Y = AᵀYA + I: finite, so
/// |q(k)| → 0 with probability one as well. With A = 1 it is constant.
#[test]
fn the_transient_vanishes() {
    let mut draws = Draws::seeded(24);
    for p in [1, 2, 3] {
        let a = draws.contraction(p);
        let (v, start) = (draws.definite(p), draws.definite(p));
        // Uncorrelated: the stationary law at 0 and x(0).
        let m = stein(&a, &v) + start;
        let y = stein(&a.transpose(), &Matrix::identity(p));
        let all = trace(&(&y * &m));
        let (mut sum, mut second) = (ratio(0, 1), m.clone());
        for _ in 0..12 {
            sum += trace(&second);
            second = a.congruence(&second);
            // What is left of the sum is that of the transient which starts one step later.
            assert_eq!(&sum + trace(&(&y * &second)), all);
        }
        assert!(trace(&power(&a, 80).congruence(&m)) * ratio(100, 1) < trace(&m));
    }
    // The second moments in the sources of a world agree.
    let mut world = World::drawn(&mut draws, 2, 2, 3);
    world.a = integers(&[[0, 3], [0, 0]]);
    let m = moment(&world.q(0), &world.q(0));
    assert_eq!(moment(&world.q(1), &world.q(1)), world.a.congruence(&m));
    world.a = Matrix::identity(2);
    let constant = |k: usize| trace(&moment(&world.q(k), &world.q(k)));
    assert_eq!(constant(50), constant(0));
}

/// Readings in the order of time are what the estimators see: a check of the helper itself.
#[test]
fn the_world_obeys_its_equations() {
    let mut draws = Draws::seeded(25);
    let world = World::drawn(&mut draws, 2, 1, 3);
    let next: Q = &world.a * world.x(1) + world.noise(1);
    assert_eq!(next, world.x(2));
    assert_eq!(moment(&world.noise(1), &world.noise(2)), Matrix::zeros(2, 2));
    assert_eq!(moment(&world.noise(2), &world.observation_noise(2)), Matrix::zeros(2, 2));
    assert_eq!(moment(&world.noise(-1), &world.noise(-1)), world.v_covariance());
    assert_eq!(moment(&world.observation_noise(3), &world.observation_noise(3)), world.w_covariance());
}
