//! Coefficients that depend on the noise: F(k) on y(0), …, y(k) and H(k) on y(0), …, y(k−1), in every world of a noise of signs.

use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{Mode, RiccatiStep, riccati_path};
use num_traits::Signed;

use super::paths::{power, root};
use super::{scalar, scalar_mode};

const STEPS: usize = 4;

/// One outcome of x̃(0), w(1), …, w(n), v(0), …, v(n−1), each 1 or −1, and what comes of it; x̂(0) = 0, P(0) = 1.
struct World {
    w: Vec<Rational>,
    v: Vec<Rational>,
    readings: Vec<Rational>,
    /// x(0), …, x(n).
    states: Vec<Rational>,
    path: Vec<Mode<Rational>>,
    steps: Vec<RiccatiStep<Rational>>,
}

/// An unstable transition after a positive reading, a stable one after a negative one, and the gain of the sensor by the reading before.
fn transition(readings: &[Rational]) -> Rational {
    if readings[readings.len() - 1].is_positive() { ratio(-2, 1) } else { ratio(1, 2) }
}

fn observation(before: &[Rational]) -> Rational {
    if before.last().is_some_and(Signed::is_positive) { ratio(2, 1) } else { ratio(1, 1) }
}

impl World {
    fn of(code: usize) -> Self {
        let sign = |place: usize| ratio(if code >> place & 1 == 1 { 1 } else { -1 }, 1);
        let w: Vec<_> = (0..STEPS).map(|k| sign(1 + k)).collect();
        let v: Vec<_> = (0..STEPS).map(|k| sign(1 + STEPS + k)).collect();
        let (mut states, mut readings, mut path) = (vec![sign(0)], Vec::new(), Vec::new());
        for k in 0..STEPS {
            let h = observation(&readings);
            readings.push(&h * &states[k] + &v[k]);
            let f = transition(&readings);
            states.push(&f * &states[k] + &w[k]);
            path.push(scalar_mode([f, h, ratio(1, 1), ratio(1, 1)]));
        }
        let steps = riccati_path(&path, &scalar(ratio(1, 1)));
        Self { w, v, readings, states, path, steps }
    }

    fn all() -> Vec<Self> {
        (0..1 << (1 + 2 * STEPS)).map(Self::of).collect()
    }

    /// x̃(0), …, x̃(n), by the filter.
    fn errors(&self) -> Vec<Rational> {
        let mut estimate = ratio(0, 1);
        let mut errors = vec![self.states[0].clone()];
        for (k, step) in self.steps.iter().enumerate() {
            let (f, h) = (&self.path[k].transition()[(0, 0)], &self.path[k].observation()[(0, 0)]);
            estimate = f * &estimate + f * &step.gain[(0, 0)] * (&self.readings[k] - h * &estimate);
            errors.push(&self.states[k + 1] - &estimate);
        }
        errors
    }

    /// Δ(1), …, Δ(n).
    fn new_parts(&self) -> Vec<Rational> {
        let part = |(k, step): (usize, &RiccatiStep<Rational>)| {
            &self.w[k] - &self.path[k].transition()[(0, 0)] * &step.gain[(0, 0)] * &self.v[k]
        };
        self.steps.iter().enumerate().map(part).collect()
    }

    /// ∏[j=i..k−1] F(j)(I − L(j)H(j)).
    fn product(&self, i: usize, k: usize) -> Rational {
        self.steps[i..k].iter().map(|step| step.closed_loop[(0, 0)].clone()).product()
    }
}

fn mean(worlds: &[World], of: impl Fn(&World) -> Rational) -> Rational {
    worlds.iter().map(of).sum::<Rational>() / Rational::from_integer(worlds.len().into())
}

/// WG-68, WG-69, WG-noise-3, WG-70, WG-71, WG-72, WG-72-Delta, WG-73, WG-adapted: the error identities hold in each of the 512 worlds. The
/// noise is white with means 0 and variances 1, and the coefficients do depend on it.
///
/// WG-70: nothing says that the filter is optimal, and it is not: x̃(2) is correlated with a reading of the past.
#[test]
fn the_error_identities_hold_in_every_world() {
    let worlds = World::all();
    for world in &worlds {
        let (errors, parts, steps) = (world.errors(), world.new_parts(), &world.steps);
        for k in 0..STEPS {
            assert_eq!(errors[k + 1], &steps[k].closed_loop[(0, 0)] * &errors[k] + &parts[k]);
            let sum = (1..=k + 1).map(|i| world.product(i, k + 1) * &parts[i - 1]).sum::<Rational>();
            assert_eq!(errors[k + 1], world.product(0, k + 1) * &errors[0] + sum);
        }
    }
    let noise = |world: &World| [world.w.as_slice(), world.v.as_slice()].concat();
    for i in 0..2 * STEPS {
        assert_eq!(mean(&worlds, |world| noise(world)[i].clone()), ratio(0, 1));
        for j in 0..2 * STEPS {
            assert_eq!(mean(&worlds, |world| &noise(world)[i] * &noise(world)[j]), ratio(i64::from(i == j), 1));
        }
    }
    let depends = |of: &dyn Fn(&World) -> Rational, on: &dyn Fn(&World) -> Rational| {
        mean(&worlds, |world| of(world) * on(world)) != mean(&worlds, of) * mean(&worlds, on)
    };
    assert!(depends(&|world| world.path[1].transition()[(0, 0)].clone(), &|world| world.v[1].clone()));
    assert!(depends(&|world| world.path[1].observation()[(0, 0)].clone(), &|world| world.v[0].clone()));
    assert_ne!(mean(&worlds, |world| world.errors()[2].clone() * &world.readings[0]), ratio(0, 1));
}

/// WG-73-bound, WG-Delta-bound, WG-T3.1-bound, WG-T3.1: r = 1, over all worlds. Each norm of the bound is computed, and the theorem's own
/// constants: H² ≥ 1 = R and F² ≤ 4 make P(k) ≤ 5, hence ∏² ≤ 5(4/5)ⁿ.
#[test]
fn the_error_is_bounded_in_the_mean() {
    let worlds = World::all();
    let second = |of: &dyn Fn(&World) -> Rational| root(&mean(&worlds, |world| power(&of(world), 2)), 2);
    let upper = |value: Rational| value + ratio(1, 1 << 40);
    let (m, lambda) = (upper(root(&ratio(5, 1), 2)), upper(root(&ratio(4, 5), 2)));
    for k in 0..STEPS {
        let absolute = mean(&worlds, |world| world.errors()[k + 1].abs());
        let first = second(&|world| world.product(0, k + 1)) * second(&|world| world.errors()[0].clone());
        let of =
            |i: usize| second(&|world| world.product(i, k + 1)) * second(&|world| world.new_parts()[i - 1].clone());
        let bound = first + (1..=k + 1).map(of).sum::<Rational>();
        assert!(absolute <= bound);
        // The new part: ‖w‖₂ + ‖P‖₂^½ ‖v‖₄/√a with ‖w‖₂ = ‖v‖₄ = a = 1.
        let covariance = |world: &World| world.steps[k].next[(0, 0)].clone();
        let new = ratio(1, 1) + root(&mean(&worlds, |world| power(&covariance(world), 2)), 4);
        assert!(second(&|world| world.new_parts()[k].clone()) <= new);
        for world in &worlds {
            assert!(covariance(world) <= ratio(5, 1));
            let fl = &world.path[k].transition()[(0, 0)] * &world.steps[k].gain[(0, 0)];
            assert!(power(&fl, 2) <= covariance(world));
            for i in 0..=k {
                let decay = ratio(5, 1) * power(&ratio(4, 5), k + 1 - i);
                assert!(power(&world.product(i, k + 1), 2) <= decay);
            }
        }
        let new = ratio(1, 1) + upper(root(&ratio(5, 1), 2));
        assert!(absolute <= &m + &m * new / (ratio(1, 1) - &lambda));
    }
}

/// Erratum WG-adapted: with H(k) a function of y(k), as printed, y(k) = H(k)x(k) + v(k) need not have a solution: x = 1, v = 0 and H = 1 if y(k) ≤ 0, else 0.
/// With H(k) a function of y(k−1) it has exactly one, whatever y(k−1) was.
#[test]
fn an_observation_does_not_choose_its_own_sensor() {
    let h = |y: i64| i64::from(y <= 0);
    let (x, v) = (1, 0);
    // y is hx + v for one of the values of h.
    let printed = [0, 1].map(|value| value * x + v).iter().filter(|&&y| y == h(y) * x + v).count();
    let right = |before: i64| [0, 1].map(|value| value * x + v).iter().filter(|&&y| y == h(before) * x + v).count();
    assert_eq!((printed, right(-1), right(1)), (0, 1, 1));
}

/// WG-Delta-bound: a bound of L alone, from which print derives it, is none of FL: F = 4, H = 1, P = R = a = 1 have ‖L‖² ≤ ‖P‖/a = 1 and
/// ‖FL‖² = 4; ‖P₊‖/a = 9 holds. And F and L are dependent where F depends on the readings: E(FL)² is not E F² E L².
#[test]
fn the_transition_counts_in_the_new_part() {
    let mode = scalar_mode([4, 1, 1, 1].map(|value| ratio(value, 1)));
    let p = ratio(1, 1);
    let step = mode.step(&scalar(p.clone()));
    let (gain, square) = (step.gain.squared_norm(), (mode.transition() * &step.gain).squared_norm());
    assert!(gain <= p && square > p && square <= step.next[(0, 0)]);
    assert_eq!((square, step.next[(0, 0)].clone()), (ratio(4, 1), ratio(9, 1)));
    let worlds = World::all();
    let of = |world: &World| {
        let (f, l) = (&world.path[2].transition()[(0, 0)], &world.steps[2].gain[(0, 0)]);
        (power(f, 2), power(l, 2))
    };
    let product = mean(&worlds, |world| of(world).0) * mean(&worlds, |world| of(world).1);
    assert_ne!(mean(&worlds, |world| of(world).0 * of(world).1), product);
}
