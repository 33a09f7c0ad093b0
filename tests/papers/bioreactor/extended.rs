//! The extended predictor on the reactor: its derivatives, an exact copy of it, and when it is the standard one.

use std::num::NonZeroUsize;

use exact_kalman::float::{ExtendedObstacle, Linearisation};
use exact_kalman::matrix::Matrix;
use exact_kalman::reproduce::bioreactor::{
    Belief, BioreactorError, Concentration, Exponent, Preset, Reactor, Setting, Unphysical, extended_predictions,
    linear_at, path_in_doubles, standard_predictions,
};
use exact_kalman::scalar::{Rational, exact_value, ratio};
use proptest::prelude::*;

use super::{NATURAL, readings};

type Q = Matrix<Rational>;

/// A number and its derivatives by the entries of a state: arithmetic on them differentiates exactly.
#[derive(Clone, Debug)]
struct Dual {
    value: Rational,
    slopes: Vec<Rational>,
}

impl Dual {
    fn constant(value: Rational, n: usize) -> Self {
        Self { value, slopes: vec![ratio(0, 1); n] }
    }

    fn variable(value: Rational, place: usize, n: usize) -> Self {
        Self { value, slopes: (0..n).map(|i| ratio(i64::from(i == place), 1)).collect() }
    }

    fn with(&self, other: &Self, value: Rational, slope: impl Fn(&Rational, &Rational) -> Rational) -> Self {
        Self { value, slopes: self.slopes.iter().zip(&other.slopes).map(|(a, b)| slope(a, b)).collect() }
    }

    fn plus(&self, other: &Self) -> Self {
        self.with(other, &self.value + &other.value, |a, b| a + b)
    }

    fn minus(&self, other: &Self) -> Self {
        self.with(other, &self.value - &other.value, |a, b| a - b)
    }

    fn times(&self, other: &Self) -> Self {
        self.with(other, &self.value * &other.value, |a, b| a * &other.value + &self.value * b)
    }

    fn over(&self, other: &Self) -> Self {
        let square = &other.value * &other.value;
        self.with(other, &self.value / &other.value, |a, b| (a * &other.value - &self.value * b) / &square)
    }

    /// The root of a square, of which the value is given.
    fn root(&self, value: Rational) -> Self {
        let slopes = self.slopes.iter().map(|slope| slope / (ratio(2, 1) * &value)).collect();
        Self { value, slopes }
    }
}

/// The transition of the extended state, written out again from HV-8a, HV-8b, HV-mu and HV-EKP over dual numbers, where
/// `power` is x^β.
fn transition(dilution: &Rational, state: &[Rational], power: impl Fn(&Dual) -> Dual) -> (Q, Q) {
    let n = state.len();
    let number = |above: i64, below: i64| Dual::constant(ratio(above, below), n);
    let x: Vec<Dual> = state.iter().enumerate().map(|(i, value)| Dual::variable(value.clone(), i, n)).collect();
    let old = &x[n - 1];
    let growth = number(1, 2).times(old).over(&number(125, 1).plus(&power(old)));
    let u = Dual::constant(dilution.clone(), n);
    let biomass = number(1, 1).plus(&growth).minus(&u).times(&x[0]);
    let substrate = x[1].minus(&growth.times(&x[0])).plus(&u.times(&number(50, 1).minus(&x[1])));
    let next: Vec<Dual> = [biomass, substrate].into_iter().chain(x[1..n - 1].iter().cloned()).collect();
    (
        Matrix::column(next.iter().map(|entry| entry.value.clone()).collect()),
        Matrix::from_fn(n, n, |i, j| next[i].slopes[j].clone()),
    )
}

fn natural_power(beta: u32) -> impl Fn(&Dual) -> Dual {
    move |x: &Dual| {
        let one = Dual::constant(ratio(1, 1), x.slopes.len());
        (0..beta).fold(one, |power, _| power.times(x))
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    /// HV-EKP: value and Jacobian matrix equal those of dual numbers, for delays from 0 to 3 and natural exponents.
    #[test]
    fn the_jacobian_by_dual_numbers(
        state in proptest::collection::vec((1_i64..=90, 1_i64..=7).prop_map(|(a, b)| ratio(a, b)), 2..=5),
        dilution in (1_i64..=9, 10_i64..=99).prop_map(|(a, b)| ratio(a, b)),
        beta in 0_u32..=4,
    ) {
        let reactor = Reactor::printed(Exponent::Natural(beta));
        let found = linear_at(&reactor, &dilution, &Matrix::column(state.clone())).expect("positive");
        prop_assert_eq!(found, transition(&dilution, &state, natural_power(beta)));
    }

    /// HV-EKP: for β = 1/2 at squares, where the law is rational, the derivative in doubles is that of dual numbers up to a
    /// dozen roundings.
    #[test]
    fn the_jacobian_of_a_root(root in 1_i64..=9, biomass in 1_i64..=50, substrate in 1_i64..=50) {
        let reactor = Reactor::printed(Exponent::Real(0.5));
        let state = [ratio(biomass, 1), ratio(substrate, 1), ratio(root * root, 1)];
        let (value, jacobian) = transition(&ratio(1, 64), &state, |x| x.root(ratio(root, 1)));
        let found = linear_at(&reactor, &ratio(1, 64), &Matrix::column(state.to_vec())).expect("positive");
        for (found, exact) in [(&found.0, &value), (&found.1, &jacobian)] {
            for (found, exact) in found.entries().iter().zip(exact.entries()) {
                // Sums of terms of at most 100, each of a relative error of at most 12 · 2⁻⁵³.
                let error = found - exact;
                prop_assert!(error < ratio(1, 1 << 41) && -error < ratio(1, 1 << 41));
            }
        }
    }
}

/// The extended predictor over the rationals, for one reading at a time and in the words of a textbook: the mean and the
/// covariance of each x_k given what came before.
fn exact_copy(
    setting: &Setting<Rational>,
    start: &Belief<Rational>,
    linearisation: Linearisation,
    y: &[Rational],
) -> Vec<(Q, Q)> {
    let Exponent::Natural(beta) = setting.reactor.exponent else { panic!("a rational law") };
    let n = start.mean.rows();
    let d = Matrix::from_fn(n, 2, |i, j| if i < 2 { setting.noise_factor[i][j].clone() } else { ratio(0, 1) });
    let q = &d * d.transpose();
    let (mut mean, mut p) = (start.mean.clone(), start.covariance.clone());
    let mut laws = Vec::new();
    for (k, reading) in y.iter().enumerate() {
        laws.push((mean.clone(), p.clone()));
        let old = k.checked_sub(setting.earlier.len()).map_or_else(|| ratio(30, 1), |j| y[j].clone());
        let dilution = ratio(1, 20) / (old + ratio(1, 1));
        let linear = |point: &Q| transition(&dilution, point.entries(), natural_power(beta));
        // Column S of P over P_SS.
        let gain = p.select_columns(&[1]).scaled(&(ratio(1, 1) / &p[(1, 1)]));
        let innovation = reading - &mean[(1, 0)];
        let filtered = &mean + gain.scaled(&innovation);
        let left = &p - &gain * p.select_rows(&[1]);
        let (next, a) = match linearisation {
            Linearisation::Filtered => linear(&filtered),
            Linearisation::Prediction => {
                let (value, a) = linear(&mean);
                (value + (&a * gain).scaled(&innovation), a)
            }
        };
        mean = next;
        p = a.congruence(&left) + &q;
    }
    laws
}

/// Readings and start, each number moved by a relative 2⁻⁵³ one way or the other.
fn moved(start: &Belief<Rational>, y: &[Rational], seed: u32) -> (Belief<Rational>, Vec<Rational>) {
    let mut bits = seed;
    let mut moved = |value: &Rational| {
        bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let shift = if bits >> 31 == 0 { ratio(1, 1 << 53) } else { ratio(-1, 1 << 53) };
        value * (ratio(1, 1) + shift)
    };
    let mean = start.mean.map(&mut moved);
    let mut covariance = start.covariance.map(&mut moved);
    for i in 0..covariance.rows() {
        for j in 0..i {
            covariance[(i, j)] = covariance[(j, i)].clone();
        }
    }
    (Belief { mean, covariance }, y.iter().map(moved).collect())
}

/// HV-EKP: mean and variance of the biomass in doubles are as near to those of the exact copy as data moved by half a unit in
/// their last place leave them, within two digits; over eight steps, in both forms, for one and two old substrates.
#[test]
fn doubles_follow_the_exact_copy() {
    let distance = |one: &Rational, other: &Rational| if one < other { other - one } else { one - other };
    for linearisation in [Linearisation::Prediction, Linearisation::Filtered] {
        for (exponent, delay) in NATURAL.into_iter().zip([1, 2, 1]) {
            let setting = Setting::printed(exponent, delay);
            let start = Preset::Drawn.start(delay).extended;
            let y = readings(&setting, 8);
            let of_biomass = |start: &Belief<Rational>, y: &[Rational]| -> Vec<[Rational; 2]> {
                let laws = exact_copy(&setting, start, linearisation, y);
                laws.into_iter().map(|(mean, p)| [mean[(0, 0)].clone(), p[(0, 0)].clone()]).collect()
            };
            let exact = of_biomass(&start, &y);
            let near: Vec<_> =
                (0..12).map(|seed| moved(&start, &y, seed)).map(|(start, y)| of_biomass(&start, &y)).collect();
            let doubles: Vec<f64> = y.iter().map(Concentration::double).collect();
            let found =
                extended_predictions(&setting.doubles(), &start.doubles(), linearisation, &doubles, NonZeroUsize::MIN)
                    .expect("a regular system");
            assert_eq!(found.steps.len(), exact.len());
            for (k, (step, exact)) in found.steps.iter().zip(&exact).enumerate() {
                let found = [step.predicted.mean[(0, 0)], step.predicted.covariance[(0, 0)]];
                for (which, (found, exact)) in found.into_iter().zip(exact).enumerate() {
                    let attainable =
                        near.iter().map(|near| distance(&near[k][which], exact)).max().expect("at least one");
                    let error = distance(&exact_value(found).expect("finite"), exact);
                    assert!(error <= attainable * ratio(100, 1), "{linearisation:?}, step {k}: {found} for {exact}");
                }
            }
        }
    }
}

/// HV-EKP, HV-SKP: nothing but the doubt about the old substrates sets the two predictors apart. Where these are known,
/// both forms of the extended predictor are the standard one, on all steps.
#[test]
fn the_extended_predictor_is_the_standard_one_if_old_substrates_are_known() {
    for (preset, delay) in [(Preset::Printed, 1), (Preset::Repaired, 2), (Preset::Drawn, 1)] {
        for exponent in [Exponent::Natural(2), Exponent::Real(0.5), Exponent::Natural(0)] {
            let setting = Setting::printed(exponent, delay).doubles();
            let start = preset.start(delay);
            let mut extended = start.extended.doubles();
            for i in 0..2 + delay {
                for j in 2..2 + delay {
                    extended.mean[(j, 0)] = 30.0;
                    extended.covariance[(i, j)] = 0.0;
                    extended.covariance[(j, i)] = 0.0;
                }
            }
            let noise: Vec<_> = (0..40_i32).map(|k| [f64::from(k * 7 % 5 - 2), f64::from(k * 3 % 5 - 2)]).collect();
            let states = setting.simulated(&noise).expect("a tank that does not run dry");
            let y: Vec<f64> = states.iter().map(|[_, substrate]| *substrate).collect();
            let path = path_in_doubles(&setting, &start.standard.doubles(), &y).expect("a system");
            for ahead in 1..=delay {
                let standard = standard_predictions(&path, ahead).expect("regular");
                for linearisation in [Linearisation::Prediction, Linearisation::Filtered] {
                    let steps = NonZeroUsize::new(ahead).expect("positive");
                    let found = extended_predictions(&setting, &extended, linearisation, &y, steps).expect("regular");
                    for (k, (found, standard)) in found.predictions().zip(&standard).enumerate() {
                        let difference = (found.mean[(0, 0)] - standard[(0, 0)]).abs();
                        // Eleven of sixteen digits of numbers below 100, as for all forms (tests/float): condition numbers
                        // below 10⁴ take at most four, roundings one more.
                        assert!(difference < 1e-9, "{preset}, {linearisation:?}, step {k}: {difference:e}");
                    }
                }
            }
        }
    }
}

/// HV-EKP: an estimate that is negative stops the predictor with its step, and a start that does not fit is refused.
#[test]
fn estimates_outside_the_law_are_errors() {
    let setting = Setting::printed(Exponent::Real(0.5), 1).doubles();
    let mut start = Preset::Repaired.start(1).extended.doubles();
    let run = |start: &Belief<f64>, linearisation| {
        extended_predictions(&setting, start, linearisation, &[30.0, 31.0], NonZeroUsize::MIN)
    };
    assert!(matches!(
        run(&Preset::Repaired.start(2).extended.doubles(), Linearisation::Prediction),
        Err(BioreactorError::States { predictor: "extended", expected: 3, found: 4 })
    ));
    // Before the reading ẑ is 5, after it 5 + (50/80)(30 − 45) < 0.
    start.mean[(2, 0)] = 5.0;
    assert!(run(&start, Linearisation::Prediction).is_ok());
    match run(&start, Linearisation::Filtered) {
        Err(BioreactorError::Extended(error)) => {
            assert_eq!(error.step, 0);
            let value = 5.0 - 50.0 / 80.0 * 15.0;
            assert_eq!(error.source, ExtendedObstacle::Undefined(Unphysical::NegativeSubstrate { value }));
        }
        other => panic!("{other:?}"),
    }
}
