//! The recursions as a filter, and what does not depend on the horizon.

use exact_kalman::filter::filter;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Noise, Observation, System, Timing};
use exact_kalman::scalar::{Rational, ratio};

use super::measure::Changed;
use super::world::{Noises, World, integrated};
use super::{Q, number, scalar};

const BOTH: &[Noises] = &[Noises::Correlated, Noises::Standard];

/// SM-3.23, SM-3.23-filter: the filter of the crate on the augmented system gives (X̄, B̄) and Σ.
#[test]
fn the_recursions_are_the_filter_of_the_augmented_system() {
    let mut told = 0;
    for (world, mut dice) in World::all(BOTH) {
        let (n, psi) = (world.n, world.psi());
        let data: Vec<Q> = world.steps.iter().map(|_| dice.matrix(world.k, 1)).collect();
        let list = |of: &dyn Fn(usize) -> Q| Coefficient::per_step((0..world.steps.len()).map(of));
        let system = System {
            timing: Timing::Departing,
            initial: Initial::new(Before::Observation, Matrix::zeros(2 * n, 1), Matrix::zeros(2 * n, 2 * n)),
            transition: list(&|t| world.steps[t].a.block_diagonal(&Matrix::identity(n))),
            observation: list(&|t| world.steps[t].h.beside(&Matrix::zeros(world.k, n))),
            noise: Noise::Factors {
                process: list(&|t| {
                    let at = &world.steps[t];
                    at.plant.above(&((&at.h * &psi[t]).transpose() * at.v_inverse() * &at.sensors))
                }),
                observation: list(&|t| world.steps[t].sensors.clone()),
            },
            input: None,
            observation_input: None,
        };
        let readings: Vec<_> = data.iter().map(|y| Observation::complete(y.entries().to_vec())).collect();
        let trace = filter(&system.realised(&readings).expect("a model")).expect("regular");
        let predicted = trace.records.into_iter().skip(1).map(|record| record.predicted).chain(trace.ahead);
        let printed =
            exact_kalman::nongaussian::as_printed::statistics_with_printed_error(&world.path(&data)).expect("noisy");
        for ((now, printed), truth) in world.statistics(&data)[1..].iter().zip(&printed[1..]).zip(predicted) {
            assert_eq!((now.mean.above(&now.linear), now.joint_covariance()), (truth.mean, truth.covariance));
            told += usize::from(printed.joint_covariance() != now.joint_covariance());
        }
    }
    assert!(told > 20, "(2.4) as printed agrees");
}

/// SM-horizon-free, SM-2.8: nothing at t + 1 depends on what comes after Y(t): neither readings nor coefficients.
#[test]
fn the_statistics_do_not_know_the_horizon() {
    for (mut world, mut dice) in World::all(BOTH) {
        let mut data: Vec<Q> = world.steps.iter().map(|_| dice.matrix(world.k, 1)).collect();
        let all = world.statistics(&data);
        for t in (1..world.steps.len()).rev() {
            data[t] = dice.matrix(world.k, 1);
            assert_eq!(world.statistics(&data)[..=t], all[..=t]);
            world.steps.pop();
            data.pop();
            assert_eq!(world.statistics(&data), all[..=t]);
        }
    }
}

/// SM-horizon: E[L(T+1) | ℱ(T)] = L(T), and for A = H = Σᵛ = 1, ξ = 1: M(T) = T, so that E√L(T) = exp(−T/8) tends to 0.
#[test]
fn the_limit_measure_may_be_singular() {
    for changed in Changed::all(BOTH) {
        let world = &changed.world;
        for s in 0..world.steps.len() {
            assert_eq!(integrated(&changed.log[s + 1], world.source(s)), Some((changed.log[s].clone(), ratio(1, 1))));
        }
    }
    let all = exact_kalman::nongaussian::statistics(&scalar([1, 1, 1, 0, 1], &[0; 20])).expect("noisy");
    for (t, now) in (0..).zip(&all) {
        let log: Rational = now.likelihood_ratio().log_moment(&ratio(1, 2), &number(ratio(1, 1)));
        assert_eq!(log, ratio(-t, 8));
    }
}
