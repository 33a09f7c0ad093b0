//! The densities and decompositions of the crate, for any φ, π and ζ that are affine in ξ.

use exact_kalman::matrix::Matrix;
use exact_kalman::nongaussian::{Affine, Choice, Decomposition, as_printed};
use exact_kalman::scalar::{Rational, ratio};

use super::Q;
use super::decomposition::decomposed;
use super::girsanov::log_ratios;
use super::measure::Changed;
use super::world::{Dice, Noises, World, integrated, negated, value};

const ALL: &[Noises] = &[Noises::Correlated, Noises::Uncorrelated, Noises::Standard];

fn affine(n: usize, dice: &mut Dice) -> Affine<Rational> {
    Affine { slope: dice.matrix(n, n), offset: dice.matrix(n, 1) }
}

fn choice(world: &World, dice: &mut Dice) -> Choice<Rational> {
    let mut list = || world.steps.iter().map(|_| affine(world.n, dice)).collect();
    Choice { drift: list(), moved: list(), start: affine(world.n, dice) }
}

/// An affine function of z as a function of all variables.
fn in_the_variables(world: &World, of: &Affine<Rational>) -> Q {
    let one = Matrix::from_fn(1, world.size(), |_, j| ratio(i64::from(j == 0), 1));
    &of.slope * world.z() + &of.offset * one
}

/// A choice, the decomposition that it makes by the crate, and by the equations as functions of all variables.
fn both(world: &World, dice: &mut Dice) -> (Decomposition<Rational>, super::decomposition::Decomposition) {
    let choice = choice(world, dice);
    // ζ, then φ(0), π(0), φ(1), π(1), …
    let drawn = choice.drift.iter().zip(&choice.moved).flat_map(|(drift, moved)| [drift, moved]);
    let mut drawn = std::iter::once(&choice.start).chain(drawn).map(|of| in_the_variables(world, of));
    let equations = decomposed(world, |_| drawn.next().expect("three at the first step, two at each other"));
    let path = world.path(&vec![Matrix::zeros(world.k, 1); world.steps.len()]);
    drop(drawn);
    (Decomposition::new(&path, choice).expect("noisy"), equations)
}

/// SM-3.3, SM-3.4, SM-3.5, SM-2.20, SM-3.7, SM-3.8, SM-3.9, SM-2.16: at a value of ξ and of the noises the crate has the Z, X, shifts and new noises of
/// the equations, and X + Z is the state of (1.1).
#[test]
fn the_parts_of_the_crate_are_those_of_the_equations() {
    for (world, mut dice) in World::all(ALL) {
        let (found, equations) = both(&world, &mut dice);
        let point = world.point(&mut dice);
        let z = world.z() * &point;
        let old: Vec<Q> = (0..world.steps.len()).map(|s| world.noise(s) * &point).collect();
        let at = |all: &[Q]| all.iter().map(|rows| rows * &point).collect::<Vec<_>>();
        let initial: Vec<Q> = found.initial_part().iter().map(|part| part.at(&z)).collect();
        assert_eq!(initial, at(&equations.z));
        let own = found.noise_part(&z, &old);
        assert_eq!(own, at(&equations.x));
        let states: Vec<Q> = own.iter().zip(&initial).map(|(own, initial)| own + initial).collect();
        assert_eq!(states, at(&world.states()));
        let new: Vec<Q> = equations.noise.iter().map(|(w, v)| w.above(v) * &point).collect();
        assert_eq!(found.new_noise(&z, &old), new);
        let shifts = found.shifts(&z);
        for ((shift, chi), (old, new)) in shifts.iter().zip(at(&equations.chi)).zip(old.iter().zip(&new)) {
            assert_eq!((shift.shift(), &shift.new_noise(old)), (&chi, new));
        }
    }
}

/// SM-3.6, SM-B3, SM-2.12, SM-2.14: the exponent of the crate at a value of ξ and of the noises is the sum over the steps of (2.12) for the pair; and the
/// integral of any power of the density over all noises, by completing squares, is what the crate says, 1 at the power 1.
///
/// Erratum SM-3.6: the printed exponent differs by the quadratic sum, and its integral is not 1 unless that sum is 0.
#[test]
fn the_density_of_the_crate_integrates_to_one() {
    let mut told = 0;
    for (world, mut dice) in World::all(ALL) {
        let (found, equations) = both(&world, &mut dice);
        let point = world.point(&mut dice);
        let z = world.z() * &point;
        let old: Vec<Q> = (0..world.steps.len()).map(|s| world.noise(s) * &point).collect();
        let all = log_ratios(&world, &equations.chi);
        let log = &all[world.steps.len()];
        let (right, printed) = (found.log_density(&z), as_printed::log_density(&found, &z));
        assert_eq!((right.at(&old), right.inverse().at(&old)), (value(log, &point), value(&negated(log), &point)));
        for power in [ratio(1, 1), ratio(0, 1), ratio(1, 2), ratio(2, 1), ratio(-5, 3)] {
            let (mean, determinant) = integrated(&log.scaled(&power), world.sources()).expect("finite");
            assert_eq!((value(&mean, &point), determinant), (right.log_moment(&power), ratio(1, 1)));
            let by_steps = found.shifts(&z).iter().fold(ratio(0, 1), |sum, step| sum + step.log_moment(&power));
            assert_eq!(by_steps, right.log_moment(&power));
        }
        // The integral of the printed form: the same linear part, the constant with the other sign.
        let excess = &printed.constant - &right.constant;
        assert_eq!((&printed.coefficients, printed.at(&old)), (&right.coefficients, right.at(&old) + &excess));
        assert_eq!((right.log_moment(&ratio(1, 1)), &printed.log_moment(&ratio(1, 1))), (ratio(0, 1), &excess));
        assert_eq!(excess, right.variance());
        told += usize::from(excess != ratio(0, 1));
    }
    assert!(told > 40, "φ and HZ are 0");
}

/// SM-P1, SM-3.14, SM-3.15, SM-Girsanov-b: with the choice of the paper, the law of the noises under ℙ̄ and given ξ = z, by the transform
/// Ē exp(∑ aᵀ(s)(W°, V°)(s+1)) as an integral over all noises, is that of independent N(Γχ, Γ): the means are moved and the covariances
/// stay. And log E[Lˢ | z] is ½(s² − s)zᵀMz by the density, by the steps and by the statistics.
#[test]
fn proposition_one() {
    for mut changed in Changed::all(ALL) {
        let point = changed.world.point(&mut changed.dice);
        let world = &changed.world;
        let (n, k, end) = (world.n, world.k, world.steps.len());
        let data = vec![Matrix::zeros(k, 1); end];
        let parts = Decomposition::new(&world.path(&data), Choice::of_the_paper(n, end)).expect("noisy");
        let z = world.z() * &point;
        let (mut transform, mut expected) = (changed.log[end].clone(), ratio(0, 1));
        for (s, step) in parts.shifts(&z).iter().enumerate() {
            let a = changed.dice.matrix(n + k, 1);
            let one = Matrix::from_fn(1, world.size(), |_, j| ratio(i64::from(j == 0), 1));
            transform = transform + super::world::product(&(&a * one), &world.noise(s));
            let law = step.law_of_noise();
            assert_eq!(law.covariance(), &world.steps[s].gamma());
            let exponent = law.characteristic_exponent(&a);
            expected += exponent.linear + exponent.quadratic * ratio(1, 2);
        }
        let (mean, determinant) = integrated(&transform, world.sources()).expect("finite");
        assert_eq!((value(&mean, &point), determinant), (expected, ratio(1, 1)));
        let last = world.statistics(&data).pop().expect("some");
        for power in [ratio(1, 1), ratio(0, 1), ratio(1, 2), ratio(7, 3)] {
            let (mean, _) = integrated(&changed.log[end].scaled(&power), world.sources()).expect("finite");
            let by_statistics = last.likelihood_ratio().log_moment(&power, &z);
            assert_eq!(
                (&value(&mean, &point), &parts.log_density(&z).log_moment(&power)),
                (&by_statistics, &by_statistics)
            );
        }
    }
}

/// SM-3.9, SM-3.14: entries of readings that are missing drop their rows of V°: the density is that of the system without these sensors.
#[test]
fn missing_entries_drop_their_noise() {
    use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
    let mut seen = 0;
    for (world, mut dice) in World::all(&[Noises::Correlated]).filter(|(world, _)| world.k == 2) {
        let path = |rows: &[usize], missing: bool| {
            let list = |of: &dyn Fn(&super::world::At) -> Q| {
                exact_kalman::model::Coefficient::per_step(world.steps.iter().map(of))
            };
            let system = System {
                timing: Timing::Departing,
                initial: Initial::new(Before::Observation, Matrix::zeros(world.n, 1), Matrix::zeros(world.n, world.n)),
                transition: list(&|at| at.a.clone()),
                observation: list(&|at| at.h.select_rows(rows)),
                noise: Noise::Factors {
                    process: list(&|at| at.plant.clone()),
                    observation: list(&|at| at.sensors.select_rows(rows)),
                },
                input: None,
                observation_input: None,
            };
            let entry = |i: usize| (!missing || i == 0).then(|| ratio(0, 1));
            let data = world.steps.iter().map(|_| Observation::new((0..rows.len()).map(entry).collect()));
            system.realised(&data.collect::<Vec<_>>()).expect("a model")
        };
        let choice = choice(&world, &mut dice);
        let of = |path| Decomposition::new(&path, choice.clone()).expect("noisy");
        assert_eq!(of(path(&[0, 1], true)), of(path(&[0], false)));
        seen += usize::from(of(path(&[0, 1], false)) != of(path(&[0], false)));
    }
    assert!(seen > 3);
}
