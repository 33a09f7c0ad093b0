//! The system, its decomposition into noise and initial condition, and what is free in it.

use exact_kalman::filter::filter;
use exact_kalman::gaussian::Gaussian;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, System, Timing};
use exact_kalman::nongaussian::as_printed::{self, noise_coefficients};
use exact_kalman::nongaussian::{Affine, Choice, StatisticsError};
use exact_kalman::scalar::{Rational, ratio};

use super::girsanov::log_ratios;
use super::world::{At, Dice, Noises, World, form, half, integrated, product, stacked};
use super::{Q, number};

const BOTH: &[Noises] = &[Noises::Correlated, Noises::Standard];

/// SM-1.1, SM-1.2, SM-A1, SM-1.6, SM-4.4, SM-T2-remark-i: the state is linear in ξ and the noises, with these coefficients; so it and
/// the readings have second moments. The law of the readings given ξ = 0 that these coefficients make is the one that the
/// filter of the crate takes the model for.
#[test]
fn the_state_is_linear_in_the_start_and_the_noise() {
    for (world, mut dice) in World::all(BOTH) {
        let states = world.states();
        for (t, state) in states.iter().enumerate() {
            let mut sum = &world.transitions(0, false)[t] * world.z();
            for s in 0..t {
                sum = sum + &world.transitions(s + 1, false)[t - s - 1] * world.plant_noise(s);
            }
            assert_eq!(&sum, state);
        }
        let none = vec![Matrix::zeros(world.k, 1); world.steps.len()];
        let found: Vec<Q> = world.statistics(&none).into_iter().map(|now| now.state_transition).collect();
        assert_eq!(found, world.transitions(0, false));
        let slope = stacked(&world.readings());
        let slope = slope.block(0..slope.rows(), world.sources());
        let data: Vec<Q> = world.steps.iter().map(|_| dice.matrix(world.k, 1)).collect();
        let (y, covariance) = (stacked(&data), &slope * slope.transpose());
        let quadratic = (y.transpose() * covariance.solve(&y).expect("regular"))[(0, 0)].clone();
        let trace = filter(&world.path(&data)).expect("regular");
        let parts: Vec<_> = trace.records.iter().map(|record| record.likelihood.clone().expect("regular")).collect();
        assert_eq!(parts.iter().fold(ratio(0, 1), |sum, part| sum + &part.quadratic), quadratic);
        let product = parts.iter().fold(ratio(1, 1), |sum, part| sum * &part.pseudo_determinant);
        assert_eq!(Ok(product), covariance.determinant());
    }
}

/// Erratum SM-4.4: X°(t+1) is Φ(t+1,0)ξ plus the sum of Φ(t+1,s+1)W°(s+1), for any model; with Φ(t,s) as printed the sum is another one
/// wherever A changes, and the same for constant A. A(0) = 2, A(1) = 3: 3W°(1) + W°(2), printed 2W°(1) + W°(2).
#[test]
fn the_noise_is_carried_from_its_own_time() {
    // Whether the state is the sum with these coefficients, right and as printed.
    let hold = |world: &World| {
        let (t, states) = (world.steps.len() - 1, world.states());
        let path = world.path(&vec![Matrix::zeros(world.k, 1); t + 1]);
        let right: Vec<Q> = (0..=t).map(|s| world.transitions(s + 1, false)[t - s].clone()).collect();
        [right, noise_coefficients(&path, t)].map(|coefficients| {
            let start = &world.transitions(0, false)[t + 1] * world.z();
            let terms = coefficients.iter().enumerate().map(|(s, coefficient)| coefficient * world.plant_noise(s));
            terms.fold(start, |sum, term| sum + term) == states[t + 1]
        })
    };
    let mut differ = 0;
    for (mut world, _) in World::all(BOTH) {
        let [right, printed] = hold(&world);
        assert!(right);
        differ += usize::from(!printed);
        let first = world.steps[0].a.clone();
        world.steps.iter_mut().for_each(|at| at.a = first.clone());
        assert_eq!(hold(&world), [true, true]);
    }
    assert!(differ > 10);
    let one = |a: i64| At {
        a: Matrix::from_integers(&[[a]]),
        h: Matrix::identity(1),
        plant: Matrix::from_integers(&[[1, 0]]),
        sensors: Matrix::from_integers(&[[0, 1]]),
    };
    let world = World { n: 1, k: 1, q: 2, steps: vec![one(2), one(3)] };
    let of = |s: usize| world.states()[2].block(0..1, world.source(s))[(0, 0)].clone();
    let printed = noise_coefficients(&world.path(&[number(ratio(0, 1)), number(ratio(0, 1))]), 1);
    assert_eq!([of(0), of(1)], [ratio(3, 1), ratio(1, 1)]);
    assert_eq!(printed, [number(ratio(2, 1)), number(ratio(1, 1))]);
}

/// Erratum SM-1.1: for n = 2 and k = 1 the model is accepted with H of shape k×n, and refused with n×k as printed.
#[test]
fn the_observation_matrix_has_a_row_for_each_sensor() {
    let system = |h: Q| System {
        timing: Timing::Departing,
        initial: Initial::new(Before::Observation, Matrix::zeros(2, 1), Matrix::zeros(2, 2)),
        transition: Matrix::<Rational>::identity(2).into(),
        observation: h.into(),
        noise: Noise::Covariances {
            process: Matrix::identity(2).into(),
            cross: None,
            observation: Matrix::identity(1).into(),
        },
        input: None,
        observation_input: None,
    };
    let accepts = |h: Q| system(h).realised(&[Observation::complete([ratio(1, 1)])]).is_ok();
    assert!(accepts(Matrix::from_integers(&[[1, 2]])));
    assert!(!accepts(Matrix::from_integers(&[[1], [2]])));
}

/// Erratum SM-1.2: for n = 2, k = 1 the rows of Γ have length 3 with Σᵛʷ in the lower left block, and unequal lengths with Σᵛ.
///
/// Erratum SM-3.12: and the first row of the new noises has n = 2 rows with Σʷᵛ, and k = 1 with Σᵛ in its place.
#[test]
fn blocks_have_matching_shapes() {
    let at = &(1..100)
        .map(|seed| World::random(seed, Noises::Correlated))
        .find(|w| (w.n, w.k) == (2, 1))
        .expect("some")
        .steps[0];
    let upper = at.w().beside(&at.wv());
    let row = |left: &Q| left.columns() + at.v().columns();
    assert_eq!((upper.columns(), row(&at.wv().transpose()), row(&at.v())), (3, 3, 2));
    assert_eq!(upper.above(&at.wv().transpose().beside(&at.v())), at.gamma());
    let times = |left: &Q| (left * at.v_inverse() * &at.h).rows();
    assert_eq!((times(&at.wv()), times(&at.v())), (2, 1));
}

/// Erratum SM-3.2: ℱ(2) with W°(s+1) knows the state X°(2); with W°(2) alone, as printed, it does not: A = Σʷ = Σᵛ = 1, Σʷᵛ = 0.
#[test]
fn the_filtration_knows_every_noise_so_far() {
    let row = |entries: [i64; 5]| Matrix::from_integers(&[entries]);
    // (ξ, W°(1), W°(2), V°(1), V°(2))
    let unit = |i: usize| Matrix::from_fn(1, 5, |_, j| ratio(i64::from(i == j), 1));
    let state = row([1, 1, 1, 0, 0]);
    let knows = |generators: &[usize]| {
        let span = stacked(&generators.iter().map(|&i| unit(i)).collect::<Vec<_>>());
        span.above(&state).rank() == span.rank()
    };
    assert!(knows(&[0, 1, 2, 3, 4]));
    assert!(!knows(&[0, 2, 3, 4]));
}

/// SM-3.2: everything that the filtration should know at t depends on ξ and the noises up to t only: X°(t), Y(t−1), Z(t).
///
/// SM-3.1: V° is white noise for a filtration that begins with all of W° exactly if Σʷᵛ = 0.
#[test]
fn filtrations() {
    for (world, _) in World::all(BOTH) {
        let later = |t: usize| world.sources().start + world.q * t..world.size();
        for (t, state) in world.states().iter().enumerate() {
            assert!(state.block(0..world.n, later(t)).is_zero());
        }
        for (t, reading) in world.readings().iter().enumerate() {
            assert!(reading.block(0..world.k, later(t + 1)).is_zero());
        }
        for s in 0..world.steps.len() {
            let covariance = |u: usize| world.plant_noise(u) * world.sensor_noise(s).transpose();
            let all_zero = (0..world.steps.len()).all(|u| covariance(u).is_zero());
            assert_eq!(all_zero, world.steps[s].wv().is_zero());
        }
    }
}

/// Erratum SM-3.1: V° is white noise for ℱ, that is V°(t+1) has the law N(0, Σᵛ) given ξ, all of W° and V° before it, exactly if Σʷᵛ = 0.
/// Printed Σᵛ = 0, which holds for none of these models, white or not, and which SM-A2 refuses.
///
/// SM-2.21, SM-3.14: likewise (2.21), with Σᵛ⁻¹, makes (W°, V) white exactly if ΣʷᵛΣᵛ⁻¹HZ = 0: otherwise W° gets a mean that depends on ξ.
#[test]
fn the_condition_is_on_the_cross_covariance() {
    let mut whites = [0; 2];
    for (world, mut dice) in World::all(&[Noises::Correlated, Noises::Uncorrelated, Noises::Standard]) {
        let sources = world.sources();
        let of_sources = |rows: Q| rows.block(0..rows.rows(), sources.clone());
        let plant: Vec<Q> = (0..world.steps.len()).map(|s| of_sources(world.plant_noise(s))).collect();
        let sensors: Vec<Q> = (0..world.steps.len()).map(|s| of_sources(world.sensor_noise(s))).collect();
        let drawn = dice.matrix(sources.len(), 1);
        let is_white = (0..world.steps.len()).all(|t| {
            let known = stacked(&[&plant[..], &sensors[..t]].concat());
            let joint = known.above(&sensors[t]);
            let law = Gaussian::new(Matrix::zeros(joint.rows(), 1), &joint * joint.transpose()).expect("symmetric");
            let rows: Vec<usize> = (0..known.rows()).collect();
            let given = law.conditioned(&rows, &(known * &drawn)).expect("these values can occur").law;
            (given.mean(), given.covariance()) == (&Matrix::zeros(world.k, 1), &world.steps[t].v())
        });
        let right = world.steps.iter().all(|at| at.wv().is_zero());
        let printed = world.steps.iter().all(|at| at.v().is_zero());
        assert_eq!((is_white, false), (right, printed));
        whites[usize::from(is_white)] += 1;

        let path = world.path(&vec![Matrix::zeros(world.k, 1); world.steps.len()]);
        let parts =
            exact_kalman::nongaussian::Decomposition::new(&path, Choice::of_the_paper(world.n, world.steps.len()));
        let z = dice.matrix(world.n, 1);
        for (s, step) in parts.expect("noisy").shifts(&z).iter().enumerate() {
            let mean = step.law_of_noise().mean().block(0..world.n, 0..1);
            let at = &world.steps[s];
            assert_eq!(mean, (at.regression() * &at.h * &world.psi()[s] * &z).scaled(&ratio(-1, 1)));
        }
    }
    assert!(whites.iter().all(|&count| count > 10), "{whites:?}");
    let refused = exact_kalman::nongaussian::statistics(&super::scalar([1, 1, 1, 0, 0], &[1]));
    assert!(matches!(refused, Err(StatisticsError::Noiseless { .. })));
}

/// φ, π and ζ, affine and adapted, and what follows from them.
pub struct Decomposition {
    pub phi: Vec<Q>,
    pub chi: Vec<Q>,
    /// (W(t+1), V(t+1)) by (3.3).
    pub noise: Vec<(Q, Q)>,
    pub x: Vec<Q>,
    pub z: Vec<Q>,
}

fn decomposition(world: &World, dice: &mut Dice, chosen: bool) -> Decomposition {
    decomposed(world, |t| {
        let drawn = world.adapted(world.n, t, dice);
        if chosen { Matrix::zeros(world.n, world.size()) } else { drawn }
    })
}

/// The decomposition with these φ(t) and π(t), and ζ, which is asked for first and at 0.
pub fn decomposed(world: &World, mut any: impl FnMut(usize) -> Q) -> Decomposition {
    let zeta = any(0);
    let (mut x, mut z) = (vec![zeta.clone()], vec![world.z() - zeta]);
    let (mut all_phi, mut all_chi, mut noise) = (Vec::new(), Vec::new(), Vec::new());
    for (t, at) in world.steps.iter().enumerate() {
        let (phi, pi) = (any(t), any(t));
        // (3.4), (3.3)
        let phi_v = (at.v_inverse() * (at.wv().transpose() * &phi + &at.h * &z[t])).scaled(&ratio(-1, 1));
        let chi = phi.above(&phi_v);
        let both = world.noise(t) - at.gamma() * &chi;
        let rows = |range| both.block(range, 0..world.size());
        let (w, v) = (rows(0..world.n), rows(world.n..world.n + world.k));
        // (3.8), (3.9)
        let schur = at.w() - at.regression() * at.wv().transpose();
        x.push(&at.a * &x[t] + &w + &schur * &phi - &pi);
        z.push((&at.a - at.regression() * &at.h) * &z[t] + pi);
        noise.push((w, v));
        all_phi.push(phi);
        all_chi.push(chi);
    }
    Decomposition { phi: all_phi, chi: all_chi, noise, x, z }
}

/// SM-B1, SM-2.16, SM-2.19, SM-2.20, SM-3.3, SM-3.4, SM-3.5, SM-3.7, SM-3.8, SM-3.9: for any adapted φ and π and any ζ the parts add up to
/// the state, the readings are those of the noise part, and the new noises are as they are written.
#[test]
fn every_decomposition_adds_up() {
    for (world, mut dice) in World::all(BOTH) {
        let parts = decomposition(&world, &mut dice, false);
        let (states, readings) = (world.states(), world.readings());
        for (t, at) in world.steps.iter().enumerate() {
            let (w, v) = &parts.noise[t];
            let (x, z, phi) = (&parts.x[t], &parts.z[t], &parts.phi[t]);
            assert_eq!(x + z, states[t]);
            // (2.19), (2.20)
            assert_eq!(v, &(world.sensor_noise(t) + &at.h * z));
            assert_eq!(&at.h * x + v, readings[t]);
            let schur = at.w() - at.regression() * at.wv().transpose();
            assert_eq!(w, &(world.plant_noise(t) + at.regression() * &at.h * z - &schur * phi));
            let seven = &at.a * x + (&at.a - at.regression() * &at.h) * z + w + &schur * phi;
            assert_eq!((&seven, &(&parts.x[t + 1] + &parts.z[t + 1])), (&states[t + 1], &states[t + 1]));
            // Another φᵛ gives another V: Σᵛ is regular.
            assert_eq!(at.v().rank(), world.k);
        }
    }
}

/// Erratum SM-3.5: n = k = 1, Σʷ = 1, Σʷᵛ = 0, Z = 0, φ = 1: W = W° − 1 by (3.3), written out; without the minus sign W° + 1, whose mean
/// under the new measure, where W° has the mean 1, is 2 and not 0. And as it stands in print a vector of n rows stands before a
/// matrix of n rows, a product without a value for n = 2.
#[test]
fn the_shift_of_the_plant_noise_is_subtracted() {
    let (one, zero) = (Matrix::<Rational>::identity(1), Matrix::<Rational>::zeros(1, 1));
    let choice = Choice {
        drift: vec![Affine { slope: zero.clone(), offset: one.clone() }],
        moved: vec![Affine::zero(1)],
        // ζ = ξ, so that Z(0) = 0
        start: Affine { slope: one, offset: zero },
    };
    let parts =
        exact_kalman::nongaussian::Decomposition::new(&super::scalar([1, 1, 1, 0, 1], &[0]), choice).expect("noisy");
    let z = number(ratio(5, 1));
    for noise in [-2, 0, 5] {
        let old = [Matrix::from_integers(&[[noise], [7]])];
        // (W°, V°) − Γ(φ, 0)
        let by_definition = &old[0] - Matrix::<Rational>::identity(2) * Matrix::from_integers(&[[1], [0]]);
        let printed = as_printed::new_noise(&parts, &z, &old);
        assert_eq!(printed, [Matrix::from_integers(&[[noise + 1], [7]])]);
        assert_ne!(printed[0], by_definition);
        assert_eq!(parts.new_noise(&z, &old), [by_definition]);
    }
    let mean = [parts.shifts(&z)[0].law_of_noise().mean().clone()];
    assert_eq!(mean, [Matrix::from_integers(&[[1], [0]])]);
    assert_eq!(parts.new_noise(&z, &mean), [Matrix::from_integers(&[[0], [0]])]);
    assert_eq!(as_printed::new_noise(&parts, &z, &mean), [Matrix::from_integers(&[[2], [0]])]);
    let world =
        (1..100).map(|seed| World::random(seed, Noises::Correlated)).find(|w| (w.n, w.k) == (2, 1)).expect("some");
    let at = &world.steps[0];
    let (vector, matrix) = (at.regression() * &at.h * world.z(), at.w() - at.regression() * at.wv().transpose());
    assert_ne!(vector.columns(), matrix.rows());
}

/// SM-3.6, SM-B3: the exponent of (3.6) is that of (2.12) for the pair, so that the new measure is what SM-B3 asks for, for any
/// adapted φ: in its sources the new noises are C times white noise, free of ξ.
///
/// Erratum SM-3.6: with +½ the mean of the density given ξ = z is not 1; it is exp(1/2) for φ = 0, T = 0, H = 1, Σᵛ = 2, z = 1.
#[test]
fn the_density_before_the_choice() {
    for (world, mut dice) in World::all(BOTH) {
        let parts = decomposition(&world, &mut dice, false);
        let zero = Matrix::zeros(world.size(), world.size());
        let (mut linear, mut quadratic) = (zero.clone(), zero.clone());
        for (s, at) in world.steps.iter().enumerate() {
            let (phi, z) = (&parts.phi[s], &parts.z[s]);
            let rest = world.plant_noise(s) - at.regression() * world.sensor_noise(s);
            linear = linear + product(phi, &rest) - product(&(&at.h * z), &(at.v_inverse() * world.sensor_noise(s)));
            let schur = at.w() - at.regression() * at.wv().transpose();
            quadratic = quadratic + form(phi, &schur) + form(&(&at.h * z), &at.v_inverse());
        }
        let right = &linear - half(&quadratic);
        assert_eq!(right, log_ratios(&world, &parts.chi)[world.steps.len()]);
        assert_eq!(integrated(&right, world.sources()), Some((zero.clone(), ratio(1, 1))));
        let printed = linear + half(&quadratic);
        assert!(quadratic.is_zero() || integrated(&printed, world.sources()) != Some((zero, ratio(1, 1))));
        let new = world.substitution(&parts.chi);
        for (s, (w, v)) in parts.noise.iter().enumerate() {
            assert_eq!(w.above(v) * &new, world.noise(s));
        }
    }
    // φ = 0, T = 0, H = 1, Σᵛ = 2, z = 1, by the crate.
    let path = super::scalar([1, 1, 1, 0, 2], &[0]);
    let parts = exact_kalman::nongaussian::Decomposition::new(&path, Choice::of_the_paper(1, 1)).expect("noisy");
    let (z, first) = (number(ratio(1, 1)), ratio(1, 1));
    let found = [parts.log_density(&z), as_printed::log_density(&parts, &z)].map(|log| log.log_moment(&first));
    assert_eq!(found, [ratio(0, 1), ratio(1, 2)]);
}

/// SM-3.10, SM-3.11, SM-Z, SM-3.12, SM-3.13: with φ = π = 0, ζ = 0.
#[test]
fn the_choice() {
    for (world, mut dice) in World::all(BOTH) {
        let parts = decomposition(&world, &mut dice, true);
        let mut x = Matrix::zeros(world.n, world.size());
        for (t, at) in world.steps.iter().enumerate() {
            let z = &world.psi()[t] * world.z();
            assert_eq!((&parts.z[t], &parts.x[t]), (&z, &x));
            let w = world.plant_noise(t) + at.regression() * &at.h * &z;
            let v = world.sensor_noise(t) + &at.h * &z;
            assert_eq!((&parts.noise[t].0, &parts.noise[t].1), (&w, &v));
            assert_eq!(&at.h * &x + v, world.readings()[t]);
            x = &at.a * x + w;
        }
    }
}

/// SM-2.17, SM-2.18, SM-Z-uncorrelated, SM-T1-remark: for Σʷᵛ = 0 the initial part is Φ(t,0)ξ, Ψ = Φ, and the plant noise stays as it is.
/// With Σʷᵛ ≠ 0 they differ as soon as ΣʷᵛΣᵛ⁻¹HΨ ≠ 0; that Σᵛ = I does not matter.
#[test]
fn without_correlation_the_initial_part_follows_the_plant() {
    for (world, mut dice) in World::all(&[Noises::Standard]) {
        let parts = decomposition(&world, &mut dice, true);
        let mut x = Matrix::zeros(world.n, world.size());
        for (t, at) in world.steps.iter().enumerate() {
            assert_eq!(parts.z[t], &world.transitions(0, false)[t] * world.z());
            assert_eq!(parts.noise[t].0, world.plant_noise(t));
            assert_eq!(parts.x[t], x);
            x = &at.a * x + world.plant_noise(t);
        }
        let found: Vec<Q> = world
            .statistics(&vec![Matrix::zeros(world.k, 1); world.steps.len()])
            .iter()
            .map(|now| now.transition.clone())
            .collect();
        assert_eq!((&found, &world.psi()), (&world.transitions(0, false), &found));
    }
    for (world, _) in World::all(&[Noises::Correlated]) {
        let (phi, psi) = (world.transitions(0, false), world.psi());
        let at = &world.steps[0];
        assert_eq!(phi[1] == psi[1], (at.regression() * &at.h).is_zero());
    }
    // Σᵛ = 2 and Σʷᵛ = 0: A − 0·H = A.
    let scalar = super::scalar([3, 1, 1, 0, 2], &[1]);
    let all = exact_kalman::nongaussian::statistics(&scalar).expect("noisy");
    assert_eq!(all[1].transition, number(ratio(3, 1)));
}

/// Erratum SM-2.17: the sensors have dimension k, and so has their unit matrix: for n = 2, k = 1 Σᵛ = I_n is no covariance of V°.
#[test]
fn the_unit_matrix_has_the_size_of_the_sensors() {
    let world =
        (1..100).map(|seed| World::random(seed, Noises::Standard)).find(|w| (w.n, w.k) == (2, 1)).expect("some");
    let sigma = world.steps[0].v();
    assert_eq!(
        (&sigma, sigma == Matrix::identity(world.k), sigma == Matrix::identity(world.n)),
        (&Matrix::identity(1), true, false)
    );
}
