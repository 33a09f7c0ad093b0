//! How the start and the noise enter the estimates, and how they do not.

use exact_kalman::filter::filter;
use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Input, Noise, Observation, System, Timing};
use exact_kalman::nongaussian::{Enclosed, InitialLaw, Statistics, statistics};
use exact_kalman::scalar::{Rational, ratio};

use super::Q;
use super::world::{Dice, Noises, World, stacked};

const BOTH: &[Noises] = &[Noises::Correlated, Noises::Standard];

fn gaussian(mean: &Q, covariance: &Q) -> InitialLaw<Rational> {
    InitialLaw::gaussian(Gaussian::new(mean.clone(), covariance.clone()).expect("symmetric")).expect("a law")
}

/// Means with covariances of every rank from 0 to n.
fn moments(n: usize, dice: &mut Dice) -> Vec<(Q, Q)> {
    let factors: Vec<Q> = (0..=n).map(|rank| dice.matrix(n, rank)).collect();
    factors.into_iter().map(|factor| (dice.matrix(n, 1), &factor * factor.transpose())).collect()
}

/// SM-A4, SM-LMMSE, SM-4.3: for Δ of any rank, 0 included, the error of X̄ + Q*(I + ΔR*)⁻¹(ΔB̄ + μ), as a linear function of ξ − μ and the sources, has mean
/// 0 and is uncorrelated with every reading, which makes it the best affine estimate; its covariance is the one that is stated. With
/// Δ > 0 it is the formula as printed.
#[test]
fn a_degenerate_start_needs_no_inverse() {
    let mut ranks = [0; 2];
    for (world, mut dice) in World::all(BOTH) {
        let n = world.n;
        let all = world.linear_statistics();
        for (mu, delta) in moments(n, &mut dice) {
            let law = gaussian(&mu, &delta);
            for (t, linear) in all.iter().enumerate() {
                let now = &linear.now;
                let columns = 0..world.k * (t + 1);
                let (mean_map, b_map) = (linear.mean.block(0..n, columns.clone()), linear.linear.block(0..n, columns));
                let readings = stacked(&world.readings()[..=t]);
                // The estimate by the code at readings 0 and at each unit: an affine function.
                let estimate = |y: &Q| {
                    let data = Statistics { mean: &mean_map * y, linear: &b_map * y, ..now.clone() };
                    data.linear(&law)
                };
                let rows = readings.rows();
                let constant = estimate(&Matrix::zeros(rows, 1)).estimate;
                let slope = (0..rows).fold(Matrix::zeros(n, 0), |all, j| {
                    let unit = Matrix::from_fn(rows, 1, |i, _| ratio(i64::from(i == j), 1));
                    all.beside(&(estimate(&unit).estimate - &constant))
                });
                let error = &world.states()[t + 1] - &slope * &readings;
                let part = |rows: &Q, columns: std::ops::Range<usize>| rows.block(0..rows.rows(), columns);
                let (z, sources) = (1..1 + n, world.sources());
                assert_eq!(part(&error, z.clone()) * &mu, constant);
                let covariance = |one: &Q, other: &Q| {
                    part(one, z.clone()) * &delta * part(other, z.clone()).transpose()
                        + part(one, sources.clone()) * part(other, sources.clone()).transpose()
                };
                assert!(covariance(&error, &readings).is_zero());
                assert_eq!(covariance(&error, &error), estimate(&Matrix::zeros(rows, 1)).covariance);
                if delta.rank() == n {
                    let inverse = delta.inverse().expect("regular");
                    let inner = (now.precision() + &inverse).inverse().expect("regular");
                    assert_eq!(slope, &mean_map + now.response() * &inner * &b_map);
                    assert_eq!(constant, now.response() * inner * inverse * &mu);
                }
                ranks[usize::from(delta.rank() == n)] += 1;
            }
        }
    }
    assert!(ranks.iter().all(|&count| count > 20), "{ranks:?}");
}

/// SM-A4: Theorem 3 with a singular Δ: atoms (±1, 0) of two states, of which one sensor reads the first, have the price of the scalar model with atoms
/// ±1, whose Δ is 1, since the second state is known.
#[test]
fn a_degenerate_start_has_its_price() {
    let one = |n: usize| Matrix::<Rational>::identity(n);
    let price = |n: usize| {
        let system = System {
            timing: Timing::Departing,
            initial: Initial::new(Before::Observation, Matrix::zeros(n, 1), Matrix::zeros(n, n)),
            transition: one(n).into(),
            observation: one(n).select_rows(&[0]).into(),
            noise: Noise::Covariances { process: one(n).into(), cross: None, observation: one(1).into() },
            input: None,
            observation_input: None,
        };
        let path = system.realised(&[Observation::complete([ratio(2, 1)])]).expect("a model");
        let now = statistics(&path).expect("noisy").pop().expect("some");
        let atoms = [1, -1].map(|x| (ratio(1, 2), one(n).select_columns(&[0]).scaled(&ratio(x, 1))));
        let law = InitialLaw::atoms(atoms).expect("a law");
        assert_eq!(law.covariance().rank(), 1);
        now.price_of_linearity(&law, 20).expect("one direction")
    };
    let (Enclosed::Between(scalar), Enclosed::Between(degenerate)) = (price(1), price(2)) else { panic!("irrational") };
    assert!(scalar.lower() <= degenerate.upper() && degenerate.lower() <= scalar.upper());
    assert!(!degenerate.lower().is_negative() && !degenerate.lower().is_zero());
}

/// SM-T2-remark-ii: one run of the statistics serves every μ and Δ: a filter started anew from N(μ, Δ), for Δ of any rank, gives X̄ + Q*(CB̄ + d) with
/// C = (I + ΔR*)⁻¹Δ and d = (I + ΔR*)⁻¹μ, for Δ > 0 the map of the remark, and the covariance P + Q*CQ*ᵀ. Two starts with one map have one
/// estimate, and nothing is lost: μ and Δ follow from the map.
#[test]
fn mean_and_covariance_enter_through_one_map() {
    for (world, mut dice) in World::all(BOTH) {
        let n = world.n;
        let data: Vec<Q> = world.steps.iter().map(|_| dice.matrix(world.k, 1)).collect();
        let all = world.statistics(&data);
        for (mu, delta) in moments(n, &mut dice) {
            let path = world.path_from(&data, &mu, &delta);
            let trace = filter(&path).expect("regular");
            let predicted = trace.records.into_iter().skip(1).map(|record| record.predicted).chain(trace.ahead);
            for (now, predicted) in all[1..].iter().zip(predicted) {
                let (response, precision) = (now.response(), now.precision());
                let inverse = (Matrix::identity(n) + &delta * &precision).inverse().expect("regular");
                let (c, d) = (&inverse * &delta, &inverse * &mu);
                assert_eq!(predicted.mean, &now.mean + &response * (&c * &now.linear + &d));
                assert_eq!(predicted.covariance, &now.covariance + response.congruence(&c));
                assert_eq!(now.linear(&gaussian(&mu, &delta)).estimate, predicted.mean);
                if let Ok(of_delta) = delta.inverse() {
                    let printed = (&precision + &of_delta).inverse().expect("regular");
                    assert_eq!((&printed, printed.clone() * (of_delta * &mu)), (&c, d.clone()));
                }
                // C(I − R*C)⁻¹ = Δ and (I + ΔR*)d = μ
                let back = (Matrix::identity(n) - &precision * &c).inverse().expect("regular");
                assert_eq!((&c * back, d + &delta * &precision * (&inverse * &mu)), (delta.clone(), mu.clone()));
            }
        }
    }
}

/// A correlated system and the uncorrelated one with Σᵛ = I that says the same: Y' = T⁻¹Y with Σᵛ = TTᵀ, A' = A − ΣʷᵛΣᵛ⁻¹H, and ΣʷᵛΣᵛ⁻¹Y as a
/// known input.
fn standardised(world: &World, roots: &[Q], data: &[Q]) -> Vec<Statistics<Rational>> {
    let list = |of: &dyn Fn(usize) -> Q| Coefficient::per_step((0..world.steps.len()).map(of));
    let root_inverse = |t: usize| roots[t].inverse().expect("regular");
    let system = System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, Matrix::zeros(world.n, 1), Matrix::zeros(world.n, world.n)),
        transition: list(&|t| &world.steps[t].a - world.steps[t].regression() * &world.steps[t].h),
        observation: list(&|t| root_inverse(t) * &world.steps[t].h),
        noise: Noise::Covariances {
            process: list(&|t| world.steps[t].w() - world.steps[t].regression() * world.steps[t].wv().transpose()),
            cross: None,
            observation: Matrix::identity(world.k).into(),
        },
        input: Some(Input { matrix: None, vector: list(&|t| world.steps[t].regression() * &data[t]) }),
        observation_input: None,
    };
    let readings: Vec<_> =
        data.iter().enumerate().map(|(t, y)| Observation::complete((root_inverse(t) * y).entries().to_vec())).collect();
    statistics(&system.realised(&readings).expect("a model")).expect("noisy")
}

/// SM-T1-remark, SM-2.2: a correlated system with any Σᵛ and an uncorrelated one with Σᵛ = I, where section II applies and Ψ is its Φ, whose state
/// and whose knowledge of it are the same, have the same Ψ, P, Q, R, M, X̄ and B̄, although every covariance of the noises, Φ and J differ. So one
/// function of these statistics serves both: the functionals do not see the noise.
#[test]
fn the_noise_enters_through_the_statistics() {
    let mut differ = 0;
    for (mut world, mut dice) in World::all(&[Noises::Correlated]) {
        // Σᵛ = TTᵀ needs a square root: T = [1 0; c 2] shares its sources with the plant.
        let k = world.k;
        let roots: Vec<Q> = world
            .steps
            .iter()
            .map(|_| {
                Matrix::from_fn(k, k, |i, j| {
                    ratio(i64::from(i >= j) + i64::try_from(dice.below(2) * u64::from(i == j)).unwrap_or(0), 1)
                })
            })
            .collect();
        for (at, root) in world.steps.iter_mut().zip(&roots) {
            at.sensors = Matrix::zeros(k, world.q - k).beside(root);
        }
        let data: Vec<Q> = world.steps.iter().map(|_| dice.matrix(k, 1)).collect();
        let (own, standard) = (world.statistics(&data), standardised(&world, &roots, &data));
        for (t, (one, other)) in own.iter().zip(&standard).enumerate() {
            assert_eq!(other.state_transition, one.transition);
            if let (Some(j), Some(other_j)) = (&one.innovation_covariance, &other.innovation_covariance) {
                assert_eq!(j, &(world.steps[t - 1].h.congruence(&own[t - 1].covariance) + world.steps[t - 1].v()));
                assert_eq!(j, &roots[t - 1].congruence(other_j));
                differ += usize::from(j != other_j && one.state_transition != one.transition);
            }
            let alike = Statistics {
                innovation_covariance: one.innovation_covariance.clone(),
                state_transition: one.state_transition.clone(),
                ..other.clone()
            };
            assert_eq!(&alike, one);
            let law = InitialLaw::atoms([(1, 3), (2, 3)].map(|(p, q)| (ratio(p, q), dice.matrix(world.n, 1))))
                .expect("a law");
            assert_eq!(one.posterior(&law), other.posterior(&law));
        }
    }
    assert!(differ > 5, "{differ}");
}
