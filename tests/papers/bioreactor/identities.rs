//! The two ways to write the reactor, and its laws.

use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Field, ModelError, Observation, Place};
use exact_kalman::reproduce::bioreactor::{
    BioreactorError, Concentration, Earlier, Exponent, Preset, Reactor, Setting, Unphysical, path_in_doubles, realised,
    system,
};
use exact_kalman::scalar::{Rational, Undefined, exact_value, ratio};
use proptest::prelude::*;

use super::{NATURAL, readings};

fn fraction() -> impl Strategy<Value = Rational> {
    (-60_i64..=60, 1_i64..=12).prop_map(|(above, below)| ratio(above, below))
}

fn positive() -> impl Strategy<Value = Rational> {
    (1_i64..=60, 1_i64..=12).prop_map(|(above, below)| ratio(above, below))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    /// HV-8a, HV-8b, HV-9a: the nonlinear step is the linear one, whatever the constants, the state, the rates and the noise.
    #[test]
    fn the_reactor_is_linear_in_its_state(
        state in [fraction(), fraction()],
        noise in [fraction(), fraction()],
        (growth, dilution) in (fraction(), fraction()),
        (feed, yield_coefficient, period) in (fraction(), positive(), fraction()),
    ) {
        let reactor = Reactor { feed, yield_coefficient, period, ..Reactor::printed(Exponent::Natural(1)) };
        let next = reactor.next(&state, &growth, &dilution, &noise);
        let linear = reactor.transition(&growth, &dilution) * Matrix::column(state.to_vec())
            + reactor.input(&dilution)
            + Matrix::column(noise.to_vec());
        prop_assert_eq!(Matrix::column(next.to_vec()), linear);
    }

    /// HV-9a, HV-9b, HV-mu, HV-u, HV-mu2, HV-u2: the realised system has, at every step, the coefficients that the laws
    /// written out here have at the substrate and the reading d steps before.
    #[test]
    fn the_realised_system_follows_the_delayed_laws(
        earlier in proptest::collection::vec((positive(), positive()), 0..=3),
        y in proptest::collection::vec(positive(), 1..=6),
        beta in 0_u32..=3,
        start in any::<bool>(),
    ) {
        let delay = earlier.len();
        let mut setting = Setting::printed(Exponent::Natural(beta), delay);
        setting.earlier = earlier.iter().cloned().map(|(substrate, reading)| Earlier { substrate, reading }).collect();
        let start = if start { Preset::Repaired } else { Preset::Drawn }.start(delay);
        let path = realised(&setting, &start.standard, false, &y).expect("a valid system");
        for (k, step) in path.steps().iter().enumerate() {
            // The paper's times 1 − d, …, 0 and 1, 2, …, in one list.
            let substrates: Vec<_> = earlier.iter().map(|(x, _)| x).chain(&y).collect();
            let seen: Vec<_> = earlier.iter().map(|(_, read)| read).chain(&y).collect();
            let x = substrates[k];
            let power = num_traits::pow(x.clone(), usize::try_from(beta).expect("small"));
            let growth = ratio(1, 2) * x / (ratio(125, 1) + power);
            let dilution = ratio(1, 20) / (seen[k] + ratio(1, 1));
            let transition = step.transition.as_ref().expect("one leaves every step");
            let rows = vec![
                vec![ratio(1, 1) + &growth - &dilution, ratio(0, 1)],
                vec![-growth, ratio(1, 1) - &dilution],
            ];
            prop_assert_eq!(&transition.matrix, &Matrix::from_rows(rows).expect("rows of one length"));
            prop_assert_eq!(&transition.input, &Matrix::column(vec![ratio(0, 1), ratio(50, 1) * dilution]));
            // D Dᵀ of [[3, 1], [1, 1]]/10.
            prop_assert_eq!(&transition.noise, &Matrix::from_integers(&[[10, 4], [4, 2]]).scaled(&ratio(1, 100)));
            prop_assert_eq!(&transition.cross_noise, &Matrix::zeros(2, 1));
            prop_assert_eq!(&step.observation, &Matrix::from_integers(&[[0, 1]]));
            prop_assert_eq!(&step.observation_noise, &Matrix::zeros(1, 1));
            prop_assert_eq!(&step.observation_input, &Matrix::zeros(1, 1));
        }
    }
}

/// HV-Sim, HV-8a, HV-8b, HV-8c: the simulated course obeys the printed equations with the printed constants, step by step.
#[test]
fn a_course_by_its_equations() {
    let setting = Setting::printed(Exponent::Natural(1), 1);
    let states = setting.simulated(&[[ratio(1, 1), ratio(-2, 1)], [ratio(1, 2), ratio(3, 1)]]).expect("rates");
    assert_eq!(states[0], [ratio(25, 1), ratio(30, 1)]);
    let mut before = ratio(30, 1);
    for (k, [first, second]) in [[ratio(1, 1), ratio(-2, 1)], [ratio(1, 2), ratio(3, 1)]].iter().enumerate() {
        let [biomass, substrate] = &states[k];
        let growth = &before / ratio(2, 1) / (ratio(125, 1) + &before);
        let dilution = ratio(1, 20) / (&before + ratio(1, 1));
        let noise = [(ratio(3, 10) * first) + ratio(1, 10) * second, ratio(1, 10) * first + ratio(1, 10) * second];
        assert_eq!(states[k + 1][0], biomass + biomass * (&growth - &dilution) + &noise[0]);
        assert_eq!(states[k + 1][1], substrate - growth * biomass + dilution * (ratio(50, 1) - substrate) + &noise[1]);
        before = substrate.clone();
    }
}

/// HV-mu: at β = 0 the law is αx/(γ + 1), linear in x; what grows as β falls is its size, at x = 30 from 3/205 over 3/31
/// to 5/42.
#[test]
fn the_growth_rate_is_linear_where_the_paper_calls_it_least_linear() {
    let rate = |exponent, x: i64| Reactor::printed(exponent).growth_rate(&ratio(x, 1)).expect("a rate");
    assert_eq!(NATURAL.map(|exponent| rate(exponent, 30)), [ratio(3, 205), ratio(3, 31), ratio(5, 42)]);
    for x in 0..60 {
        assert_eq!(rate(Exponent::Natural(0), x), ratio(x, 252));
    }
    // For β = 2 it is not even monotone: its slope vanishes at √125.
    assert!(rate(Exponent::Natural(2), 11) > rate(Exponent::Natural(2), 30));
}

/// HV-mu: for an exponent that is no natural number the datum is a rounded double, and nothing but that.
#[test]
fn a_real_exponent_gives_a_double() {
    for (beta, root) in [(0.5, 6_i64), (0.5, 5), (2.0, 900)] {
        let reactor = Reactor::printed(Exponent::Real(beta));
        let substrate = if beta > 1.0 { 30 } else { root * root };
        // x^β is the integer `root`, so the law is α x/(γ + root).
        let exact = ratio(substrate, 2) / ratio(125 + root, 1);
        let found = reactor.growth_rate(&ratio(substrate, 1)).expect("a rate");
        assert_eq!(exact_value(found.double()), Some(found.clone()), "a dyadic number");
        // Every operation is rounded once, and the power to within one unit in its last place, which is at most a 2⁻⁵²
        // of γ + x^β too: four steps.
        let error = (found - &exact) / exact;
        assert!(error < ratio(1, 1 << 50) && -error < ratio(1, 1 << 50));
    }
    let real = Reactor::printed(Exponent::Real(0.5)).growth_rate(&ratio(7, 1)).expect("a rate");
    assert_eq!(
        real,
        exact_value(Reactor::printed(Exponent::Real(0.5)).doubles().growth_rate(&7.0).expect("a rate"))
            .expect("finite")
    );
}

/// HV-mu, HV-u: where the laws have no value the error says so, with the step.
#[test]
fn undefined_rates_are_errors_with_their_step() {
    let setting = Setting::printed(Exponent::Natural(1), 1);
    let start = Preset::Repaired.start(1).standard;
    let numbers = |values: &[i64]| values.iter().map(|&y| ratio(y, 1)).collect::<Vec<_>>();
    let stopped = |setting: &Setting<Rational>, values: &[i64]| {
        realised(setting, &start, false, &numbers(values)).expect_err("no rate there")
    };
    let negative = Unphysical::NegativeSubstrate { value: -2.0 };
    assert_eq!(stopped(&setting, &[30, -2, 30]), BioreactorError::Unphysical { step: 2, source: negative });
    assert_eq!(stopped(&setting, &[-1, 30]), BioreactorError::Unphysical { step: 1, source: Unphysical::NoControl });
    let mut odd = setting.clone();
    odd.reactor.growth_offset = ratio(-7, 1);
    let pole = Unphysical::NoGrowthRate { substrate: 7.0 };
    assert_eq!(stopped(&odd, &[30, 7, 30]), BioreactorError::Unphysical { step: 2, source: pole });
    // The last reading is used by no transition here.
    assert!(realised(&setting, &start, false, &numbers(&[30, -2])).is_ok());
    // The system alone says that its coefficient is not finite on these readings.
    let observations: Vec<_> = numbers(&[30, -2, 30]).into_iter().map(|y| Observation::complete([y])).collect();
    let place = Place { field: Field::Transition, step: Some(2) };
    let error = system(&setting, &start).realised(&observations).expect_err("no rate there");
    assert_eq!(error, ModelError::Infinite { place, source: Undefined::OutsideTheRing });
    // In doubles, and in the simulation itself.
    let doubles = path_in_doubles(&setting.doubles(), &start.doubles(), &[30.0, -2.0, 30.0]);
    assert_eq!(doubles, Err(BioreactorError::Unphysical { step: 2, source: negative }));
    let thrown = setting.simulated(&[[ratio(0, 1), ratio(-1000, 1)], [ratio(0, 1), ratio(0, 1)]]);
    assert!(matches!(thrown, Ok(states) if states.len() == 3), "the rates of step 1 are those of step 0's substrate");
    let thrown = setting.simulated(&vec![[ratio(0, 1), ratio(-1000, 1)]; 3]);
    assert!(matches!(
        thrown,
        Err(BioreactorError::Unphysical { step: 2, source: Unphysical::NegativeSubstrate { .. } })
    ));
}

/// HV-mu2, HV-u2: at k = 1 the rates are those of the value named for time −1, from k = 2 on those of the printed laws.
#[test]
fn two_steps_of_delay_need_one_more_value() {
    let mut setting = Setting::printed(Exponent::Natural(1), 2);
    let named = Earlier { substrate: ratio(20, 1), reading: ratio(10, 1) };
    setting.earlier[0] = named;
    let y = [31, 29].map(|y| ratio(y, 1));
    let seen = |k: usize| {
        let rates = setting.coefficients(k, |j| y.get(j).cloned()).expect("rates").expect("all readings are there");
        [rates.growth, rates.dilution]
    };
    let laws =
        |substrate: i64, reading: i64| [ratio(substrate, 2) / ratio(125 + substrate, 1), ratio(1, 20 * (reading + 1))];
    assert_eq!(seen(0), laws(20, 10), "the named value");
    assert_eq!(seen(1), laws(30, 30), "y(0)");
    assert_eq!(seen(2), laws(31, 31), "y(1)");
    // A reading that is missing leaves the rates that need it unknown.
    assert_eq!(setting.coefficients(2, |_| None), Ok(None));
}

/// HV-9a: the coefficients computed in doubles are those of the exact system to a few roundings.
#[test]
fn coefficients_in_doubles() {
    for exponent in NATURAL {
        let setting = Setting::printed(exponent, 2);
        let start = Preset::Repaired.start(2).standard;
        let y = readings(&setting, 20);
        let exact = realised(&setting, &start, false, &y).expect("a valid system");
        let doubles: Vec<f64> = y.iter().map(Concentration::double).collect();
        let found = path_in_doubles(&setting.doubles(), &start.doubles(), &doubles).expect("a valid system");
        assert_eq!(found.steps().len(), exact.steps().len());
        for (found, exact) in found.steps().iter().zip(exact.steps()) {
            let (found, exact) =
                (found.transition.as_ref().expect("present"), exact.transition.as_ref().expect("present"));
            for (found, exact) in [
                (&found.matrix, &exact.matrix),
                (&found.input, &exact.input),
                (&found.noise, &exact.noise),
                (&found.cross_noise, &exact.cross_noise),
            ] {
                for (found, exact) in found.entries().iter().zip(exact.entries()) {
                    // At most ten roundings of positive numbers, each at most 2⁻⁵³ of a value of at most 3; 1 + μ − u is
                    // the only difference, and it is near one.
                    let error = exact_value(*found).expect("finite") - exact;
                    assert!(error < ratio(1, 1 << 48) && -error < ratio(1, 1 << 48), "{found} for {exact}");
                }
            }
        }
    }
}

/// HV-mu: for β ≥ 200 neither rate nor derivative overflows: both tend to zero as x^β grows, and no NaN comes out.
#[test]
fn large_exponents_do_not_overflow() {
    for beta in [150.0, 200.0, 250.0, 1e6] {
        let mut reactor = Setting::printed(Exponent::Natural(1), 1).doubles().reactor;
        reactor.exponent = Exponent::Real(beta);
        let [rate, slope] =
            [reactor.growth_rate(&30.0).expect("defined there"), reactor.growth_slope(&30.0).expect("defined there")];
        assert!((0.0..1e-200).contains(&rate) && (-1e-200..=0.0).contains(&slope), "{beta}: {rate}, {slope}");
        assert!(reactor.growth_rate(&f64::INFINITY).is_err() && reactor.growth_slope(&f64::NAN).is_err());
    }
}
