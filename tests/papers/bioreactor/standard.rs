//! The standard predictor: a recursion in scalars, the joint law, and doubles.

use std::num::NonZero;

use exact_kalman::filter::{one_shot, predict_ahead};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Coefficient, Initial, Input, ModelError, Noise, Observation, Path, System, Timing};
use exact_kalman::reproduce::bioreactor::{
    Belief, Concentration, Exponent, Preset, Setting, path_in_doubles, realised, standard_predictions,
    standard_predictions_exact, system,
};
use exact_kalman::scalar::{Rational, Undefined, exact_value, ratio};

use super::{NATURAL, readings};

/// Since the substrate is known after each reading, mean b and variance p of the biomass are all there is. With
/// a = 1 + μ − u and c = μ the next state has mean (ab, y − cb + u(50 − y)) and covariance
/// [[a²p, −acp], [−acp, c²p]] + DDᵀ; the reading then takes its share.
fn by_scalars(setting: &Setting<Rational>, start: &Belief<Rational>, y: &[Rational]) -> Vec<[Rational; 3]> {
    let p = |i: usize, j: usize| start.covariance[(i, j)].clone();
    let m = |i: usize| start.mean[(i, 0)].clone();
    let [mut mean, mut variance] = [[m(0), m(1)], [p(0, 0), p(1, 1)]];
    let mut shared = p(0, 1);
    let mut laws = Vec::new();
    for (k, reading) in y.iter().enumerate() {
        // The law of x_B before y_k.
        laws.push([mean[0].clone(), mean[1].clone(), variance[0].clone()]);
        let gain = &shared / &variance[1];
        let b = &mean[0] + &gain * (reading - &mean[1]);
        let left = &variance[0] - &gain * &shared;
        let old = k.checked_sub(setting.earlier.len()).map_or_else(|| ratio(30, 1), |j| y[j].clone());
        let Exponent::Natural(beta) = setting.reactor.exponent else { panic!("a rational law") };
        let power = num_traits::pow(old.clone(), usize::try_from(beta).expect("small"));
        let c = &old / ratio(2, 1) / (ratio(125, 1) + power);
        let u = ratio(1, 20) / (&old + ratio(1, 1));
        let a = ratio(1, 1) + &c - &u;
        mean = [&a * &b, reading - &c * &b + u * (ratio(50, 1) - reading)];
        variance = [&a * &a * &left + ratio(1, 10), &c * &c * &left + ratio(1, 50)];
        shared = ratio(1, 25) - a * c * left;
    }
    laws
}

/// HV-SKP: the general predictor equals the recursion in scalars, for the printed start too.
#[test]
fn one_step_ahead_by_scalars() {
    for (exponent, delay) in NATURAL.into_iter().zip([1, 2, 1]) {
        for preset in Preset::ALL {
            let setting = Setting::printed(exponent, delay);
            let start = preset.start(delay).standard;
            let y = readings(&setting, 8);
            let path = realised(&setting, &start, true, &y).expect("a system");
            let laws = standard_predictions_exact(&path, 1).expect("regular");
            let expected = by_scalars(&setting, &start, &y);
            assert_eq!(laws.len(), expected.len());
            for (law, [biomass, substrate, variance]) in laws.iter().zip(expected) {
                assert_eq!([&law.mean[(0, 0)], &law.mean[(1, 0)]], [&biomass, &substrate]);
                assert_eq!(law.covariance[(0, 0)], variance);
            }
        }
    }
}

/// The same path with the readings from `first` on missing: what is then known of x_k is known d steps ahead.
fn unread(path: &Path<Rational>, first: usize) -> Path<Rational> {
    let steps = path.steps();
    let of = |entry: fn(&exact_kalman::model::Transition<Rational>) -> Matrix<Rational>| {
        Coefficient::per_step(steps.iter().map(|step| entry(step.transition.as_ref().expect("one leaves every step"))))
    };
    let system = System {
        timing: Timing::Departing,
        initial: Initial { before: Before::Observation, ..path.initial().clone() },
        transition: of(|given| given.matrix.clone()),
        observation: Matrix::from_integers(&[[0, 1]]).into(),
        noise: Noise::Covariances {
            process: of(|given| given.noise.clone()),
            cross: None,
            observation: Matrix::zeros(1, 1).into(),
        },
        input: Some(Input { matrix: None, vector: of(|given| given.input.clone()) }),
        observation_input: None,
    };
    let reading = |k: usize| if k < first { steps[k].reading.clone() } else { Observation::missing(1) };
    system.realised(&(0..steps.len()).map(reading).collect::<Vec<_>>()).expect("the same system")
}

/// HV-SKP2: one, two and three steps ahead equal the joint law, conditioned once on what was read by then.
#[test]
fn steps_ahead_by_the_joint_law() {
    let setting = Setting::printed(Exponent::Natural(1), 2);
    let y = readings(&setting, 5);
    let path = realised(&setting, &Preset::Repaired.start(2).standard, false, &y).expect("a valid system");
    for ahead in 1..=3 {
        let laws = standard_predictions_exact(&path, ahead).expect("regular");
        assert_eq!(laws.len(), 5);
        for (k, law) in laws.iter().enumerate() {
            let known = (k + 1).saturating_sub(ahead);
            let joint = one_shot(&unread(&path, known)).expect("consistent");
            // Nothing was read at k itself, so that what is filtered there is what was predicted.
            assert_eq!(&law.mean, joint[k].filtered.mean(), "{ahead} ahead, step {k}");
            assert_eq!(&law.covariance, joint[k].filtered.covariance());
        }
    }
}

/// HV-u2, HV-mu2, HV-SKP2: the system with delay 2 is realised 2 steps ahead, since each transition knows its index though it is
/// shown fewer readings; that with delay 1 one and two steps ahead. The predictor finds the laws of the joint test above.
#[test]
fn the_reactor_is_known_in_time() {
    for (delay, ahead) in [(2, 2), (1, 1), (1, 2), (2, 1), (2, 3)] {
        let setting = Setting::printed(Exponent::Natural(1), delay);
        let start = Preset::Repaired.start(delay).standard;
        let y = readings(&setting, 5);
        let data: Vec<_> = y.iter().map(|y| Observation::complete([y.clone()])).collect();
        let steps_ahead = NonZero::new(ahead).expect("not zero");
        let path = system(&setting, &start).realised_ahead(&data, steps_ahead).expect("known in time");
        let trace = predict_ahead(&path).expect("regular");
        let late = trace.steps.iter().map(|step| &step.ahead[ahead - 1]);
        let found: Vec<_> = trace.start.iter().chain(late).take(5).cloned().collect();
        let realised = realised(&setting, &start, false, &y).expect("a valid system");
        assert_eq!(
            found,
            standard_predictions_exact(&realised, ahead).expect("regular"),
            "delay {delay}, {ahead} ahead"
        );
    }
    // A delay of one is not known three steps ahead, and what is missing is said.
    let setting = Setting::printed(Exponent::Natural(1), 1);
    let data: Vec<_> = readings(&setting, 5).into_iter().map(|y| Observation::complete([y])).collect();
    let error =
        system(&setting, &Preset::Repaired.start(1).standard).realised_ahead(&data, NonZero::new(3).expect("not zero"));
    assert!(matches!(error, Err(ModelError::Infinite { source: Undefined::Missing, .. })), "{error:?}");
}

/// The data of a path, each nonzero one moved by a relative 2⁻⁵³ either way.
fn moved(path: &Path<Rational>, seed: &mut u64) -> Path<Rational> {
    let mut seen: Vec<(Rational, Rational)> = Vec::new();
    let mut image = |value: &Rational| {
        if let Some((_, image)) = seen.iter().find(|(old, _)| old == value) {
            return image.clone();
        }
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let shift = if *seed >> 63 == 0 { ratio(1, 1 << 53) } else { ratio(-1, 1 << 53) };
        let image = value * (ratio(1, 1) + shift);
        seen.push((value.clone(), image.clone()));
        image
    };
    // The sensor [0, 1] and numbers that are equal stay so.
    let Ok(path) = path.try_map(|value| {
        Ok::<_, std::convert::Infallible>(if *value == ratio(1, 1) { value.clone() } else { image(value) })
    });
    path
}

/// HV-SKP, HV-SKP2: in doubles the predictions of the biomass are as near to the exact ones as data moved by half a unit
/// in their last place leave them, within the two digits that a backward-stable method is given here.
#[test]
fn doubles_keep_the_attainable_digits() {
    const STEPS: i32 = 10;
    for (preset, exponent, delay) in [
        (Preset::Printed, Exponent::Natural(1), 1),
        (Preset::Repaired, Exponent::Natural(0), 2),
        (Preset::Drawn, Exponent::Real(0.5), 1),
    ] {
        let setting = Setting::printed(exponent, delay);
        let start = preset.start(delay).standard;
        let y = readings(&setting, STEPS);
        let path = realised(&setting, &start, true, &y).expect("a system");
        let biomass = |path: &Path<Rational>, ahead: usize| -> Vec<Rational> {
            let laws = standard_predictions_exact(path, ahead).expect("regular");
            laws.into_iter().map(|law| law.mean[(0, 0)].clone()).collect()
        };
        let doubles: Vec<f64> = y.iter().map(Concentration::double).collect();
        let path_in_doubles = path_in_doubles(&setting.doubles(), &start.doubles(), &doubles).expect("a system");
        for ahead in 1..=2 {
            let exact = biomass(&path, ahead);
            let found = standard_predictions(&path_in_doubles, ahead).expect("regular");
            assert_eq!(found.len(), 10);
            let mut seed = 1;
            let near: Vec<_> = (0..12).map(|_| biomass(&moved(&path, &mut seed), ahead)).collect();
            for (k, exact) in exact.iter().enumerate() {
                let distance = |other: &Rational| {
                    let difference = other - exact;
                    if difference < ratio(0, 1) { -difference } else { difference }
                };
                let attainable = near.iter().map(|near| distance(&near[k])).max().expect("at least one");
                let error = distance(&exact_value(found[k][(0, 0)]).expect("finite"));
                assert!(error <= attainable * ratio(100, 1), "{preset}, {ahead} ahead, step {k}: {}", found[k][(0, 0)]);
            }
        }
    }
}

/// HV-Sim, HV-SKP: all of n = 150 steps over the rationals, with readings in 64ths. The denominators grow by a steady number
/// of bits per step, no more in the last fifty steps than in the first; doubles keep eleven of
/// sixteen digits of predictions below 100, as for all forms (tests/float): condition numbers below 10⁴ take at most four,
/// roundings one more.
#[test]
fn a_whole_run_is_exact() {
    let setting = Setting::printed(Exponent::Natural(1), 1);
    let start = Preset::Printed.start(1).standard;
    let y = readings(&setting, 150);
    let path = realised(&setting, &start, true, &y).expect("a system");
    let exact = standard_predictions_exact(&path, 1).expect("regular");
    let bits = |k: usize| exact[k].covariance[(0, 0)].denom().bits();
    assert!(bits(149) - bits(99) <= bits(50) - bits(0));
    let doubles: Vec<f64> = y.iter().map(Concentration::double).collect();
    let path = path_in_doubles(&setting.doubles(), &start.doubles(), &doubles).expect("a system");
    for (found, exact) in standard_predictions(&path, 1).expect("regular").iter().zip(&exact) {
        let error = exact_value(found[(0, 0)]).expect("finite") - &exact.mean[(0, 0)];
        let bound = ratio(1, 1_000_000_000);
        assert!(error < bound && -error < bound);
    }
}
